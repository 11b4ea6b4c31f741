// A fleet without clocks: where every robot is, and how much of its trip it has done.
//
// Whether robots can get where they have to go does not depend on speeds, work times or headways,
// because every robot can wait. So the question is asked without time, in steps in which each robot
// stays or moves to a neighbour. The answer, a sequence of configurations, fixes routes and at
// every vertex the order of visits; the times follow from these (see timetable.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// Where every robot is, and the stage that it is on its way to.
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

}  // namespace rightofway
