// The directed graph of a roadmap, borrowed, in compressed sparse rows (CSR).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/types.hpp"

namespace rightofway {

struct Graph {
    std::span<const EdgeId> indptr;     // edges out of v: indptr[v] .. indptr[v + 1] - 1
    std::span<const VertexId> indices;  // head of each edge

    VertexId n_vertices() const { return static_cast<VertexId>(indptr.size()) - 1; }
    std::span<const VertexId> heads(VertexId v) const {
        const auto first = index(indptr[index(v)]);
        return indices.subspan(first, index(indptr[index(v + 1)]) - first);
    }
    // The edge from tail to head, -1 if the graph has none.
    EdgeId edge(VertexId tail, VertexId head) const {
        for (EdgeId e = indptr[index(tail)]; e < indptr[index(tail + 1)]; ++e) {
            if (indices[index(e)] == head) {
                return e;
            }
        }
        return -1;
    }
};

// A graph with a length class for each edge; edges of one class have equal length.
struct Roads {
    Graph graph;
    std::span<const std::int32_t> length_class;  // of each edge
};

// Throws std::invalid_argument with array, index and value if the arrays form no graph. `heads`:
// the name of `indices` in the message.
void require_graph(const Graph& graph, const char* heads = "indices");

}  // namespace rightofway
