// Routes of least time plus congestion cost: short detours that avoid conflicts with other robots.
//
// A robot cannot pass a robot that stands or works on its route, and of two opposing robots one
// waits for the whole segment. So a vertex where another robot has its home or a stop costs more to
// enter, and an edge costs more for each robot that drives the other way. Costs are integers: times
// in shares of a tick, surcharges in shares per tick of the edge.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/poll.hpp"
#include "core/types.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Congestion {
  public:
    // Borrows the problem. `shares` is the number of shares of a tick; `station` is the surcharge
    // for the enter of each vertex, for homes and stops of other robots [shares per tick]. Throws
    // std::invalid_argument if the arguments do not fit together.
    Congestion(const Problem& problem, std::int64_t shares, std::span<const std::int64_t> station);

    // A cheapest path; of several, the path with the first possible edge of each vertex. `to_go`
    // has the least ticks from each vertex to the target, -1 if no path exists. Throws
    // std::invalid_argument if no path leads from the start to the target, and what `interrupt`,
    // which is polled, throws.
    std::vector<VertexId> path(RobotId robot, VertexId start, VertexId target,
                               std::span<const std::int32_t> to_go,
                               const StopCondition& interrupt = {});

    // Adds a robot's path: opposing drives cost `oncoming` more [shares per tick].
    void add(std::span<const VertexId> path, std::int64_t oncoming);

    VertexId n_vertices() const { return static_cast<VertexId>(station_.size()); }

  private:
    struct Open {
        std::int64_t cost;   // with what is to go at least
        std::int64_t to_go;  // of that
        std::int64_t order;  // differs between all entries
        VertexId vertex;
        auto operator<=>(const Open&) const = default;
    };
    // The last edge of a cheapest path to a vertex; an entry of a linked list.
    struct Way {
        VertexId from;
        std::int32_t next;
    };

    std::int64_t cost_of(EdgeId edge, VertexId target, Tick ticks) const;
    void search(RobotId robot, VertexId start, VertexId target, std::span<const std::int32_t> to_go,
                Poll& poll);
    void reach(VertexId vertex, VertexId from, std::int64_t cost, std::int64_t to_go);
    void mark_cheapest(VertexId target);
    std::vector<VertexId> first_marked(VertexId start, VertexId target) const;
    void clear();

    const Problem& problem_;
    std::vector<EdgeId> opposite_;  // of each edge, -1 if the edge is one-way
    std::int64_t shares_;
    std::vector<std::int64_t> station_;   // surcharge for entering each vertex
    std::vector<std::int64_t> oncoming_;  // surcharge for driving against each edge

    // Memory of a search, kept for the next search.
    std::vector<std::int64_t> cost_;          // of each reached vertex
    std::vector<std::int32_t> cheapest_way_;  // of each vertex: head of its list
    std::vector<Way> ways_;
    std::vector<std::uint8_t> is_marked_;
    std::vector<VertexId> reached_;
    std::vector<Open> open_;
};

}  // namespace rightofway
