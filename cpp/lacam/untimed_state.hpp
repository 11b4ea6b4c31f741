// A fleet without clocks: where every robot is, and how much of its trip it has done.
//
// Whether robots can get where they have to go at all has nothing to do with speeds, work times or
// headways, for everybody can wait. So the question is asked without time, in steps in which each
// robot stays or moves to a neighbour. The answer, a sequence of configurations, fixes routes and
// at every vertex the order of visits; the times follow from these (see timetable.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// Each robot's stages: the vertices to go to one after the other; it stays at the last one.
struct UntimedProblem {
    std::span<const VertexId> home;
    std::span<const std::int32_t> first_stage;  // robot r owns first_stage[r] .. [r + 1] - 1
    std::span<const VertexId> stage_vertex;
    std::span<const std::uint8_t> ends_anywhere = {};  // per robot; empty: every last stage binds

    RobotId n_robots() const { return static_cast<RobotId>(home.size()); }
    bool is_last(RobotId robot, std::int32_t stage) const {
        return stage + 1 == first_stage[robot + 1];
    }
    // A robot that may end anywhere prefers its last stage, but does not need it.
    bool may_end_anywhere(RobotId robot) const {
        return !ends_anywhere.empty() && ends_anywhere[robot] != 0;
    }
};

// Throws std::invalid_argument where the arrays are no graph, or do not fit together or to it.
void check(const Graph& graph, const UntimedProblem& goals);

// Where every robot is, and which stage it is on its way to.
struct Configuration {
    std::vector<VertexId> at;
    std::vector<std::int32_t> stage;

    bool operator==(const Configuration&) const = default;
};

// Moves a robot on to the first stage that it has not reached; the last one it keeps for ever.
inline void advance(const UntimedProblem& goals, Configuration& now, RobotId robot) {
    while (!goals.is_last(robot, now.stage[robot]) &&
           goals.stage_vertex[now.stage[robot]] == now.at[robot]) {
        ++now.stage[robot];
    }
}

// Whether every robot is on its last stage, and there unless it may end anywhere.
inline bool is_goal(const UntimedProblem& goals, const Configuration& now) {
    for (RobotId r = 0; r < goals.n_robots(); ++r) {
        const bool is_there =
            goals.stage_vertex[now.stage[r]] == now.at[r] || goals.may_end_anywhere(r);
        if (!goals.is_last(r, now.stage[r]) || !is_there) {
            return false;
        }
    }
    return true;
}

}  // namespace rightofway
