#include "core/reverse_graph.hpp"

#include <numeric>

namespace rightofway {

// A counting sort of the edges by head.
ReverseGraph::ReverseGraph(const Graph& graph)
    : first_(graph.indptr.size(), 0), edge_(graph.indices.size()), tail_(graph.indices.size()) {
    for (const VertexId head : graph.indices) {
        ++first_[index(head + 1)];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<EdgeId> next(first_.begin(), first_.end() - 1);
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        for (EdgeId e = graph.indptr[index(v)]; e < graph.indptr[index(v + 1)]; ++e) {
            const auto place = index(next[index(graph.indices[index(e)])]++);
            edge_[place] = e;
            tail_[place] = v;
        }
    }
}

std::vector<VertexId> list_tails(const Graph& graph) {
    std::vector<VertexId> tails;
    tails.reserve(graph.indices.size());
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        tails.insert(tails.end(), graph.heads(v).size(), v);
    }
    return tails;
}

std::vector<EdgeId> find_opposite_edges(const Graph& graph) {
    std::vector<EdgeId> opposite;
    opposite.reserve(graph.indices.size());
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        for (const VertexId head : graph.heads(v)) {
            opposite.push_back(graph.edge(head, v));
        }
    }
    return opposite;
}

}  // namespace rightofway
