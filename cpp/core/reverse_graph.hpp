// The edges of a graph by their heads: the reversed graph, and the opposite of each edge.
#pragma once

#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// Borrows nothing: stores the reversed edges in compressed sparse rows.
class ReverseGraph {
  public:
    explicit ReverseGraph(const Graph& graph);

    VertexId n_vertices() const { return static_cast<VertexId>(first_.size()) - 1; }
    std::size_t n_edges() const { return edge_.size(); }

    // The edges into a vertex in order of id, and the tail of each of them.
    std::span<const EdgeId> edges(VertexId head) const { return row(edge_, head); }
    std::span<const VertexId> tails(VertexId head) const { return row(tail_, head); }

  private:
    std::span<const std::int32_t> row(const std::vector<std::int32_t>& values,
                                      VertexId head) const {
        const auto first = index(first_[index(head)]);
        return {values.data() + first, index(first_[index(head + 1)]) - first};
    }

    std::vector<EdgeId> first_;  // edges into v: first_[v] .. first_[v + 1] - 1
    std::vector<EdgeId> edge_;
    std::vector<VertexId> tail_;
};

// The tail of each edge.
std::vector<VertexId> list_tails(const Graph& graph);

// The edge from head to tail of each edge, -1 if the graph has none.
std::vector<EdgeId> find_opposite_edges(const Graph& graph);

}  // namespace rightofway
