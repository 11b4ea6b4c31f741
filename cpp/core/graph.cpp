#include "core/graph.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {

void require_graph(const Graph& graph) {
    const auto& [indptr, indices] = graph;
    if (indptr.empty()) {
        throw std::invalid_argument("indptr: its length is 0, but must be at least 1");
    }
    if (indices.size() > static_cast<std::size_t>(std::numeric_limits<EdgeId>::max()) ||
        indptr.front() != 0) {
        reject_entry("indptr", 0, indptr.front(), "must be 0");
    }
    for (std::size_t v = 1; v < indptr.size(); ++v) {
        if (indptr[v] < indptr[v - 1]) {
            reject_entry("indptr", v, indptr[v], "is less than the entry before it");
        }
    }
    if (static_cast<std::size_t>(indptr.back()) != indices.size()) {
        reject_entry("indptr", indptr.size() - 1, indptr.back(),
                     "is not the number of edges, " + std::to_string(indices.size()));
    }
    const auto n_vertices = static_cast<std::int64_t>(indptr.size()) - 1;
    for (std::size_t e = 0; e < indices.size(); ++e) {
        if (indices[e] < 0 || indices[e] >= n_vertices) {
            reject_entry("indices", e, indices[e],
                         "is not in 0.." + std::to_string(n_vertices - 1));
        }
    }
}

}  // namespace rightofway
