#include <doctest/doctest.h>

#include "corridors.hpp"
#include "distances/alt_distance.hpp"

namespace rightofway {
namespace {

// A grid whose edges all lead both ways but some, which lead east only.
struct Grid {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;

    Grid(VertexId rows, VertexId columns, VertexId one_way_row) {
        for (VertexId v = 0; v < rows * columns; ++v) {
            const VertexId row = v / columns;
            const VertexId column = v % columns;
            if (column + 1 < columns) {
                heads.push_back(v + 1);
            }
            if (row + 1 < rows) {
                heads.push_back(v + columns);
            }
            if (column > 0 && row != one_way_row) {
                heads.push_back(v - 1);
            }
            if (row > 0) {
                heads.push_back(v - columns);
            }
            indptr.push_back(static_cast<EdgeId>(heads.size()));
        }
    }
};

template <class Map>
void check_all_pairs(const Map& map) {
    const DistanceTables tables(map.indptr, map.heads);
    const std::vector<std::int32_t> ticks(map.heads.size(), 1);
    AltDistance ways({map.indptr, map.heads}, tables);
    for (VertexId target = 0; target < tables.n_vertices(); ++target) {
        const auto expected = tables.to(target, ticks);
        for (VertexId from = 0; from < tables.n_vertices(); ++from) {
            CHECK(ways.between(from, target) == expected[index(from)]);
        }
    }
}

TEST_CASE("ways between all pairs are as long as tables say") {
    check_all_pairs(Grid(5, 7, -1));
    check_all_pairs(test::corridor_with_bay());
}

TEST_CASE("a street in one direction is no way back") { check_all_pairs(Grid(4, 6, 2)); }

TEST_CASE("where one cannot come back from, landmarks do not mislead") {
    check_all_pairs(Grid(1, 6, 0));
}

TEST_CASE("parts of a map that are not joined have no way") {
    check_all_pairs(test::Roads{5, {{1, 2}, {3, 4}}});
}

}  // namespace
}  // namespace rightofway
