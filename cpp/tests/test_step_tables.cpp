#include <doctest/doctest.h>

#include <stdexcept>

#include "corridors.hpp"
#include "rightofway/step_tables.hpp"

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
