// A sequence of configurations that brings every robot through all of its stages.
//
// Depth-first search over configurations of the whole fleet. Each configuration asks for one
// successor at a time, and only when asked again is told a little more of where which robot has to
// go; so a greedy step for all robots (UntimedPibt) mostly does, and yet in the end every possible
// step is tried. The search is complete: it finds a sequence, or proves that there is none.
//
// Okumura, "LaCAM: Search-based algorithm for quick multi-agent pathfinding", AAAI 2023. Here a
// configuration also says how far each robot is on its trip, so stops and the way home are part
// of the one search.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "lacam/untimed_pibt.hpp"

namespace rightofway {

class UntimedLacam {
  public:
    static constexpr std::int64_t steps_between_questions = 64;

    // Borrows everything. `ends_anywhere` is for each robot, or empty.
    UntimedLacam(const Problem& problem, StepTables& tables, std::uint32_t seed,
                 std::span<const std::uint8_t> ends_anywhere = {});

    // `is_over` is asked every `steps_between_questions` steps whether to stop.
    SearchEnd run(const StopCondition& is_over);

    // Where all robots are, step by step: the first n_robots entries are the homes.
    std::vector<VertexId> steps() const;

  private:
    // Some robots are told where to go: this one, and those up the chain of parents.
    struct Constraint {
        std::int32_t parent;
        std::int32_t depth;  // how many robots are told
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
