// Routes that keep clear of the others: shortest where that is free, and a little longer where it
// spares meeting somebody.
//
// Waiting on a route cannot pass a robot that stands or works on it, and of two that come head-on
// one has to wait for the whole segment. So a vertex where another robot has its home or a stop
// costs more to enter, and so does an edge for every robot that goes the other way. Costs are
// whole numbers: times in shares of a tick, and surcharges in shares for each tick of an edge.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Congestion {
  public:
    // Borrows the problem. A tick is counted in `shares`; `station` is the surcharge per tick to
    // enter each vertex, where others have their home or a stop. Throws std::invalid_argument where
    // these do not fit together.
    Congestion(const Problem& problem, std::int64_t shares, std::span<const std::int64_t> station);

    // A cheapest path; of several, the one that takes the first edge of a vertex that it can.
    // `to_go` has the least ticks from each vertex to the target, -1 where no way leads there.
    // Throws std::invalid_argument if there is none from the start.
    std::vector<VertexId> path(RobotId robot, VertexId start, VertexId target,
                               std::span<const std::int32_t> to_go);

    // Has one more robot on a path: whoever goes against it pays so much more per tick.
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
    // One of the cheapest ways to get to a vertex, in a list.
    struct Way {
        VertexId from;
        std::int32_t next;
    };

    std::int64_t cost_of(EdgeId edge, VertexId target, std::int32_t ticks) const;
    void search(RobotId robot, VertexId start, VertexId target,
                std::span<const std::int32_t> to_go);
    void reach(VertexId vertex, VertexId from, std::int64_t cost, std::int64_t to_go);
    void mark_cheapest(VertexId target);
    std::vector<VertexId> first_marked(VertexId start, VertexId target) const;
    void clear();

    const Problem& problem_;
    std::vector<EdgeId> opposite_;  // of each edge, -1 for a one-way
    std::int64_t shares_;
    std::vector<std::int64_t> station_;   // what it costs more to enter a vertex
    std::vector<std::int64_t> oncoming_;  // what it costs more to go against each edge

    // What a search works on; reused.
    std::vector<std::int64_t> cost_;          // of each vertex that was reached
    std::vector<std::int32_t> cheapest_way_;  // to it
    std::vector<Way> ways_;
    std::vector<std::uint8_t> is_marked_;
    std::vector<VertexId> reached_;
    std::vector<Open> open_;
};

}  // namespace rightofway
