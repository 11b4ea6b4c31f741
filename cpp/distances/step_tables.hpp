// How many edges is it from here to there? Asked of many targets, and mostly of places near the
// way.
//
// One breadth-first search per target over the reversed edges, which goes on only until it has
// reached the vertex that was asked for, and is taken up again when one further away is asked for.
// Robots with one target share its table, whatever their speeds. Tables are made of lines, as the
// processor's cache is: each holds vertices near each other, whatever their numbers, so what a
// robot asks for lies next to what it asked for before. Where every edge leads back, these differ
// by a few steps, and one byte a vertex above a base for each line does: ten thousand targets on a
// large map fit. On other graphs it takes two bytes.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/search_end.hpp"
#include "core/types.hpp"
#include "problem/problem.hpp"

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
        const std::int32_t known = read(cells_[table], place_[from]);
        return known >= 0 ? known : search_on(table, from);
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
    using Place = std::int32_t;  // of a vertex in each table [bytes]
    using Byte = std::uint8_t;
    static constexpr Place line_size = 64;
    struct Search {
        std::vector<Place> frontier;
        std::int32_t depth;  // of the frontier
    };

    // A line of bytes begins with its base, the least steps in it, plus 1; a cell is the steps
    // above the least, plus 1. A wide cell is the steps plus 1. Where it is 0, the search has not
    // been yet.
    std::int32_t read(const Byte* table, Place place) const {
        if (is_wide_) {
            return std::int32_t{*reinterpret_cast<const std::uint16_t*>(table + place)} - 1;
        }
        const Byte cell = table[place];
        return cell == 0 ? -1 : base(table, place) + cell - 2;
    }
    static std::uint16_t base(const Byte* table, Place place) {
        return *reinterpret_cast<const std::uint16_t*>(table + place / line_size * line_size);
    }
    void write(Byte* table, Place place, std::int32_t steps) const;

    void find_places(const Graph& graph);
    Byte* new_cells();
    std::int32_t search_on(TableId table, VertexId from);
    void next_level(TableId table, std::vector<Place>& scratch);

    bool is_wide_;
    std::vector<Place> place_;      // of each vertex
    Place size_ = 0;                // of a table
    std::vector<EdgeId> arriving_;  // the edges that arrive at a place come from source_[k], for k
    std::vector<Place> source_;     // in arriving_[place] .. arriving_[place + 1] - 1
    std::vector<TableId> by_target_;
    std::vector<Byte*> cells_;      // of each table
    std::vector<Search> searches_;  // of each table
    std::vector<std::unique_ptr<Byte, Free>> blocks_;
    Byte* next_cells_ = nullptr;  // in the last block
    std::size_t n_free_ = 0;      // bytes there
    std::vector<Place> scratch_;
};

// Whether every robot, if it were alone, could go through all of its stages: `found` if so.
SearchEnd reach_all(const Problem& problem, StepTables& tables, const StopCondition& is_over);

}  // namespace rightofway
