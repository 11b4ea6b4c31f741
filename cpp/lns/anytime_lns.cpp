#include "lns/anytime_lns.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// A plan is stuck after this number of tasks per robot in a row without a gain.
constexpr std::int64_t idle_tasks_per_robot = 50;

}  // namespace

AnytimeLns::AnytimeLns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
                       std::uint64_t seed, std::size_t n_threads)
    : distances_(distances),
      plan_(plan),
      alone_(alone),
      seed_(seed),
      n_threads_(n_threads),
      idle_until_stuck_(idle_tasks_per_robot * distances.problem().n_robots()),
      lns_(distances, plan, alone, seed, n_threads) {}

void AnytimeLns::run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
                     const StopCondition& is_due) {
    if (!population_) {
        const std::int64_t before = lns_.n_tasks();
        lns_.run(n_tasks, std::min(patience, idle_until_stuck_), is_over, is_due);
        const std::int64_t n_done = lns_.n_tasks() - before;
        if (lns_.n_idle() < idle_until_stuck_ || (n_done > 0 && is_due())) {
            return;
        }
        n_tasks -= n_done;
        population_.emplace(distances_, plan_, alone_, seed_, n_threads_, lns_.n_idle());
    }
    population_->run(n_tasks, patience, is_over, is_due);
}

std::int64_t AnytimeLns::n_tasks() const {
    return lns_.n_tasks() + (population_ ? population_->n_tasks() : 0);
}

std::int64_t AnytimeLns::n_idle() const {
    return population_ ? population_->n_idle() : lns_.n_idle();
}

std::int64_t AnytimeLns::n_expanded() const {
    return lns_.n_expanded() + (population_ ? population_->n_expanded() : 0);
}

}  // namespace rightofway
