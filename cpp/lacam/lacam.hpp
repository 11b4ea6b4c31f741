// A plan for a fleet with clocks, instant by instant.
//
// Depth-first search over the states of the fleet at the instants at which somebody has finished
// something. Each state asks for one successor at a time, and only when asked again is told a
// little more of where which robot has to go, so a greedy choice (Pibt) mostly does. A state
// is kept as the decisions that lead to it, and made again by taking them again, from a snapshot
// on the way.
//
// With one speed, no work and no booking ahead this is LaCAM (see untimed_lacam.hpp). States are
// told apart by fingerprints of 64 bits, and robots at work cannot be pushed: to prove that there
// is no plan, ask UntimedLacam.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "lacam/fleet_state.hpp"
#include "lacam/pibt.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Lacam {
  public:
    // Borrows everything.
    Lacam(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
          std::uint64_t seed);

    // Stops when `is_over` says so, asked every few thousand units of effort, or when that is
    // spent. A choice of a robot is a unit, and so is a decision that is taken again to make a
    // state. `proven_none` is not among its ends.
    SearchEnd run(const StopCondition& is_over, std::int64_t most_effort);

    // Where each robot is, when; empty unless a plan was found.
    Tracks tracks() const;

  private:
    // Some robots are told where to go: this one, and those up the chain of parents.
    struct Constraint {
        std::int32_t parent;
        std::int32_t depth;  // how many robots are told
        RobotId robot;
        VertexId vertex;
    };
    struct Node {
        std::int32_t parent;
        std::int32_t level;          // how many nodes are above
        std::size_t first_decision;  // those that led here from the parent
        std::size_t end_decision;
        std::size_t next_constraint;
        std::vector<Constraint> constraints;
        std::vector<RobotId> order;  // who is told first; made when first needed
    };

    struct Urgency {
        Tick urgency;
        std::int32_t rank;
        RobotId robot;
    };

    struct Snapshot {
        std::int32_t node;
        FleetState state;
    };

    SearchEnd expand();
    bool next_constraint(Node& node);
    void branch(Node& node, std::int32_t constraint);
    std::span<const RobotId> by_urgency();
    void go_on(std::int32_t from);
    bool add(std::int32_t parent, std::size_t first_decision);
    void restore(std::int32_t node);
    void take_again(std::int32_t node);
    const Snapshot* snapshot_of(std::int32_t node) const;
    void keep_snapshot(std::int32_t node);

    const Problem& problem_;
    Pibt pibt_;
    const FleetState start_;
    FleetState state_;
    std::int32_t state_of_;  // the node whose state that is
    std::vector<Snapshot> snapshots_;
    std::size_t oldest_snapshot_ = 0;
    std::vector<std::int32_t> rank_;  // of each robot: longest way first
    std::vector<Urgency> urgencies_;
    std::vector<RobotId> order_;  // of the undecided, the most urgent first
    std::vector<Node> nodes_;
    std::vector<std::int32_t> open_;
    std::vector<Decision> decisions_;
    std::int64_t n_retaken_ = 0;                             // decisions, to make states again
    std::unordered_map<std::uint64_t, std::int32_t> known_;  // by fingerprint
    std::int32_t goal_;
};

}  // namespace rightofway
