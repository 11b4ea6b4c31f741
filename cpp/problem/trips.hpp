// What each robot of a fleet has to do, in ticks: its stages, its dwells, its time for every edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/graph.hpp"
#include "core/types.hpp"
#include "lacam/untimed_state.hpp"

namespace rightofway {

// All arrays are borrowed.
struct Trips {
    Graph graph;
    std::span<const std::int32_t> edge_class;   // of each edge: which length it has
    std::span<const VertexId> home;             // of each robot
    std::span<const std::int32_t> first_stage;  // robot r owns first_stage[r] .. [r + 1] - 1
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_dwell;          // work and turning; unused for last stages
    std::span<const std::int32_t> class_ticks;  // robots x lengths: ticks for such an edge
    Tick headway = 0;
    bool books_ahead = false;  // a robot books a vertex from when it starts to drive there
    bool may_rotate = true;    // needs: no headway, and no booking ahead

    UntimedProblem goals() const { return {home, first_stage, stage_vertex}; }
    RobotId n_robots() const { return static_cast<RobotId>(home.size()); }
    std::int32_t n_classes() const {
        return home.empty() ? 0 : static_cast<std::int32_t>(class_ticks.size() / home.size());
    }
    bool is_last(RobotId robot, std::int32_t stage) const {
        return stage + 1 == first_stage[robot + 1];
    }
    Tick drive(RobotId robot, EdgeId edge) const {
        return class_ticks[static_cast<std::size_t>(robot) * n_classes() + edge_class[edge]];
    }
    // The ticks that a robot needs for its quickest edge; 1 where there are no edges.
    Tick pace(RobotId robot) const {
        const auto n = static_cast<std::size_t>(n_classes());
        const auto ticks = class_ticks.subspan(static_cast<std::size_t>(robot) * n, n);
        return ticks.empty() ? 1 : *std::min_element(ticks.begin(), ticks.end());
    }
    // From when the vertex ahead is left to when a robot that drives there can be there.
    Tick gap(Tick drive_ticks) const { return headway + (books_ahead ? drive_ticks : 0); }
};

// Throws std::invalid_argument where the arrays do not fit together.
void check(const Trips& trips);

}  // namespace rightofway
