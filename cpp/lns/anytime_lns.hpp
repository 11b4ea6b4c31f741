// Anytime improvement of a plan: LNS until the plan is stuck, then a population.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "distances/shared_distances.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/lns.hpp"
#include "lns/population.hpp"

namespace rightofway {

class AnytimeLns {
  public:
    // Borrows all; every robot needs a track. `alone`: completion time of each robot driving alone.
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
    Lns lns_;
    std::optional<Population> population_;
};

}  // namespace rightofway
