// Space utilization optimization: a preferred path for each robot and stage, spread over the map.
//
// Robots on shortest paths meet head-on in few aisles and drive into robots that have completed
// there. So paths are chosen one after another at least cost: each edge has a cost; driving against
// earlier paths adds most, a vertex of many paths adds a little, and a robot at the end of its trip
// adds the cost of a detour. Lanes of one direction result.
//
// Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and near-optimal multi-agent
// pathfinding", AAMAS 2024, spreads paths by their conflicts in time. Here paths are counted per
// edge and vertex instead, because own speeds make times uncertain before planning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/poll.hpp"
#include "core/types.hpp"
#include "distances/step_tables.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class SpaceUtilization {
  public:
    // Has no preferred paths yet. Borrows both.
    SpaceUtilization(const Problem& problem, StepTables& tables);

    // Chooses the paths; false if `is_over` became true before. The effort is bounded: in a large
    // fleet some robots get no path, in a very large fleet all robots.
    bool choose(const StopCondition& is_over);

    // The next vertex on the path to a stage; -1 if the path does not pass `at`.
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
        std::int32_t cost;  // of the path from the start
        VertexId vertex;
        std::int32_t next;  // next entry of the list
    };
    // A vertex: the cheapest path to it in the search number `round`.
    struct Best {
        std::int32_t cost;
        std::uint16_t round;  // no more legs than that get paths
        std::uint8_t shared;  // what earlier paths add to the cost of each edge to the vertex
    };
    struct Way {
        Tick when;        // enter of the robot on the cheapest path, without waits
        Tick ended_from;  // earliest end of a trip at the vertex
        EdgeId by;        // last edge of the path
    };

    void find_ends();
    Tick choose_leg(const Leg& leg, Tick when, Poll& poll);
    bool search(const Leg& leg, Tick when, Poll& poll);
    bool open(VertexId vertex, std::int32_t cost, EdgeId by, StepTables::TableId table);
    bool take_next(Open& next);
    void keep(const Leg& leg);

    const Problem& problem_;
    StepTables& tables_;
    std::vector<VertexId> tail_;          // of each edge
    std::vector<EdgeId> opposite_;        // of each edge, -1 if the edge is one-way
    std::vector<std::uint8_t> cost_of_;   // of each edge, with the cost against earlier paths
    std::vector<Hop> hops_;               // of all paths; within a path by `from`
    std::vector<std::size_t> first_hop_;  // of each stage
    std::vector<std::size_t> end_hop_;
    bool is_stopped_ = false;
    std::int64_t credit_ = 0;  // number of vertices that may still be opened
    std::uint16_t round_ = 0;
    std::vector<Best> best_;  // of each vertex; small, because each step of the search reads some
    std::vector<Way> way_;    // of each vertex
    // Open vertices in lists by estimate (buckets); the first list has the least estimate.
    std::vector<Open> open_;
    std::vector<std::int32_t> first_open_;  // of each list
    std::int32_t least_ = 0;                // least estimate of the first list
    std::size_t list_ = 0;                  // the lists before it are empty
};

}  // namespace rightofway
