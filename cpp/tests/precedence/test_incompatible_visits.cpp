#include <doctest/doctest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "drawn_lanes.hpp"
#include "precedence/incompatible_visits.hpp"

namespace rightofway::test {
namespace {

// The first robot drives from A to B, the other one from C to D. Rows 0 to 3 are these vertices,
// row 4 is the edge from A to B, row 5 that from C to D.
struct Lanes {
    std::vector<RobotId> robot{0, 0, 1, 1};
    std::vector<std::int32_t> vertex{0, 1, 2, 3};
    std::vector<std::int32_t> edge{4, none, 5, none};
    RowFinder finder;

    explicit Lanes(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& places)
        : finder(DrawnLanes(places, {{0, 1}, {2, 3}}, 10).finder()) {}
    IncompatibleVisits visits() const {
        return IncompatibleVisits(robot, {vertex, edge, {&finder}});
    }
};

TEST_CASE("without sizes nothing is known") {
    CHECK_FALSE(IncompatibleVisits(std::vector<RobotId>{0, 1}, {}).is_known());
}

TEST_CASE("lanes that cross: only the edges driven out of the first visits count") {
    const Lanes lanes({{0, 20}, {40, 20}, {20, 0}, {20, 40}});
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(0).size() == 1);
    CHECK(visits.of(0)[0].visit == 2);
    CHECK(visits.of(0)[0].starts() == 3);
    CHECK(visits.of(0)[0].own_starts(0) == 1);
    CHECK(visits.of(1).empty());
}

TEST_CASE("of a vertex and an edge the earlier start counts") {
    const Lanes lanes({{0, 0}, {40, 40}, {5, 0}, {0, 40}});  // A and C are near, and both edges
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(2).size() == 1);
    CHECK(visits.of(2)[0].visit == 0);
    CHECK(visits.of(2)[0].starts() == 0);
    CHECK(visits.of(2)[0].own_starts(2) == 2);
}

TEST_CASE("vertex and edge crosswise: each pair of bookings begins by itself") {
    // Against each other, side by side: A is near to the middle of C-D, and C to that of A-B.
    const Lanes lanes({{20, 0}, {60, 0}, {40, 6}, {0, 6}});
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(0).size() == 1);
    CHECK(visits.of(0)[0].starts() == 2);
    CHECK(visits.of(0)[0].own_starts(0) == 0);
    CHECK(visits.of(0)[0].bookings.begin({0, 17}, {5, 22}) == 17);
    CHECK(visits.of(0)[0].bookings.begin({0, 40}, {5, 22}) == 22);
    CHECK(visits.of(2)[0].bookings.begin({5, 22}, {0, 40}) == 22);
}

TEST_CASE("rows that do not fit are refused with index and value") {
    Lanes lanes({{0, 20}, {40, 20}, {20, 0}, {20, 40}});
    lanes.vertex[2] = 6;
    CHECK_THROWS_WITH(lanes.visits(), "vertex_row[2]: 6 is not in -1..5");
    lanes.vertex[2] = 2;
    lanes.edge[3] = 5;  // its start would be that of the visit after the last one
    CHECK_THROWS_WITH(lanes.visits(),
                      "edge_row[3]: 5 must be -1: no edge is driven out of a last visit");
}

}  // namespace
}  // namespace rightofway::test
