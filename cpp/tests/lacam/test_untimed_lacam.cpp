#include <doctest/doctest.h>

#include "fleets.hpp"
#include "lacam/untimed_lacam.hpp"

namespace rightofway {
namespace {

using Vertices = std::vector<VertexId>;

SearchEnd run(const test::Fleet& fleet, Vertices& steps,
              const std::vector<std::uint8_t>& ends_anywhere = {}) {
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    UntimedLacam search(problem, tables, 0, ends_anywhere);
    const SearchEnd end = search.run(test::no_deadline);
    steps = search.steps();
    return end;
}

TEST_CASE("two robots change places where there is a bay") {
    Vertices steps;
    const test::Fleet fleet(test::corridor_with_bay(), {{0, {{2}}}, {2, {{0}}}});
    REQUIRE(run(fleet, steps) == SearchEnd::found);
    CHECK(Vertices(steps.end() - 2, steps.end()) == Vertices{2, 0});
}

TEST_CASE("without a bay they cannot, and that is proven") {
    Vertices steps;
    const test::Fleet fleet(test::corridor(), {{0, {{3}}}, {3, {{0}}}});
    CHECK(run(fleet, steps) == SearchEnd::proven_none);
    CHECK(steps.empty());
}

TEST_CASE("a robot that may end anywhere gets out of the way, and one that needs not stays") {
    Vertices steps;
    const test::Fleet fleet(test::corridor(), {{0, {{2}}}, {2, {{2}}}});
    REQUIRE(run(fleet, steps, {0, 1}) == SearchEnd::found);
    CHECK(Vertices(steps.end() - 2, steps.end()) == Vertices{2, 3});
    const test::Fleet done(test::corridor(), {{0, {{0}}}, {2, {{2}}}});
    REQUIRE(run(done, steps, {0, 1}) == SearchEnd::found);
    CHECK(steps == Vertices{0, 2});
}

TEST_CASE("stages are passed one after the other") {
    Vertices steps;
    const test::Fleet fleet(test::corridor(), {{1, {{3}, {0}, {1}}}});
    REQUIRE(run(fleet, steps) == SearchEnd::found);
    CHECK(steps == Vertices{1, 2, 3, 2, 1, 0, 1});
}

TEST_CASE("a full ring turns in one step, if it may") {
    const test::Roads ring{3, {{0, 1}, {1, 2}, {2, 0}}};
    Vertices steps;
    const std::vector<test::Robot> robots{{0, {{1}}}, {1, {{2}}}, {2, {{0}}}};
    REQUIRE(run(test::Fleet(ring, robots), steps) == SearchEnd::found);
    CHECK(steps == Vertices{0, 1, 2, 1, 2, 0});
    CHECK(run(test::Fleet(ring, robots, {0, false, false}), steps) == SearchEnd::proven_none);
}

TEST_CASE("a circle of one-way lanes that never comes back has no room for a swap") {
    // 0 = 1, and one way 0 > 2 > 3 > 4 > 2: a robot that backs away from 1 goes round for ever.
    test::Roads roads(5, {});
    roads.indptr = {0, 2, 3, 4, 5, 6};
    roads.heads = {1, 2, 0, 3, 4, 2};
    Vertices steps;
    CHECK(run(test::Fleet(roads, {{0, {{1}}}, {1, {{0}}}}), steps) == SearchEnd::proven_none);
}

TEST_CASE("a search that is told to stop proves nothing") {
    const test::Roads ring{5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    // Two robots for one place: many steps, no way.
    const test::Fleet fleet(ring, {{0, {{2}}}, {1, {{1}}}, {2, {{2}}}});
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    UntimedLacam search(problem, tables, 0);
    CHECK(search.run([] { return true; }) == SearchEnd::stopped);
}

}  // namespace
}  // namespace rightofway
