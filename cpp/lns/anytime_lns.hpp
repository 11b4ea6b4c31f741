// Improvement of a plan: of that one alone until it is stuck, then of a population.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "lns/lns.hpp"
#include "lns/population.hpp"

namespace rightofway {

class AnytimeLns {
  public:
    // Borrows all; every robot of the plan has a track. `alone` is the least completion of each.
    AnytimeLns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
               std::uint64_t seed, std::size_t n_threads);

    // As `Lns::run`.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const;
    std::int64_t n_idle() const;  // since the last gain
    std::int64_t n_expanded() const;

  private:
    SharedDistances& distances_;
    FleetPlan& plan_;
    std::span<const Tick> alone_;
    std::uint64_t seed_;
    std::size_t n_threads_;
    std::int64_t idle_until_stuck_;
    Lns one_;
    std::optional<Population> many_;
};

}  // namespace rightofway
