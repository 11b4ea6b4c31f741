#include <doctest/doctest.h>

#include <stdexcept>

#include "crossing.hpp"
#include "fleets.hpp"
#include "problem/problem.hpp"

namespace rightofway {
namespace {

using test::Crossing;

TEST_CASE("arrays that do not fit together are refused") {
    Crossing far(5);
    far.home.back() = 99;
    CHECK_THROWS_AS(Problem(far.arrays(), {0, false}), std::invalid_argument);
    Crossing slow(5);
    slow.paces[1] = 0;
    CHECK_THROWS_AS(Problem(slow.arrays(), {0, false}), std::invalid_argument);
    Crossing idle(5);
    idle.first_stage[1] = 0;
    CHECK_THROWS_AS(Problem(idle.arrays(), {0, false}), std::invalid_argument);
    Crossing uneven(5);
    uneven.nothing.pop_back();
    CHECK_THROWS_AS(Problem(uneven.arrays(), {0, false}), std::invalid_argument);
    Crossing shared(5);
    shared.home[1] = shared.home[0];
    CHECK_THROWS_AS(Problem(shared.arrays(), {0, false}), std::invalid_argument);
    Crossing hasty(5);
    hasty.nothing[0] = -1;
    CHECK_THROWS_AS(Problem(hasty.arrays(), {0, false}), std::invalid_argument);
    Crossing lost(5);
    lost.heads[0] = 25;
    CHECK_THROWS_AS(Problem(lost.arrays(), {0, false}), std::invalid_argument);
    const Crossing fine(5);
    CHECK_THROWS_AS(Problem(fine.arrays(), {-1, false}), std::invalid_argument);
}

TEST_CASE("robots that keep a headway or book ahead cannot rotate") {
    const Crossing crossing(5);
    CHECK(Problem(crossing.arrays(), {0, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {0, false, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {1, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {0, true}).may_rotate());
}

TEST_CASE("what takes time, or more than one tick, is no step") {
    const auto moves_in_steps = [](const test::Robot& robot, BookingRules rules = {}) {
        const test::Fleet fleet(test::corridor(), {robot}, rules);
        return fleet.problem().moves_in_steps();
    };
    CHECK(moves_in_steps({0, {{1}, {2}}}));
    CHECK(moves_in_steps({0, {{1}, {2, 5}}}));  // nobody waits for work at an end
    CHECK(!moves_in_steps({0, {{1, 5}, {2}}}));
    CHECK(!moves_in_steps({0, {{1}}, 2}));
    CHECK(!moves_in_steps({0, {{1}}}, {1, false}));
    CHECK(!moves_in_steps({0, {{1}}}, {0, true}));
}

}  // namespace
}  // namespace rightofway
