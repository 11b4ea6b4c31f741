#include <doctest/doctest.h>

#include <vector>

#include "fleets.hpp"
#include "lns/fleet_search.hpp"
#include "lns/one_at_a_time.hpp"

namespace rightofway {
namespace {

using test::Fleet;

std::vector<Tick> ends_of(const FleetSearch& search, RobotId robot) {
    return search.plan().track(robot).ends;
}

// Homes 2 and 3 at a corridor of which 1 is the middle, work at 0.
TEST_CASE("robots whose stages wait for each other in turn move one at a time") {
    const Fleet fleet(test::Roads(4, {{0, 1}, {1, 2}, {1, 3}}),
                      {{2, {{0, 3}, {0, 3}, {2}}}, {3, {{0, 3}, {3}}}});
    // The first robot works, then the second robot, then the first one again.
    const std::vector<std::int32_t> before{0, 3};
    const std::vector<std::int32_t> after{3, 1};
    const Problem problem = fleet.problem_with_times(before, after);
    FleetSearch search(problem, 0, 1);
    REQUIRE(search.move_one_at_a_time(test::no_deadline));
    // Two ticks there, three of work, two home: 7, then 14, then 21.
    CHECK(ends_of(search, 0) == std::vector<Tick>{5, 19, 21});
    CHECK(ends_of(search, 1) == std::vector<Tick>{12, 14});
    const Tick cost = search.cost();
    search.improve(200, 200, test::no_deadline, test::no_deadline);
    CHECK(search.cost() < cost);
    CHECK(ends_of(search, 0)[0] <= ends_of(search, 1)[0] - 3);
    CHECK(ends_of(search, 1)[0] <= ends_of(search, 0)[1] - 3);
}

TEST_CASE("a robot in the home of another one drives home first") {
    const Fleet fleet(test::corridor(), {{0, {{1}}}, {1, {{3}, {2}}}});
    const Problem problem = fleet.problem_with_times();
    FleetSearch search(problem, 0, 1);
    REQUIRE(search.move_one_at_a_time(test::no_deadline));
    CHECK(search.plan().track(1).visits.back().vertex == 2);
    CHECK(search.plan().track(0).visits.back().vertex == 1);
}

TEST_CASE("stages of which each waits for the other have no plan") {
    const Fleet fleet(test::corridor(), {{0, {{1}, {0}}}, {3, {{2}, {3}}}});
    const std::vector<std::int32_t> before{0, 2};
    const std::vector<std::int32_t> after{2, 0};
    const Problem problem = fleet.problem_with_times(before, after);
    FleetSearch search(problem, 0, 1);
    CHECK_FALSE(search.move_one_at_a_time(test::no_deadline));
}

}  // namespace
}  // namespace rightofway
