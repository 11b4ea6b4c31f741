// The moves that robots have chosen at one instant, and the robots that each move waits for.
//
// PIBT as published asks two questions about a vertex: has a robot chosen it, and does a robot
// stand on it? Here robots have sizes, drive for several ticks and may book ahead, so a move needs
// every resource that it touches: the vertex and, where drives exclude more than their ends do, the
// edge that leads there. A place is blocked, or held, by the robots near to it, and near to the
// edge that leads there. For points the only such place is the vertex itself.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "lacam/fleet_state.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class ChosenMoves {
  public:
    static constexpr VertexId nowhere = -1;

    // How far a robot has asked those that have to leave before it drives to a place.
    struct Ahead {
        VertexId place = nowhere;
        std::size_t n_asked = 0;  // two for each resource: the robot there, the one that crosses it
    };

    // Borrows the problem.
    explicit ChosenMoves(const Problem& problem);

    // The next vertex of a robot; its own vertex: it stays; `nowhere`: it has not chosen.
    VertexId next(RobotId robot) const { return next_[index(robot)]; }
    bool has_chosen(RobotId robot) const { return next(robot) != nowhere; }
    bool moves(const FleetState& now, RobotId robot) const {
        return has_chosen(robot) && next(robot) != now.at(robot);
    }
    // The robot that chose a vertex, or an edge.
    RobotId claim(std::int32_t resource) const { return claim_[index(resource)]; }
    // The robots that have chosen, in order of their first choices.
    std::span<const RobotId> robots() const { return robots_; }

    // Chooses a vertex for a robot, instead of the one that it chose before.
    void take(const FleetState& now, RobotId robot, VertexId vertex);
    // Gives up the place that the robot chose, before it chooses another one.
    void release(const FleetState& now, RobotId robot);
    // Takes back the choice of the robot that was the latest to choose first.
    void withdraw_latest(const FleetState& now);
    // Takes back all choices.
    void clear(const FleetState& now);

    // Whether the robot may drive to the place, no other robot enters a vertex near to it, and no
    // robot near to it works or wants to swap. Where a robot wants to stay, no other may pass.
    bool is_open(const FleetState& now, RobotId robot, VertexId place) const;
    // Whether a robot that moves has booked the place.
    bool is_booked(const FleetState& now, RobotId robot, VertexId place) const;
    // Whether the robot waits for a robot that waits for it, directly or not.
    bool closes_rotation(const FleetState& now, RobotId robot);

    // The next robot that has to leave before this robot drives to a place, by the choices so far;
    // `nobody` if all have been asked.
    RobotId next_ahead(const FleetState& now, RobotId robot, Ahead& ahead) const;

    // Calls `use` with each robot that has to leave before this robot drives to a place.
    template <class Use>
    bool any_ahead(const FleetState& now, RobotId robot, VertexId place, const Use& use) const {
        Ahead ahead{place};
        for (RobotId other; (other = next_ahead(now, robot, ahead)) != nobody;) {
            if (use(other)) {
                return true;
            }
        }
        return false;
    }

    // Calls `use` with the resources that robots may not hold or drive to if this robot is to drive
    // to a place, or stay there: use(resource, first row of the size class of these robots, whether
    // only the drive is near to it). Ends when `use` returns true.
    template <class Use>
    bool any_near(const FleetState& now, RobotId robot, VertexId place, const Use& use) const {
        const std::int32_t n_resources = problem_.n_resources();
        const auto any_of = [&](const std::int32_t own_row, bool is_drive) {
            const auto rows = problem_.excluded(own_row);
            return std::any_of(rows.begin(), rows.end(), [&](std::int32_t row) {
                const std::int32_t resource = row < n_resources ? row : row % n_resources;
                return use(resource, row - resource, is_drive);
            });
        };
        return any_of(problem_.vertex_row(robot, place), false) ||
               (problem_.edges_exclude() && place != now.at(robot) &&
                any_of(problem_.edge_row(robot, edge_to(now, robot, place)), true));
    }

    EdgeId edge_to(const FleetState& now, RobotId robot, VertexId place) const {
        return problem_.graph().edge(now.at(robot), place);
    }

  private:
    bool goes_first(const FleetState& now, RobotId other, RobotId robot) const;

    const Problem& problem_;
    std::vector<RobotId> claim_;      // of each resource (FleetState): robot that chose it now
    std::vector<VertexId> next_;      // of each robot: its choice
    std::vector<RobotId> robots_;     // robots with a choice
    std::vector<std::int32_t> rank_;  // of each robot with a choice: its index in robots_
    std::vector<RobotId> queue_;
    std::vector<std::int64_t> seen_by_;  // of each robot: the latest search for a rotation
    std::int64_t n_rotation_searches_ = 0;
};

}  // namespace rightofway
