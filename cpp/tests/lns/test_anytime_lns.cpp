#include <doctest/doctest.h>

#include "crossing.hpp"
#include "lns/anytime_lns.hpp"

namespace rightofway {
namespace {

using test::alone;
using test::Crossing;
using test::is_sound;
using test::planned;

TEST_CASE("one plan comes before a population, and both end when patience does") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    const FleetPlan first = planned(distances);
    FleetPlan in_one_go = first;
    AnytimeLns whole(distances, in_one_go, bounds, 5, 1);
    whole.run(1 << 30, 3000, test::no_deadline, test::no_deadline);
    CHECK(whole.n_idle() >= 3000);
    CHECK(whole.n_tasks() < 1 << 30);
    CHECK(is_sound(distances, in_one_go));

    FleetPlan with_pauses = first;
    AnytimeLns parts(distances, with_pauses, bounds, 5, 2);
    while (parts.n_idle() < 3000) {
        parts.run(1 << 30, 3000, test::no_deadline, [] { return true; });
    }
    CHECK(parts.n_tasks() == whole.n_tasks());
    CHECK(with_pauses.cost() == in_one_go.cost());
}

}  // namespace
}  // namespace rightofway
