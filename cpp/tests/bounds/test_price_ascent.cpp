#include <doctest/doctest.h>

#include "bounds/price_ascent.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

using test::Fleet;

const StopCondition never_over = [] { return false; };

TEST_CASE("of two robots that cross a vertex at one tick, one loses a tick") {
    // R0 goes 0 1 2, R1 goes 3 1 4; alone they need 2 ticks each, and both would be at 1 at tick 1.
    const Fleet fleet({5, {{0, 1}, {1, 2}, {3, 1}, {1, 4}}}, {{0, {{2}}}, {3, {{4}}}});
    const Problem problem = fleet.problem();
    PriceAscent ascent(problem);
    CHECK(ascent.bound() == 0);
    ascent.run(1, never_over);
    CHECK(ascent.bound() == 4);
    ascent.run(200, never_over);
    CHECK(ascent.bound() == 5);
}

TEST_CASE("of three robots that cross a vertex at one tick, two lose three ticks together") {
    const Fleet fleet({7, {{0, 1}, {1, 2}, {3, 1}, {1, 4}, {5, 1}, {1, 6}}},
                      {{0, {{2}}}, {3, {{4}}}, {5, {{6}}}});
    const Problem problem = fleet.problem();
    PriceAscent ascent(problem);
    ascent.run(1000, never_over);
    CHECK(ascent.bound() == 9);
}

TEST_CASE("steps in parts keep the bound and go on") {
    const Fleet fleet({5, {{0, 1}, {1, 2}, {3, 1}, {1, 4}}}, {{0, {{2}}}, {3, {{4}}}});
    const Problem problem = fleet.problem();
    PriceAscent ascent(problem);
    ascent.run(3, never_over);
    const Tick before = ascent.bound();
    CHECK(before >= 4);
    ascent.run(0, never_over);
    CHECK(ascent.bound() == before);
    ascent.run(200, never_over);
    CHECK(ascent.bound() == 5);
}

}  // namespace
}  // namespace rightofway
