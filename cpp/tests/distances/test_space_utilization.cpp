#include <doctest/doctest.h>

#include "distances/space_utilization.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

// Two ways of two edges between 0 and 2: by 1 and by 3; the bay 4 is at 1.
test::Roads two_ways() { return {5, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {1, 4}}}; }

TEST_CASE("who comes the other way takes the other one") {
    test::Fleet fleet{two_ways(), {{0, {{2}}}, {2, {{0}}}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    REQUIRE(paths.choose(test::no_deadline));
    const VertexId first_by = paths.next(0, 0);
    const VertexId second_by = paths.next(1, 2);
    CHECK(first_by + second_by == 4);  // one by 1, one by 3
    CHECK(paths.next(0, first_by) == 2);
    CHECK(paths.next(0, second_by) == -1);
}

TEST_CASE("nobody drives over a robot at the end of its trip if there is another way") {
    // Robot 0 ends at 1 at tick 1; a slow robot would pass there later.
    test::Fleet fleet{two_ways(), {{4, {{1}}}, {0, {{2}}, 5}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    REQUIRE(paths.choose(test::no_deadline));
    CHECK(paths.next(1, 0) == 3);
}

TEST_CASE("each leg of a trip has its own path") {
    test::Fleet fleet{test::corridor(), {{0, {{3}, {0}}}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    CHECK(paths.next(0, 1) == -1);  // none is chosen yet
    REQUIRE(paths.choose(test::no_deadline));
    CHECK(paths.next(0, 1) == 2);
    CHECK(paths.next(1, 1) == 0);
}

TEST_CASE("so many legs that there is no time for any have no paths") {
    std::vector<test::Stage> stages;
    for (int lap = 0; lap < 3001; ++lap) {
        stages.push_back({3});
        stages.push_back({0});
    }
    test::Fleet fleet{test::corridor(), {{0, stages}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    REQUIRE(paths.choose(test::no_deadline));
    CHECK(paths.next(0, 1) == -1);
}

TEST_CASE("choosing paths can be stopped") {
    test::Fleet fleet{test::corridor(), {{0, std::vector<test::Stage>(100, {3})}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    CHECK_FALSE(paths.choose([] { return true; }));
}

}  // namespace
}  // namespace rightofway
