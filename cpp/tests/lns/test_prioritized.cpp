#include <doctest/doctest.h>

#include "crossing.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {
namespace {

using test::Crossing;
using test::is_sound;
using test::plan_all;

TEST_CASE("robots in turn get tracks that fit together, under every rule") {
    for (const bool books_ahead : {false, true}) {
        for (const Tick headway : {0, 2}) {
            const Crossing crossing(6);
            const Problem problem(crossing.arrays(), {headway, books_ahead});
            SharedDistances distances(problem);
            FleetPlan plan(distances.problem());
            REQUIRE(plan_all(distances, plan, 1000) == SearchEnd::found);
            CHECK(is_sound(distances, plan));
        }
    }
}

TEST_CASE("planning in turn ends after as many searches as it may make") {
    const Crossing crossing(6);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    CHECK(plan_all(distances, plan, 2) == SearchEnd::stopped);
}

}  // namespace
}  // namespace rightofway
