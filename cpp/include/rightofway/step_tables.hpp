// How many edges is it from here to there? Asked of many targets, and mostly of places near the
// way.
//
// One breadth-first search per target over the reversed edges, which goes on only until it has
// reached the vertex that was asked for, and is taken up again when one further away is asked for.
// Robots with one target share its table, whatever their speeds. Two bytes a vertex, and pages of
// memory that no search has reached stay untouched, so ten thousand targets on a large map fit.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "rightofway/graph.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

class StepTables {
  public:
    using TableId = std::int32_t;
    static constexpr std::int32_t unreachable = 1 << 24;  // far above every count, safe to add to

    // Borrows nothing: the graph is kept reversed.
    explicit StepTables(const Graph& graph);

    VertexId n_vertices() const { return static_cast<VertexId>(arriving_.size()) - 1; }

    // The table of a target, made at the first request.
    TableId table_of(VertexId target);

    // The least number of edges from a vertex to the target of a table, or `unreachable`. Throws
    // std::overflow_error if that does not fit the type.
    std::int32_t steps(TableId table, VertexId from) {
        const std::uint16_t cell = tables_[table].cells[from];
        return cell != 0 ? cell - 1 : search_on(table, from);
    }

  private:
    struct Free {
        void operator()(void* block) const { std::free(block); }
    };
    struct Table {
        std::uint16_t* cells;  // steps + 1, or 0 where the search has not been yet
        std::vector<VertexId> frontier;
        std::int32_t depth;  // of the frontier
    };

    std::uint16_t* new_cells();
    std::int32_t search_on(TableId table, VertexId from);
    void next_level(Table& table);

    std::vector<EdgeId> arriving_;  // the edges that arrive at v come from source_[k], for k in
    std::vector<VertexId> source_;  // arriving_[v] .. arriving_[v + 1] - 1
    std::vector<TableId> by_target_;
    std::vector<Table> tables_;
    std::vector<std::unique_ptr<std::uint16_t, Free>> blocks_;
    std::size_t free_in_block_ = 0;  // tables
    std::vector<VertexId> scratch_;
};

}  // namespace rightofway
