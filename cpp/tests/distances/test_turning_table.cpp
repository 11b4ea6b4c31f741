#include <doctest/doctest.h>

#include <vector>

#include "distances/distance_tables.hpp"
#include "distances/turning_table.hpp"

namespace rightofway {
namespace {

// Vertices 0, 1 and 2 with a corner at 1. The robot drives an edge in 1 tick, turns round the
// corner in 2 and back in 4, and works for 3 at vertex 2 before it comes home to 0.
struct Corner {
    std::vector<EdgeId> indptr{0, 1, 3, 4};
    std::vector<VertexId> heads{1, 0, 2, 1};
    std::vector<std::int32_t> length_class{0, 0, 0, 0};
    std::vector<std::int32_t> paces{1};
    std::vector<std::int32_t> pace_of{0};
    std::vector<VertexId> home{0};
    std::vector<std::int32_t> first_stage{0, 2};
    std::vector<VertexId> stage_vertex{2, 0};
    std::vector<Tick> stage_work{3, 0};
    std::vector<Tick> stage_turn{0, 0};
    // After edge 0: 1 and 2; after edge 1: 0; after edge 2: 3; after edge 3: 1 and 2.
    std::vector<std::int64_t> offset{-1, 2, 0, 3};
    std::vector<std::int32_t> kind{1, 0, 1, 1, 0, 1};
    std::vector<std::int32_t> class_of{0};
    std::vector<std::int32_t> ticks{2, 4};

    Problem problem() const {
        return Problem({indptr, heads, length_class, paces, pace_of, home, first_stage,
                        stage_vertex, stage_work, stage_turn, 1},
                       {}, {}, {offset, kind, class_of, ticks, 2});
    }
};

TEST_CASE("what is left of a trip depends on the edge driven in") {
    const Corner corner;
    const Problem problem = corner.problem();
    const TurningTable table(problem, 0);
    CHECK(table.from(-1, 0) == 15);  // 1 + 2 + 1, work 3, 4 + 1 + 2 + 1
    CHECK(table.from(0, 0) == 14);
    CHECK(table.from(2, 0) == 11);
    CHECK(table.from(3, 0) == 16);  // heads away from the stop: 4 + 1, then as from edge 2
    CHECK(table.from(2, 1) == 8);
    CHECK(table.from(3, 1) == 3);
    CHECK(table.from(1, 1) == 0);
}

TEST_CASE("a search ahead finds the completion time of the table") {
    const Corner corner;
    const Problem problem = corner.problem();
    const DistanceTables tables(corner.indptr, corner.heads);
    const std::vector<std::int32_t> ticks(corner.heads.size(), 1);
    const auto to_stop = tables.to(2, ticks);
    const auto to_home = tables.to(0, ticks);
    const std::vector<DistanceView> to_stage{{to_stop.data(), 1}, {to_home.data(), 1}};
    CHECK(least_completion_with_turns(problem, 0, to_stage) == 15);
}

TEST_CASE("turns that lead out of their arrays are refused") {
    Corner corner;
    corner.offset[3] = 9;
    CHECK_THROWS_WITH(corner.problem(), "turn_offset[3]: 9 leads out of turn_kind");
}

}  // namespace
}  // namespace rightofway
