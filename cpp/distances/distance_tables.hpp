// How far is it from everywhere to one place?
//
// Every search for routes asks this of the same few targets again and again. A table answers it
// for one target at once: a search from the target over the reversed edges. The graph is stored
// reversed, once; what an edge takes depends on the robot's speed and is given with each request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// How far it is from everywhere to one vertex, read from a table that belongs to somebody else.
// Where all edges are equally long, one table of edge counts serves robots of any speed.
class DistanceView {
  public:
    static constexpr std::uint16_t no_way = UINT16_MAX;

    DistanceView() = default;
    // `no_way` marks where no way leads on.
    DistanceView(const std::uint16_t* counts, Tick ticks) : narrow_(counts), scale_(ticks) {}
    // -1 marks where no way leads on.
    DistanceView(const std::int32_t* counts, Tick ticks) : wide_(counts), scale_(ticks) {}

    // Ticks to the target, -1 where no way leads there.
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
    // The edges that leave vertex v are indptr[v] .. indptr[v + 1] - 1; edge e ends at indices[e].
    // Throws std::invalid_argument if that is not a graph.
    DistanceTables(std::span<const EdgeId> indptr, std::span<const VertexId> indices);

    VertexId n_vertices() const { return static_cast<VertexId>(arriving_.size() - 1); }

    // The least ticks from each vertex to the target, -1 where no way leads there.
    // Throws std::invalid_argument on a bad target or an edge that takes no time, and
    // std::overflow_error if a least distance does not fit the type.
    std::vector<std::int32_t> to(VertexId target, std::span<const std::int32_t> edge_ticks) const;

    // The fewest edges from each vertex to the target, DistanceView::no_way where no way leads
    // there; false where a count does not fit, and then `counts` is of no use.
    bool steps_to(VertexId target, std::vector<std::uint16_t>& counts) const;

  private:
    void reverse(std::span<const EdgeId> indptr, std::span<const VertexId> indices);
    void check_request(VertexId target, std::span<const std::int32_t> edge_ticks) const;
    std::vector<std::int32_t> dijkstra(VertexId target,
                                       std::span<const std::int32_t> edge_ticks) const;

    // The reversed graph: the edges that arrive at v are edge_[k], from source_[k], for k in
    // arriving_[v] .. arriving_[v + 1] - 1.
    std::vector<EdgeId> arriving_;
    std::vector<VertexId> source_;
    std::vector<EdgeId> edge_;
};

}  // namespace rightofway
