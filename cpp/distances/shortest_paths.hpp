// Canonical shortest paths between single pairs of vertices, without a table for each target.
//
// Of all shortest paths, the canonical one takes the first possible edge at each vertex, as a walk
// down a distance table does. A depth-first search in the order of edges meets this path first if
// its budget is the distance. Landmarks (see alt_distance.hpp) bound what is left, and are nearly
// exact on grids, so that few vertices next to the path are visited.
//
// Korf, "Depth-first iterative-deepening: an optimal admissible tree search", Artificial
// Intelligence 27, 1985; Reinefeld & Marsland, "Enhanced iterative-deepening search", IEEE
// Transactions on Pattern Analysis and Machine Intelligence 16, 1994 (table of visited vertices).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"
#include "distances/distance_tables.hpp"

namespace rightofway {

class ShortestPaths {
  public:
    // Copies the graph. Edges and their ticks as for DistanceTables, which throws for faults.
    ShortestPaths(std::span<const EdgeId> indptr, std::span<const VertexId> indices,
                  std::span<const std::int32_t> edge_ticks);

    VertexId n_vertices() const { return graph_.n_vertices(); }

    // The vertices of the canonical shortest path, both ends included; empty if no path exists.
    // Throws std::invalid_argument for an unknown vertex, and std::overflow_error as
    // DistanceTables. Not thread-safe.
    std::vector<VertexId> find(VertexId start, VertexId target);

  private:
    static constexpr std::int32_t no_way = -1;
    static constexpr std::size_t n_landmarks = 8;
    using Row = std::array<std::int32_t, n_landmarks>;  // ticks to each landmark
    struct Visited {
        Tick ticks;
        std::int64_t search;  // number of the search that set `ticks`
    };
    struct Step {
        VertexId vertex;
        EdgeId next;  // edge to try
        Tick ticks;   // from the start
    };

    void choose_landmarks();
    Tick bound(VertexId vertex) const;
    bool search(VertexId start, VertexId target, Tick budget);
    std::vector<VertexId> walk(VertexId start, VertexId target) const;

    std::vector<EdgeId> indptr_;
    std::vector<VertexId> heads_;
    std::vector<std::int32_t> ticks_;
    Graph graph_;
    DistanceTables tables_;
    bool is_symmetric_ = true;  // every path may be driven back in the same time
    std::vector<Row> rows_;     // of each vertex; empty without landmarks
    Row target_row_{};
    std::vector<Visited> visited_;
    std::vector<Step> path_;
    Tick next_budget_ = never;
    std::int64_t steps_left_ = 0;
    std::int64_t n_searches_ = 0;
    std::int32_t n_paths_ = 0;
};

}  // namespace rightofway
