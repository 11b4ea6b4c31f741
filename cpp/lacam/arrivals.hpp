// The arrivals of the moves of one instant.
//
// PIBT as published moves all robots at once, in one step. Here drives last, so a robot that
// follows another one arrives after that one has left its vertex: arrivals are computed from the
// front of each queue to its end. A rotation arrives at one instant, the arrival of its slowest
// robot. A robot that turns on the spot starts its drive later.
#pragma once

#include <span>
#include <vector>

#include "lacam/chosen_moves.hpp"
#include "lacam/fleet_state.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Arrivals {
  public:
    // Borrows everything.
    Arrivals(const Problem& problem, const ChosenMoves& moves);

    // Adds the moves of all robots that do not stay, in order of choice. False if a robot ahead
    // stays, or if a queue is a cycle and rotations are forbidden.
    bool settle(const FleetState& now, std::vector<Decision>& decisions);

  private:
    bool settle_all(const FleetState& now, std::vector<Decision>& decisions);
    bool settle_queue(const FleetState& now, RobotId last);
    bool settle_rotation(const FleetState& now, RobotId member);
    Tick turned(const FleetState& now, RobotId robot, EdgeId edge) const;

    const Problem& problem_;
    const ChosenMoves& moves_;
    std::vector<Turns> turns_;   // of each robot
    std::vector<Tick> arrival_;  // of each robot, once computed
    std::vector<RobotId> queue_;
};

}  // namespace rightofway
