// The number of edges between single pairs of vertices, without a table for each target.
//
// A* with landmarks (ALT). The distance from a vertex to a landmark minus the distance from the
// target to the landmark is a lower bound of the distance to the target. Landmarks at the ends of
// the map make the bound tight, so the search expands few vertices beside the path.
//
// Goldberg & Harrelson, "Computing the shortest path: A* search meets graph theory", SODA 2005.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"
#include "distances/distance_tables.hpp"

namespace rightofway {

class AltDistance {
  public:
    static constexpr std::int32_t no_way = -1;

    // Borrows both. All landmarks are vertices from which a path leads to vertex 0.
    AltDistance(const Graph& graph, const DistanceTables& tables);

    // The least number of edges from a vertex to the target, or `no_way`.
    std::int32_t between(VertexId from, VertexId target);

  private:
    static constexpr std::size_t n_landmarks = 8;
    using Row = std::array<std::uint16_t, n_landmarks>;  // edges to each landmark
    struct Reached {
        std::int32_t steps;
        std::int32_t search;  // number of the search that set `steps`
    };

    void choose_landmarks(const DistanceTables& tables);
    std::int32_t bound(VertexId vertex) const;
    void reach(VertexId vertex, std::int32_t steps);

    Graph graph_;
    std::vector<Row> rows_;  // of each vertex
    Row target_row_{};
    std::vector<Reached> reached_;
    std::vector<std::vector<VertexId>> open_;  // buckets: estimate - first_bound_
    std::int32_t first_bound_ = 0;
    std::int32_t search_ = 0;
};

}  // namespace rightofway
