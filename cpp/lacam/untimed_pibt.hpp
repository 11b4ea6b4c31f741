// Priority inheritance with backtracking (PIBT): one greedy step of the whole fleet.
//
// Robots choose in order of priority. Each robot prefers the neighbour nearest to its target. A
// robot that stands there inherits the priority and chooses next; if it finds no vertex, the first
// robot tries its second choice. Two robots that face each other in a corridor use the swap
// operation: one robot pulls the other back to a vertex with room.
//
// Okumura, Machida, Defago & Tamura, "Priority inheritance with backtracking for iterative
// multi-agent path finding", Artificial Intelligence 310, 2022; the swap operation: Okumura,
// "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "distances/step_tables.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// The vertex and the next stage of each robot, without times. Whether all robots can reach their
// stages does not depend on times, because every robot can wait.
struct Configuration {
    std::vector<VertexId> at;
    std::vector<std::int32_t> stage;

    bool operator==(const Configuration&) const = default;
};

// Advances a robot to its first stage not reached; a robot keeps its last stage for ever.
inline void advance(const Problem& problem, Configuration& now, RobotId robot) {
    while (!problem.is_last(robot, now.stage[index(robot)]) &&
           problem.stage_vertex(now.stage[index(robot)]) == now.at[index(robot)]) {
        ++now.stage[index(robot)];
    }
}

// Whether every robot is on its last stage and at its vertex. A robot with `ends_anywhere` only
// prefers that vertex. `ends_anywhere`: per robot, or empty.
inline bool is_goal(const Problem& problem, std::span<const std::uint8_t> ends_anywhere,
                    const Configuration& now) {
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        const bool is_there = problem.stage_vertex(now.stage[index(r)]) == now.at[index(r)] ||
                              (!ends_anywhere.empty() && ends_anywhere[index(r)] != 0);
        if (!problem.is_last(r, now.stage[index(r)]) || !is_there) {
            return false;
        }
    }
    return true;
}

class UntimedPibt {
  public:
    // Borrows the problem and the tables.
    UntimedPibt(const Problem& problem, StepTables& tables, std::uint32_t seed);

    // The least number of edges from a vertex to the robot's stage.
    std::int32_t way(const Configuration& now, RobotId robot, VertexId vertex) const;

    // Fixes the vertex of a robot after the coming step.
    void fix(RobotId robot, VertexId vertex);

    // Chooses for all robots that are not fixed, in this order; false if no step results. Removes
    // all fixes.
    bool step(const Configuration& now, std::span<const RobotId> order);

    // The vertex of each robot after the latest step.
    std::span<const VertexId> next() const { return next_; }

  private:
    struct Choosing;
    struct Fixed {
        RobotId robot;
        VertexId vertex;
    };
    // A robot that is choosing; those above it on the stack choose before it can go on.
    struct Frame {
        RobotId robot;
        RobotId partner;
        std::size_t first;  // its candidates: places_[first] .. places_[end - 1]
        std::size_t end;
        std::size_t next;  // the candidate to try next
    };

    bool take_fixed(const Configuration& now);
    bool is_swap(const Configuration& now, RobotId robot, VertexId vertex) const;
    void take(RobotId robot, VertexId vertex);
    bool choose(const Configuration& now, RobotId robot);
    void begin(const Configuration& now, RobotId robot);
    void pull_partner(const Configuration& now, const Frame& frame);
    void push_places_by_distance(const Configuration& now, RobotId robot);
    bool closes_rotation(const Configuration& now) const;

    const Problem& problem_;
    StepTables& tables_;
    std::vector<StepTables::TableId> stage_table_;
    std::mt19937 draw_;
    std::vector<RobotId> here_;       // of each vertex: robot now
    std::vector<RobotId> comes_;      // of each vertex: robot after the step
    std::vector<VertexId> next_;      // of each robot: vertex after the step
    std::vector<std::uint32_t> tie_;  // of each vertex; drawn for each choice
    std::vector<VertexId> places_;    // a stack: candidates of each robot that is choosing
    std::vector<Frame> frames_;       // a stack: robots that are choosing, each pushed by the last
    std::vector<Fixed> fixed_;
};

}  // namespace rightofway
