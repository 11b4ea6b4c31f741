// A preferred path for every robot and stage, chosen one after another so that they spread.
//
// Robots that all follow shortest paths meet head-on in the same few aisles. So each path is the
// cheapest where driving against earlier paths costs most, using a vertex of many paths costs a
// little, and every edge costs something: directions of traffic come about by themselves.
//
// Okumura, "Engineering LaCAM*: Towards real-time, large-scale, and near-optimal multi-agent
// pathfinding", AAMAS 2024, spreads paths by the conflicts they would have in time; counting uses
// needs no clock, and so no assumption on speeds.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rightofway/step_tables.hpp"
#include "rightofway/trips.hpp"

namespace rightofway {

class SpreadPaths {
  public:
    // Without a preference for anything; borrows the trips and the tables.
    SpreadPaths(const Trips& trips, StepTables& tables);

    // Chooses the paths; false if told to stop before they were all chosen.
    bool choose(const std::function<bool()>& is_over);

    // Where the path of a robot to its stage goes on from a vertex; -1 where that is not on it.
    VertexId next(std::int32_t stage, VertexId at) const;

  private:
    struct Hop {
        VertexId from;
        VertexId to;
    };
    struct Open {
        std::int64_t cost;  // at least, to the target
        std::int64_t so_far;
        Tick when;
        VertexId vertex;
    };

    static bool is_worse(const Open& left, const Open& right);
    Tick choose_leg(RobotId robot, VertexId start, std::int32_t stage, Tick when);
    bool search(RobotId robot, VertexId start, VertexId target, StepTables::TableId table, Tick when);
    void reach(const Open& reached, EdgeId by, StepTables::TableId table);
    std::int64_t cost_of(EdgeId edge) const;
    void find_rests();
    void keep(VertexId start, VertexId target, std::int32_t stage);

    const Trips& trips_;
    StepTables& tables_;
    std::vector<EdgeId> reverse_;  // of each edge: the one back, or -1
    std::vector<VertexId> tail_;   // of each edge
    std::vector<std::int32_t> edge_use_;
    std::vector<std::int32_t> vertex_use_;
    std::vector<Hop> hops_;                 // of all legs, those of one by `from`
    std::vector<std::size_t> first_hop_;    // of each stage
    std::vector<std::size_t> end_hop_;
    // What one search works on.
    std::int32_t round_ = 0;
    std::vector<std::int32_t> seen_in_;  // of each vertex
    std::vector<std::int64_t> so_far_;
    std::vector<Tick> rests_from_;
    std::vector<Tick> when_;
    std::vector<EdgeId> by_;
    std::vector<Open> open_;  // a heap
};

}  // namespace rightofway
