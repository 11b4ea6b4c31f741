// LaCAM with times: a plan for a fleet with own speeds and work times.
//
// Depth-first search over states of the fleet at the instants when a robot finishes a move or its
// work. Each visit of a state generates one successor with `Pibt` under one constraint (the next
// vertices of some robots); constraints are added lazily, so a greedy choice mostly suffices.
//
// Okumura, "LaCAM: Search-based algorithm for quick multi-agent pathfinding", AAAI 2023.
//
// Where the fleet moves in steps (Problem::moves_in_steps), this is LaCAM as published, but for the
// stages of a trip: a node stores where robots are, states are compared in full, and a search that
// has tried every step proves that no plan exists. In other fleets a node stores the decisions that
// lead to its state, and the state is restored from a snapshot of an ancestor. That search is
// incomplete: fingerprints of 64 bits identify states, and robots at work cannot be pushed.
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
    // Borrows everything. `ends_anywhere`: per robot, whether it only prefers the vertex of its
    // last stage; or empty.
    Lacam(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
          std::uint64_t seed, std::span<const std::uint8_t> ends_anywhere = {});

    // Stops once `is_over` is true (evaluated every few thousand units of effort) or after
    // `most_effort` units. One unit is a choice of a robot or a decision repeated to restore a
    // state. Returns `proven_none` only for fleets that move in steps.
    SearchEnd run(const StopCondition& is_over, std::int64_t most_effort);

    // The tracks of all robots; empty unless the search found a plan.
    Tracks tracks() const;

  private:
    // Fixes the next vertex of `robot`, and of the robots up the chain of parents.
    struct Constraint {
        std::int32_t parent;
        std::int32_t depth;  // number of fixed robots
        RobotId robot;
        VertexId vertex;
    };
    struct Node {
        std::int32_t parent;
        std::int32_t level;          // number of ancestors
        std::size_t first_decision;  // decisions from the parent to here
        std::size_t end_decision;
        std::size_t next_constraint;
        std::vector<Constraint> constraints;
        std::vector<RobotId> order;  // of constraints; made at the first use
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
    void generate_successor(std::int32_t from);
    std::int32_t known_node() const;
    bool is_goal() const;
    bool add(std::int32_t parent, std::size_t first_decision);
    std::span<const Standing> standing(std::int32_t node) const;
    template <class Use>
    void for_each_decision(std::int32_t node, const Use& use) const;
    void restore(std::int32_t node);
    void replay_step(std::int32_t node);
    const Snapshot* snapshot_of(std::int32_t node) const;
    void keep_snapshot(std::int32_t node);

    const Problem& problem_;
    const bool in_steps_;  // Problem::moves_in_steps
    const std::span<const std::uint8_t> ends_anywhere_;
    Pibt pibt_;
    const FleetState start_;
    FleetState state_;
    std::int32_t state_of_;  // the node of `state_`
    std::vector<Snapshot> snapshots_;
    std::size_t oldest_snapshot_ = 0;
    std::vector<std::int32_t> rank_;  // of each robot; longest way: 0
    std::vector<Urgency> urgencies_;
    std::vector<RobotId> order_;  // of undecided robots, most urgent first
    std::vector<Node> nodes_;
    std::vector<std::int32_t> open_;
    std::vector<Decision> decisions_;  // of all nodes; none in steps
    std::vector<Standing> standing_;   // in steps: n_robots for each node
    std::int64_t n_replayed_ = 0;      // decisions repeated by `restore`
    std::unordered_multimap<std::uint64_t, std::int32_t> known_;  // by fingerprint
    std::int32_t goal_;
};

}  // namespace rightofway
