// How many edges is it from one vertex to another? Asked once each of many pairs.
//
// A table for each target would be made to read one number. A* with landmarks finds it on a few
// vertices beside the way: how far a vertex is from a landmark, less how far the target is from
// it, is a bound from below, and landmarks at the ends of the map make it a good one.
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

    // Borrows both. The landmarks are chosen in what leads to the first vertex.
    AltDistance(const Graph& graph, const DistanceTables& tables);

    // The least number of edges from one vertex to another, or `no_way`.
    std::int32_t between(VertexId from, VertexId target);

  private:
    static constexpr std::size_t n_landmarks = 8;
    using Row = std::array<std::uint16_t, n_landmarks>;  // how far it is to each landmark
    struct Reached {
        std::int32_t steps;
        std::int32_t search;  // in which that was
    };

    void choose_landmarks(const DistanceTables& tables);
    std::int32_t bound(VertexId vertex) const;
    void reach(VertexId vertex, std::int32_t steps);

    Graph graph_;
    std::vector<Row> rows_;  // of each vertex
    Row target_row_{};
    std::vector<Reached> reached_;
    std::vector<std::vector<VertexId>> open_;  // by what the way is at least, from the first bound
    std::int32_t first_bound_ = 0;
    std::int32_t search_ = 0;
};

}  // namespace rightofway
