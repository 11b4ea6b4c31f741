// Priority inheritance with backtracking (PIBT) with times: the decisions of one instant.
//
// Free robots choose in order of priority. A robot prefers the neighbour from which it reaches its
// target earliest. If a robot drives away from that vertex, the robot follows it; if a free robot
// stands there, that robot inherits the priority and chooses next; if it finds no vertex, the first
// robot tries its second choice. Robots that drive or work cannot be pushed; a robot waits if other
// robots drive to all vertices that it prefers.
//
// The steps as published, with the swap operation; the numbers stand beside the code (pibt.cpp):
//
//      PIBT(i):
//   1      C <- the neighbours of the vertex of i, and this vertex
//   2      sort C by the distance to the goal of i
//   3      j <- the robot to swap with, if a swap is required and possible
//   4      if j: reverse C
//   5      for v in C:
//   6          if a robot has chosen v, or the move swaps two robots: continue
//   7          i chooses v
//   8          if a robot k stands on v that has not chosen:
//   9              if PIBT(k) is invalid: continue
//  10          if v is the first of C, and j has not chosen: j chooses the vertex of i
//  11          return valid
//  12      i chooses its own vertex
//  13      return invalid
//
// What is added has files of its own: candidates.hpp ranks them (several stops, speeds, work),
// chosen_moves.hpp says whom a move waits for (sizes, zones, booking ahead, forbidden
// rotations), arrivals.hpp computes when robots arrive (queues, rotations, turns on the spot).
// Where robots have sizes, several robots may be near to v: all of them are pushed, one after the
// other. With one speed, no work and no booking ahead this is PIBT.
//
// Okumura, Machida, Defago & Tamura, "Priority inheritance with backtracking for iterative
// multi-agent path finding", Artificial Intelligence 310, 2022; the swap operation: Okumura,
// "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distances/space_utilization.hpp"
#include "distances/step_tables.hpp"
#include "lacam/arrivals.hpp"
#include "lacam/candidates.hpp"
#include "lacam/chosen_moves.hpp"
#include "lacam/fleet_state.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Pibt {
  public:
    // Borrows everything.
    Pibt(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
         std::uint64_t seed);

    // Fixes the next vertex of a free robot at this instant; its own vertex: the robot stays.
    void fix(RobotId robot, VertexId vertex);

    // Chooses for these robots in this order, and for the robots that they push; false if no choice
    // is possible. Removes all fixes.
    bool choose(const FleetState& now, std::span<const RobotId> order);

    // The moves of the latest choice.
    std::span<const Decision> decisions() const { return decisions_; }

    // The ticks that a robot needs for its quickest edge.
    Tick pace(RobotId robot) const { return candidates_.pace(robot); }

    // The number of choices of single robots since construction.
    std::int64_t n_choices() const { return n_choices_; }

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
        std::size_t k;               // the candidate that it tries
        ChosenMoves::Ahead ahead{};  // of that candidate; no place: it is not taken yet
        RobotId pushed = nobody;
    };
    enum class Choice : std::uint8_t { open, valid, invalid };

    bool take_fixed(const FleetState& now);
    bool choose_all(const FleetState& now, std::span<const RobotId> order);
    bool choose_one(const FleetState& now, RobotId robot);
    Choice begin(const FleetState& now, RobotId robot);
    Choice try_candidates(const FleetState& now, Choice pushed);
    bool take_candidate(const FleetState& now, Frame& frame);
    Choice end(const FleetState& now, Choice choice);
    void pull(const FleetState& now, const Frame& frame);
    bool has_to_wait(const FleetState& now, RobotId robot);
    bool is_idle(const FleetState& now, RobotId robot) const {
        return !moves_.has_chosen(robot) && !now.is_busy(robot);
    }

    const Problem& problem_;
    ChosenMoves moves_;
    Candidates candidates_;
    Arrivals arrivals_;
    std::vector<Candidate> places_;  // a stack: candidates of each robot that is choosing
    std::vector<Frame> frames_;      // a stack: robots that are choosing, each pushed by the last
    std::vector<Fixed> fixed_;
    std::vector<Decision> decisions_;
    std::int64_t n_choices_ = 0;
};

}  // namespace rightofway
