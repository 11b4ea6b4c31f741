// Tables of edge counts to many targets, computed lazily, mostly near the routes.
//
// One breadth-first search per target over the reversed edges stops at the requested vertex and
// resumes at the next request beyond it. Robots of all speeds with one target share its table. A
// table consists of lines of one cache line each; a line holds neighbouring vertices, so successive
// requests of a robot mostly read one line. If every edge has an opposite edge, the counts of a
// line differ by a few steps: a line stores a base and 1 byte per vertex (10 000 targets on a large
// map fit into memory). On other graphs a vertex takes 2 bytes.
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

    // Borrows nothing: stores the reversed graph.
    explicit StepTables(const Graph& graph);

    VertexId n_vertices() const { return static_cast<VertexId>(place_.size()); }

    // The table of a target; the first request makes it.
    TableId table_of(VertexId target);

    // The least number of edges from a vertex to the target of a table, or `unreachable`. Throws
    // std::overflow_error if the number does not fit uint16.
    std::int32_t steps(TableId table, VertexId from) {
        const std::int32_t known = read(cells_[index(table)], place_[index(from)]);
        return known >= 0 ? known : search_on(table, from);
    }

    // Extends each table up to a vertex, on all cores; the counts do not depend on the threads.
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

    // A line of bytes begins with its base: least steps of the line + 1. A cell is steps - least
    // steps + 1, a wide cell is steps + 1. 0: not searched.
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
    template <bool is_wide>
    static void write(Byte* table, Place place, std::int32_t steps);

    void find_places(const Graph& graph);
    Byte* new_cells();
    std::int32_t search_on(TableId table, VertexId from);
    void search_up_to(TableId table, VertexId from, std::vector<Place>& reached);
    template <bool is_wide>
    void search_up_to(TableId table, VertexId from, std::vector<Place>& reached);

    bool is_wide_;
    std::vector<Place> place_;      // of each vertex
    Place size_ = 0;                // of a table [bytes]
    std::vector<EdgeId> arriving_;  // edges into a place: tails are source_[k], for k
    std::vector<Place> source_;     // in arriving_[place] .. arriving_[place + 1] - 1
    std::vector<TableId> by_target_;
    std::vector<Byte*> cells_;      // of each table
    std::vector<Search> searches_;  // of each table
    std::vector<std::unique_ptr<Byte, Free>> blocks_;
    Byte* next_cells_ = nullptr;  // in the last block
    std::size_t n_free_ = 0;      // free bytes in the last block
    std::vector<Place> reached_;  // of the latest search
};

// `found` if each robot, driving alone, can reach all of its stages.
SearchEnd reach_all(const Problem& problem, StepTables& tables, const StopCondition& is_over);

}  // namespace rightofway
