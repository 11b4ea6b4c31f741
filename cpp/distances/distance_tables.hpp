// Tables of the least distance from every vertex to one target.
//
// Route searches need the distances to few targets many times. One search from the target over the
// reversed edges fills a table. The graph is reversed once; the ticks per edge depend on the
// robot's speed and come with each request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/reverse_graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// A borrowed table of distances from every vertex to one target. With edges of equal length, one
// table of edge counts serves robots of every speed.
class DistanceView {
  public:
    static constexpr std::uint16_t no_way = UINT16_MAX;

    DistanceView() = default;
    // Borrows edge counts; `no_way`: no path to the target.
    DistanceView(const std::uint16_t* counts, Tick ticks) : narrow_(counts), scale_(ticks) {}
    // Borrows edge counts or ticks; -1: no path to the target.
    DistanceView(const std::int32_t* counts, Tick ticks) : wide_(counts), scale_(ticks) {}

    // Least ticks from a vertex to the target, -1 if no path exists.
    Tick from(VertexId vertex) const {
        if (narrow_ != nullptr) {
            const std::uint16_t count = narrow_[vertex];
            return count == no_way ? -1 : scale_ * count;
        }
        const std::int32_t count = wide_[vertex];
        return count < 0 ? -1 : scale_ * count;
    }

  private:
    const std::uint16_t* narrow_ = nullptr;
    const std::int32_t* wide_ = nullptr;
    Tick scale_ = 1;
};

class DistanceTables {
  public:
    // Edges out of vertex v: indptr[v] .. indptr[v + 1] - 1; head of edge e: indices[e]. Throws
    // std::invalid_argument if the arrays form no graph.
    DistanceTables(std::span<const EdgeId> indptr, std::span<const VertexId> indices);

    VertexId n_vertices() const { return reverse_.n_vertices(); }
    const ReverseGraph& reverse() const { return reverse_; }

    // The least ticks from each vertex to the target, -1 if no path exists. Throws
    // std::invalid_argument for an unknown target or an edge of 0 ticks or less, and
    // std::overflow_error if a least distance does not fit int32.
    std::vector<std::int32_t> to(VertexId target, std::span<const std::int32_t> edge_ticks) const;

    // The least number of edges from each vertex to the target, DistanceView::no_way if no path
    // exists. False if a count does not fit uint16; `counts` is invalid then.
    bool steps_to(VertexId target, std::vector<std::uint16_t>& counts) const;

  private:
    void check_request(VertexId target, std::span<const std::int32_t> edge_ticks) const;
    std::vector<std::int32_t> dijkstra(VertexId target,
                                       std::span<const std::int32_t> edge_ticks) const;

    ReverseGraph reverse_;
};

}  // namespace rightofway
