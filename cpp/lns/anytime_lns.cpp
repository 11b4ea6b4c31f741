#include "lns/anytime_lns.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// After so many tasks in a row without a gain a plan is stuck.
constexpr std::int64_t tasks_per_robot = 50;

}  // namespace

AnytimeLns::AnytimeLns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
                       std::uint64_t seed, std::size_t n_threads)
    : distances_(distances),
      plan_(plan),
      alone_(alone),
      seed_(seed),
      n_threads_(n_threads),
      idle_until_stuck_(tasks_per_robot * distances.problem().n_robots()),
      one_(distances, plan, alone, seed, n_threads) {}

void AnytimeLns::run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
                     const StopCondition& is_due) {
    if (!many_) {
        const std::int64_t before = one_.n_tasks();
        one_.run(n_tasks, std::min(patience, idle_until_stuck_), is_over, is_due);
        const std::int64_t n_done = one_.n_tasks() - before;
        if (one_.n_idle() < idle_until_stuck_ || (n_done > 0 && is_due())) {
            return;
        }
        n_tasks -= n_done;
        many_.emplace(distances_, plan_, alone_, seed_, n_threads_, one_.n_idle());
    }
    many_->run(n_tasks, patience, is_over, is_due);
}

std::int64_t AnytimeLns::n_tasks() const { return one_.n_tasks() + (many_ ? many_->n_tasks() : 0); }

std::int64_t AnytimeLns::n_idle() const { return many_ ? many_->n_idle() : one_.n_idle(); }

std::int64_t AnytimeLns::n_expanded() const {
    return one_.n_expanded() + (many_ ? many_->n_expanded() : 0);
}

}  // namespace rightofway
