#include <doctest/doctest.h>

#include <stdexcept>
#include <utility>

#include "corridors.hpp"
#include "distances/step_tables.hpp"

namespace rightofway {
namespace {

TEST_CASE("steps are counted to the target, however far one asks first") {
    const test::Roads roads = test::corridor();
    StepTables tables(roads.graph());
    const auto to_0 = tables.table_of(0);
    CHECK(tables.steps(to_0, 0) == 0);
    CHECK(tables.steps(to_0, 3) == 3);
    CHECK(tables.steps(to_0, 1) == 1);
}

TEST_CASE("steps follow the edges, not against them") {
    const std::vector<EdgeId> indptr{0, 1, 2, 3};  // 0 -> 1 -> 2 -> 0
    const std::vector<VertexId> heads{1, 2, 0};
    StepTables tables({indptr, heads});
    CHECK(tables.steps(tables.table_of(0), 1) == 2);
}

TEST_CASE("robots with one target share a table") {
    const test::Roads roads = test::corridor();
    StepTables tables(roads.graph());
    const auto first = tables.table_of(2);
    CHECK(tables.table_of(1) != first);
    CHECK(tables.table_of(2) == first);
}

TEST_CASE("where no way leads, that is said again and again") {
    const test::Roads roads{3, {{0, 1}}};
    StepTables tables(roads.graph());
    const auto to_0 = tables.table_of(0);
    CHECK(tables.steps(to_0, 2) == StepTables::unreachable);
    CHECK(tables.steps(to_0, 2) == StepTables::unreachable);
    CHECK(tables.steps(to_0, 1) == 1);
}

// Rows of vertices, joined to those beside, above and below; in one direction only in `one_way`.
void check_grid(VertexId rows, VertexId columns, VertexId one_way) {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;
    for (VertexId v = 0; v < rows * columns; ++v) {
        const VertexId row = v / columns;
        const VertexId column = v % columns;
        for (const auto& [is_joined, head] :
             {std::pair{column + 1 < columns, v + 1}, std::pair{row + 1 < rows, v + columns},
              std::pair{column > 0 && row != one_way, v - 1}, std::pair{row > 0, v - columns}}) {
            if (is_joined) {
                heads.push_back(head);
            }
        }
        indptr.push_back(static_cast<EdgeId>(heads.size()));
    }
    const DistanceTables expected(indptr, heads);
    StepTables tables({indptr, heads});
    for (const VertexId target : {VertexId{0}, rows * columns / 2, rows * columns - 1}) {
        const auto ticks = expected.to(target, std::vector<std::int32_t>(heads.size(), 1));
        const auto table = tables.table_of(target);
        for (VertexId v = rows * columns - 1; v >= 0; --v) {
            REQUIRE(tables.steps(table, v) == ticks[index(v)]);
        }
    }
}

TEST_CASE("on a map of many lines all steps are right") {
    check_grid(40, 90, -1);
    check_grid(1, 700, -1);
}

TEST_CASE("on a map with a one-way street as well") { check_grid(40, 90, 7); }

TEST_CASE("a way of more steps than two bytes hold is refused") {
    const VertexId n = 70'000;
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;
    for (VertexId v = 0; v < n; ++v) {  // each leads to the one before it
        if (v > 0) {
            heads.push_back(v - 1);
        }
        indptr.push_back(static_cast<EdgeId>(heads.size()));
    }
    StepTables tables({indptr, heads});
    const auto to_0 = tables.table_of(0);
    CHECK(tables.steps(to_0, 65'534) == 65'534);
    CHECK_THROWS_AS(tables.steps(to_0, n - 1), std::overflow_error);
}

TEST_CASE("a target that is no vertex is refused") {
    const test::Roads roads = test::corridor();
    StepTables tables(roads.graph());
    CHECK_THROWS_AS(tables.table_of(4), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
