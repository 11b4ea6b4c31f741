#include <doctest/doctest.h>

#include <stdexcept>

#include "fleets.hpp"
#include "lacam/lacam.hpp"

namespace rightofway {
namespace {

using Vertices = std::vector<VertexId>;
using Ticks = std::vector<Tick>;

constexpr std::int64_t patience = 100'000;

Tracks plan(test::Fleet& fleet, SearchEnd expected = SearchEnd::found) {
    const Problem problem = fleet.problem();

    StepTables tables(problem.graph());
    SpaceUtilization paths(problem, tables);
    REQUIRE(paths.choose(test::no_deadline));
    Lacam search(problem, tables, paths, 0);
    CHECK(search.run(test::no_deadline, patience) == expected);
    return search.tracks();
}

TEST_CASE("a robot alone drives without a wait, works and comes home") {
    test::Fleet fleet{test::corridor(), {{0, {{2, 7}, {0}}, 3}}};
    const Tracks tracks = plan(fleet);
    CHECK(tracks.vertex == Vertices{0, 1, 2, 1, 0});
    CHECK(tracks.enter == Ticks{0, 3, 6, 16, 19});  // 7 ticks of work at vertex 2
}

TEST_CASE("who follows a slow robot enters as it leaves") {
    test::Fleet fleet{test::corridor(), {{0, {{2}}}, {1, {{3}}, 5}}};
    const Tracks tracks = plan(fleet);
    CHECK(tracks.first_visit == std::vector<VisitId>{0, 3, 6});
    CHECK(tracks.enter == Ticks{0, 5, 10, 0, 5, 10});
}

TEST_CASE("who books ahead starts to drive when the robot in front has left") {
    test::Fleet fleet{test::corridor(), {{0, {{1}}, 2}, {1, {{2}}, 5}}, {1, true}};
    const Tracks tracks = plan(fleet);
    CHECK(tracks.enter == Ticks{0, 8, 0, 5});  // left at 5, headway 1, two ticks to drive
}

TEST_CASE("two robots change places where there is a bay") {
    test::Fleet fleet{test::corridor_with_bay(), {{0, {{2}}, 2}, {2, {{0}}, 3}}};
    const Tracks tracks = plan(fleet);
    CHECK(tracks.vertex[index(tracks.first_visit[1] - 1)] == 2);
    CHECK(tracks.vertex.back() == 0);
}

TEST_CASE("without a bay the search ends without a plan") {
    test::Fleet fleet{test::corridor(), {{0, {{3}}, 2}, {3, {{0}}, 3}}};
    CHECK(plan(fleet, SearchEnd::stopped).vertex.empty());
}

TEST_CASE("a full ring turns at one instant, that of its slowest, if it may") {
    const test::Roads ring{3, {{0, 1}, {1, 2}, {2, 0}}};
    const std::vector<test::Robot> robots{{0, {{1}}, 1}, {1, {{2}}, 4}, {2, {{0}}, 2}};
    test::Fleet may{ring, robots};
    CHECK(plan(may).enter == Ticks{0, 4, 0, 4, 0, 4});
    test::Fleet may_not{ring, robots, {0, false, false}};
    CHECK(plan(may_not, SearchEnd::stopped).vertex.empty());
}

TEST_CASE("a robot at the end of its trip makes room and comes back") {
    test::Fleet fleet{test::corridor_with_bay(), {{0, {{2}}}, {1, {{1}}}}};
    const Tracks tracks = plan(fleet);
    CHECK(tracks.vertex == Vertices{0, 1, 2, 1, 3, 1});
}

TEST_CASE("a search that is told to stop stops") {
    const test::Roads ring{5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    test::Fleet fleet{ring, {{0, {{2}}}, {1, {{1}}}, {2, {{2}}}}};  // two for one place
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    const SpaceUtilization paths(problem, tables);
    Lacam search(problem, tables, paths, 0);
    CHECK(search.run([] { return true; }, patience) == SearchEnd::stopped);
}

TEST_CASE("a stage out of reach is noticed") {
    test::Fleet fleet{test::Roads{3, {{0, 1}}}, {{0, {{1}, {2}}}}};
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    CHECK(reach_all(problem, tables, test::no_deadline) == SearchEnd::proven_none);
}

}  // namespace
}  // namespace rightofway
