#include <doctest/doctest.h>

#include <stdexcept>

#include "precedence/incompatible_visits.hpp"

namespace rightofway::test {
namespace {

// Rows 0 to 3 are the vertices A, B, C, D; row 4 is the edge from A to B, row 5 that from C to D.
struct Lanes {
    std::vector<RobotId> robot{0, 0, 1, 1};
    std::vector<std::int32_t> vertex{0, 1, 2, 3};
    std::vector<std::int32_t> edge{4, none, 5, none};
    std::vector<std::int32_t> first;
    std::vector<std::int32_t> excluded;

    IncompatibleVisits visits() const {
        return IncompatibleVisits(robot, {vertex, edge, first, excluded});
    }
};

TEST_CASE("without sizes nothing is known") {
    CHECK_FALSE(IncompatibleVisits(std::vector<RobotId>{0, 1}, {}).is_known());
}

TEST_CASE("lanes that cross: only the edges driven out of the first visits count") {
    Lanes lanes;
    lanes.first = {0, 1, 2, 3, 4, 5, 6};
    lanes.excluded = {0, 1, 2, 3, 5, 4};
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(0).size() == 1);
    CHECK(visits.of(0)[0].visit == 2);
    CHECK(visits.of(0)[0].starts() == 3);
    CHECK(visits.of(0)[0].own_starts(0) == 1);
    CHECK(visits.of(1).empty());
}

TEST_CASE("of a vertex and an edge the earlier start counts") {
    Lanes lanes;
    lanes.first = {0, 2, 3, 5, 6, 7, 8};
    lanes.excluded = {0, 2, 1, 0, 2, 3, 5, 4};  // A and C, and both edges
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(2).size() == 1);
    CHECK(visits.of(2)[0].visit == 0);
    CHECK(visits.of(2)[0].starts() == 0);
    CHECK(visits.of(2)[0].own_starts(2) == 2);
}

TEST_CASE("vertex and edge crosswise: each pair of bookings begins by itself") {
    Lanes lanes;
    lanes.first = {0, 2, 3, 5, 6, 8, 10};
    lanes.excluded = {0, 5, 1, 2, 4, 3, 2, 4, 0, 5};  // A and C to D; C and A to B
    const IncompatibleVisits visits = lanes.visits();
    REQUIRE(visits.of(0).size() == 1);
    CHECK(visits.of(0)[0].starts() == 2);
    CHECK(visits.of(0)[0].own_starts(0) == 0);
    CHECK(visits.of(0)[0].bookings.begin({0, 17}, {5, 22}) == 17);
    CHECK(visits.of(0)[0].bookings.begin({0, 40}, {5, 22}) == 22);
    CHECK(visits.of(2)[0].bookings.begin({5, 22}, {0, 40}) == 22);
}

TEST_CASE("a row that does not exist is refused") {
    Lanes lanes;
    lanes.first = {0, 0, 0, 0, 0};
    CHECK_THROWS_AS(lanes.visits(), std::invalid_argument);
}

TEST_CASE("rows and lists that do not fit are refused with index and value") {
    Lanes lanes;
    lanes.first = {0, 1, 2, 3, 4, 5, 6};
    lanes.excluded = {0, 1, 2, 3, 5, 6};
    CHECK_THROWS_WITH(lanes.visits(), "excluded[5]: 6 is not in 0..5");
    lanes.excluded[5] = 4;
    lanes.vertex[2] = 6;
    CHECK_THROWS_WITH(lanes.visits(), "vertex_row[2]: 6 is not in 0..5");
    lanes.vertex[2] = 2;
    lanes.edge[3] = 5;  // its start would be that of the visit after the last one
    CHECK_THROWS_WITH(lanes.visits(),
                      "edge_row[3]: 5 must be -1: no edge is driven out of a last visit");
}

}  // namespace
}  // namespace rightofway::test
