#include <doctest/doctest.h>

#include <stdexcept>

#include "corridors.hpp"
#include "lacam/untimed_lacam.hpp"

namespace rightofway {
namespace {

using Vertices = std::vector<VertexId>;

struct Problem {
    test::Roads roads;
    Vertices home;
    std::vector<std::int32_t> first_stage;
    Vertices stages;
    bool may_rotate = true;
    std::vector<std::uint8_t> ends_anywhere = {};

    SearchEnd run(Vertices& steps) const {
        const UntimedProblem goals{home, first_stage, stages, ends_anywhere};
        check(roads.graph(), goals);
        StepTables tables(roads.graph());
        UntimedLacam search(roads.graph(), goals, tables, may_rotate, 0);
        const SearchEnd end = search.run(test::no_deadline);
        steps = search.steps();
        return end;
    }
};

TEST_CASE("two robots change places where there is a bay") {
    Vertices steps;
    const Problem fleet{test::corridor_with_bay(), {0, 2}, {0, 1, 2}, {2, 0}};
    REQUIRE(fleet.run(steps) == SearchEnd::found);
    CHECK(Vertices(steps.end() - 2, steps.end()) == Vertices{2, 0});
}

TEST_CASE("without a bay they cannot, and that is proven") {
    Vertices steps;
    const Problem fleet{test::corridor(), {0, 3}, {0, 1, 2}, {3, 0}};
    CHECK(fleet.run(steps) == SearchEnd::proven_none);
    CHECK(steps.empty());
}

TEST_CASE("a robot that may end anywhere gets out of the way, and one that needs not stays") {
    Vertices steps;
    const Problem fleet{test::corridor(), {0, 2}, {0, 1, 2}, {2, 2}, true, {0, 1}};
    REQUIRE(fleet.run(steps) == SearchEnd::found);
    CHECK(Vertices(steps.end() - 2, steps.end()) == Vertices{2, 3});
    const Problem done{test::corridor(), {0, 2}, {0, 1, 2}, {0, 2}, true, {0, 1}};
    REQUIRE(done.run(steps) == SearchEnd::found);
    CHECK(steps == Vertices{0, 2});
}

TEST_CASE("stages are passed one after the other") {
    Vertices steps;
    const Problem fleet{test::corridor(), {1}, {0, 3}, {3, 0, 1}};
    REQUIRE(fleet.run(steps) == SearchEnd::found);
    CHECK(steps == Vertices{1, 2, 3, 2, 1, 0, 1});
}

TEST_CASE("a full ring turns in one step, if it may") {
    const test::Roads ring{3, {{0, 1}, {1, 2}, {2, 0}}};
    Vertices steps;
    Problem fleet{ring, {0, 1, 2}, {0, 1, 2, 3}, {1, 2, 0}};
    REQUIRE(fleet.run(steps) == SearchEnd::found);
    CHECK(steps == Vertices{0, 1, 2, 1, 2, 0});
    fleet.may_rotate = false;
    CHECK(fleet.run(steps) == SearchEnd::proven_none);
}

TEST_CASE("a search that is told to stop proves nothing") {
    const test::Roads ring{5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    const Vertices home{0, 1, 2};
    const std::vector<std::int32_t> first_stage{0, 1, 2, 3};
    const Vertices stages{2, 1, 2};  // two robots for one place: many steps, no way
    const UntimedProblem goals{home, first_stage, stages};
    StepTables tables(ring.graph());
    UntimedLacam search(ring.graph(), goals, tables, true, 0);
    CHECK(search.run([] { return true; }) == SearchEnd::stopped);
}

TEST_CASE("a robot without a stage is refused") {
    Vertices steps;
    const Problem fleet{test::corridor(), {0, 1}, {0, 1, 1}, {3}};
    CHECK_THROWS_AS(fleet.run(steps), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
