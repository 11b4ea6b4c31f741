#include <doctest/doctest.h>

#include <vector>

#include "core/reverse_graph.hpp"

namespace rightofway {
namespace {

// Edges 0 -> 1, 0 -> 2, 1 -> 2, 2 -> 0, 2 -> 1; vertex 3 has no edge.
const std::vector<EdgeId> indptr{0, 2, 3, 5, 5};
const std::vector<VertexId> heads{1, 2, 2, 0, 1};
const Graph graph{indptr, heads};

template <class Values>
std::vector<std::int32_t> listed(const Values& values) {
    return {values.begin(), values.end()};
}

TEST_CASE("edges into a vertex are listed in order of id, each with its tail") {
    const ReverseGraph reverse(graph);
    CHECK(reverse.n_vertices() == 4);
    CHECK(reverse.n_edges() == 5);
    CHECK(listed(reverse.edges(0)) == std::vector<EdgeId>{3});
    CHECK(listed(reverse.edges(1)) == std::vector<EdgeId>{0, 4});
    CHECK(listed(reverse.tails(1)) == std::vector<VertexId>{0, 2});
    CHECK(listed(reverse.edges(2)) == std::vector<EdgeId>{1, 2});
    CHECK(listed(reverse.tails(2)) == std::vector<VertexId>{0, 1});
    CHECK(reverse.edges(3).empty());
}

TEST_CASE("each edge has a tail, and an opposite edge if it is not one-way") {
    CHECK(list_tails(graph) == std::vector<VertexId>{0, 0, 1, 2, 2});
    CHECK(find_opposite_edges(graph) == std::vector<EdgeId>{-1, 3, 4, 1, 2});
}

}  // namespace
}  // namespace rightofway
