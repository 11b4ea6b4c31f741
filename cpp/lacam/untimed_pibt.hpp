// Priority inheritance with backtracking: one step for the whole fleet, greedily.
//
// The robots choose in order of priority. Each wants the neighbour that brings it nearest; a robot
// that stands there inherits the priority and chooses next, and if it finds no place the first one
// tries its second choice. Two robots that face each other in a corridor exchange their places by
// the swap operation: one pulls the other back to where there is room.
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

// A fleet without clocks: where every robot is, and the stage that it is on its way to. Whether
// robots can get where they have to go does not depend on times, because every robot can wait.
struct Configuration {
    std::vector<VertexId> at;
    std::vector<std::int32_t> stage;

    bool operator==(const Configuration&) const = default;
};

// Moves a robot on to the first stage that it has not reached; the last one it keeps for ever.
inline void advance(const Problem& problem, Configuration& now, RobotId robot) {
    while (!problem.is_last(robot, now.stage[robot]) &&
           problem.stage_vertex(now.stage[robot]) == now.at[robot]) {
        ++now.stage[robot];
    }
}

// Whether every robot is on its last stage, and there unless it may end anywhere: such a robot only
// prefers its last stage. `ends_anywhere` is for each robot, or empty.
inline bool is_goal(const Problem& problem, std::span<const std::uint8_t> ends_anywhere,
                    const Configuration& now) {
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        const bool is_there = problem.stage_vertex(now.stage[r]) == now.at[r] ||
                              (!ends_anywhere.empty() && ends_anywhere[r] != 0);
        if (!problem.is_last(r, now.stage[r]) || !is_there) {
            return false;
        }
    }
    return true;
}

class UntimedPibt {
  public:
    // Borrows the problem and the tables.
    UntimedPibt(const Problem& problem, StepTables& tables, std::uint32_t seed);

    // How many edges it is from a vertex to the stage of a robot.
    std::int32_t way(const Configuration& now, RobotId robot, VertexId vertex) const;

    // Says where a robot goes in the coming step.
    void fix(RobotId robot, VertexId vertex);

    // Chooses for all robots that are not fixed, in this order; false if that gives no step. The
    // fixed robots are free again afterwards.
    bool step(const Configuration& now, std::span<const RobotId> order);

    // Where each robot goes in the step that was chosen last.
    std::span<const VertexId> next() const { return next_; }

  private:
    struct Choosing;
    struct Fixed {
        RobotId robot;
        VertexId vertex;
    };

    bool take_fixed(const Configuration& now);
    bool is_swap(const Configuration& now, RobotId robot, VertexId vertex) const;
    void take(RobotId robot, VertexId vertex);
    bool choose(const Configuration& now, RobotId robot);
    std::vector<VertexId> places_by_distance(const Configuration& now, RobotId robot);
    bool closes_rotation(const Configuration& now) const;

    const Problem& problem_;
    StepTables& tables_;
    std::vector<StepTables::TableId> stage_table_;
    std::mt19937 draw_;
    std::vector<RobotId> here_;       // who is at each vertex
    std::vector<RobotId> comes_;      // who will be at each vertex
    std::vector<VertexId> next_;      // where each robot will be
    std::vector<std::uint32_t> tie_;  // of each vertex; drawn anew for each choice
    std::vector<Fixed> fixed_;
};

}  // namespace rightofway
