// How many edges is it from here to there? Asked of many targets, and mostly of places near the
// way.
//
// One breadth-first search per target over the reversed edges, which goes on only until it has
// reached the vertex that was asked for, and is taken up again when one further away is asked for.
// Robots with one target share its table, whatever their speeds. Two bytes a vertex, and pages of
// memory that no search has reached stay untouched, so ten thousand targets on a large map fit.
// What a robot asks for lies next to what it asked for before: vertices near each other share a
// line of the processor's cache, whatever their numbers.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "rightofway/graph.hpp"
#include "rightofway/search_end.hpp"
#include "rightofway/types.hpp"
#include "rightofway/untimed_fleet.hpp"

namespace rightofway {

class StepTables {
  public:
    using TableId = std::int32_t;
    static constexpr std::int32_t unreachable = 1 << 24;  // far above every count, safe to add to

    // Borrows nothing: the graph is kept reversed.
    explicit StepTables(const Graph& graph);

    VertexId n_vertices() const { return static_cast<VertexId>(place_.size()); }

    // The table of a target, made at the first request.
    TableId table_of(VertexId target);

    // The least number of edges from a vertex to the target of a table, or `unreachable`. Throws
    // std::overflow_error if that does not fit the type.
    std::int32_t steps(TableId table, VertexId from) {
        const std::uint16_t cell = cells_[table][place_[from]];
        return cell != 0 ? cell - 1 : search_on(table, from);
    }

    // Searches tables as far as a vertex each, on all cores; what comes out is the same.
    struct Request {
        TableId table;
        VertexId from;
    };
    void search_all(std::span<const Request> requests);

  private:
    struct Free {
        void operator()(void* block) const { std::free(block); }
    };
    using Place = std::int32_t;  // of a vertex in each table
    using Cell = std::uint16_t;  // steps + 1, or 0 where the search has not been yet
    struct Search {
        std::vector<Place> frontier;
        std::int32_t depth;  // of the frontier
    };

    void find_places(const Graph& graph);
    Cell* new_cells();
    std::int32_t search_on(TableId table, VertexId from);
    void next_level(TableId table, std::vector<Place>& scratch);

    std::vector<Place> place_;      // of each vertex
    std::vector<EdgeId> arriving_;  // the edges that arrive at a place come from source_[k], for k
    std::vector<Place> source_;     // in arriving_[place] .. arriving_[place + 1] - 1
    std::vector<TableId> by_target_;
    std::vector<Cell*> cells_;      // of each table
    std::vector<Search> searches_;  // of each table
    std::vector<std::unique_ptr<Cell, Free>> blocks_;
    Cell* next_cells_ = nullptr;  // in the last block
    std::size_t n_free_ = 0;      // cells there
    std::vector<Place> scratch_;
};

// Whether every robot, if it were alone, could go through all of its stages: `found` if so.
SearchEnd reach_all(const Goals& goals, StepTables& tables, const std::function<bool()>& is_over);

}  // namespace rightofway
