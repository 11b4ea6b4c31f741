// A preferred path for every robot and stage, chosen one after another so that they spread.
//
// Robots that all follow shortest paths meet head-on in the same few aisles, and drive into others
// that have ended their trips there. So each path is a cheap one where driving against earlier
// paths costs most, a vertex of many paths costs a little, passing a robot at the end of its trip
// costs a detour, and every edge costs something. Directions of traffic come about by themselves.
//
// Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and near-optimal multi-agent
// pathfinding", AAMAS 2024, spreads paths by the conflicts that they would have in time. Counting
// uses asks less of the times, which with own speeds are known only roughly beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/types.hpp"
#include "distances/step_tables.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class SpaceUtilization {
  public:
    // Without a preference for anything. Borrows both.
    SpaceUtilization(const Problem& problem, StepTables& tables);

    // Chooses the paths; false if told to stop before that was done. The effort is bounded: in a
    // large fleet some robots are left without a path, and in a very large one all of them.
    bool choose(const StopCondition& is_over);

    // Where the path to a stage goes on from a vertex; -1 where it does not pass.
    VertexId next(std::int32_t stage, VertexId at) const;

  private:
    struct Leg {
        RobotId robot;
        VertexId start;
        std::int32_t stage;
    };
    struct Hop {
        VertexId from;
        VertexId to;
    };
    struct Open {
        std::int64_t cost;  // so far
        VertexId vertex;
        std::int32_t next;  // of about the same estimate
    };
    // How a vertex is reached at least cost, in the search of this round.
    struct Best {
        std::int64_t cost;
        Tick when;  // the robot would be there, without waits
        EdgeId by;
        std::int32_t round;
    };

    void pair_edges();
    void find_ends();
    Tick choose_leg(const Leg& leg, Tick when);
    bool search(const Leg& leg, Tick when);
    void open(VertexId vertex, const Best& reached, StepTables::TableId table);
    bool take_next(Open& next);
    void keep(const Leg& leg);

    const Problem& problem_;
    StepTables& tables_;
    std::vector<VertexId> tail_;           // of each edge
    std::vector<EdgeId> back_;             // of each edge: the one the other way, or -1
    std::vector<Tick> ended_from_;         // of each vertex: when a trip ends there at the soonest
    std::vector<std::int64_t> edge_cost_;  // of each edge: against the paths so far
    std::vector<std::int64_t> into_cost_;  // of each vertex: shared with the paths so far
    std::vector<Hop> hops_;                // of all paths, those of one by `from`
    std::vector<std::size_t> first_hop_;   // of each stage
    std::vector<std::size_t> end_hop_;
    std::int64_t credit_ = 0;  // how many vertices may still be opened
    std::int32_t round_ = 0;
    std::vector<Best> best_;  // of each vertex
    // Open vertices in lists by their estimates, which begin with the least that there can be.
    std::vector<Open> open_;
    std::vector<std::int32_t> first_open_;  // of each list
    std::int64_t least_ = 0;                // the estimate where the lists begin
    std::size_t list_ = 0;                  // those before it are empty
};

}  // namespace rightofway
