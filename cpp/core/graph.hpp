// The directed graph that robots drive on, borrowed, in compressed rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/types.hpp"

namespace rightofway {

struct Graph {
    std::span<const EdgeId> indptr;     // the edges that leave v: indptr[v] .. indptr[v + 1] - 1
    std::span<const VertexId> indices;  // where each edge ends

    VertexId n_vertices() const { return static_cast<VertexId>(indptr.size()) - 1; }
    std::span<const VertexId> heads(VertexId v) const {
        const auto first = static_cast<std::size_t>(indptr[v]);
        return indices.subspan(first, static_cast<std::size_t>(indptr[v + 1]) - first);
    }
    // The edge from one vertex to another, -1 if there is none.
    EdgeId edge(VertexId tail, VertexId head) const {
        for (EdgeId e = indptr[tail]; e < indptr[tail + 1]; ++e) {
            if (indices[e] == head) {
                return e;
            }
        }
        return -1;
    }
};

// A graph whose edges fall into classes of one length each.
struct Roads {
    Graph graph;
    std::span<const std::int32_t> length_class;  // of each edge
};

// Throws std::invalid_argument, naming the array, the index and the value, if that is no graph.
void require_graph(const Graph& graph);

}  // namespace rightofway
