// LaCAM without times: a sequence of configurations that leads each robot through all its stages.
//
// Depth-first search over configurations of the whole fleet. Each visit of a node generates one
// successor with `UntimedPibt` under one constraint (the next vertices of some robots). Constraints
// are added lazily, so a greedy step mostly suffices, but in the end every step is tried. The
// search is complete: it finds a sequence or proves that none exists.
//
// Okumura, "LaCAM: Search-based algorithm for quick multi-agent pathfinding", AAAI 2023. Here a
// configuration includes the stage of each robot, so one search covers stops and the way home.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "lacam/untimed_pibt.hpp"

namespace rightofway {

class UntimedLacam {
  public:
    // Borrows everything. `ends_anywhere`: per robot, or empty (see `is_goal`).
    UntimedLacam(const Problem& problem, StepTables& tables, std::uint32_t seed,
                 std::span<const std::uint8_t> ends_anywhere = {});

    // Stops once `is_over` is true, or after about `most_steps` steps of the fleet.
    SearchEnd run(const StopCondition& is_over, std::int64_t most_steps = any_number);

    // The configurations, n_robots vertices per step; the first n_robots entries are the homes.
    std::vector<VertexId> steps() const;

  private:
    static constexpr std::int64_t any_number = std::numeric_limits<std::int64_t>::max();

    // Fixes the next vertex of `robot`, and of the robots up the chain of parents.
    struct Constraint {
        std::int32_t parent;
        std::int32_t depth;  // number of fixed robots
        RobotId robot;
        VertexId vertex;
    };
    struct Node {
        Configuration now;
        std::int32_t parent;
        std::vector<float> urgency;
        std::vector<RobotId> order;  // most urgent first
        std::vector<Constraint> constraints;
        std::size_t next_constraint;
    };

    void add(Configuration&& now, std::int32_t parent);
    std::vector<float> urgency(const Configuration& now, std::int32_t parent) const;
    void branch(Node& node, std::int32_t constraint);
    bool take_step(Node& node, std::int32_t constraint);
    Configuration after_step(const Configuration& now) const;
    std::int32_t find(const Configuration& now) const;

    const Problem& problem_;
    std::span<const std::uint8_t> ends_anywhere_;
    UntimedPibt pibt_;
    std::vector<Node> nodes_;
    std::vector<std::int32_t> open_;
    std::unordered_multimap<std::size_t, std::int32_t> known_;  // by hash
    std::int32_t goal_ = -1;
};

}  // namespace rightofway
