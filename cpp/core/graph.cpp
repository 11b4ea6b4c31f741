#include "core/graph.hpp"

#include <limits>
#include <stdexcept>

#include "core/reject.hpp"

namespace rightofway {

void require_graph(const Graph& graph, const char* heads) {
    const auto& [indptr, indices] = graph;
    if (indices.size() + indptr.size() >
        static_cast<std::size_t>(std::numeric_limits<EdgeId>::max())) {
        throw std::invalid_argument("indptr: more vertices and edges than int32 can number");
    }
    require_lists("indptr", indptr, indices.size(), "edges");
    require_ids(heads, indices, graph.n_vertices());
}

}  // namespace rightofway
