#include "lns/prioritized_portfolio.hpp"

#include <chrono>
#include <optional>
#include <thread>

#include "core/thread_group.hpp"

namespace rightofway {
namespace {

constexpr auto between_waits = std::chrono::milliseconds(5);

}  // namespace

void PrioritizedPortfolio::Side::run(std::int64_t n_searches, const StopCondition& is_over) {
    is_complete = planner.run(n_searches, is_over) == SearchEnd::found;
}

// Whether the other run finished in no more states with a flowtime no greater than projected here.
bool PrioritizedPortfolio::Side::is_beaten_by(const Side& other) const {
    return other.is_complete && other.planner.n_expanded() <= planner.n_expanded() &&
           other.plan.cost() <= planner.highest_outlook();
}

// Runs a side in another thread until destruction or until the rival has beaten it.
class PrioritizedPortfolio::SecondThread {
  public:
    SecondThread(Side& side, const Side& rival, std::int64_t n_searches) {
        const auto work = [this, &side, &rival, n_searches] {
            side.run(n_searches, [&] { return is_stopped_ || side.is_beaten_by(rival); });
            has_ended_ = true;
        };
        thread_.start(work, [this] { has_ended_ = true; });
    }
    SecondThread(const SecondThread&) = delete;
    SecondThread& operator=(const SecondThread&) = delete;
    ~SecondThread() { is_stopped_ = true; }  // the thread is joined after that

    // Waits until the side has ended, or ends it. Rethrows an exception of the side.
    void finish(const StopCondition& is_over) {
        while (!has_ended_ && !is_over()) {
            std::this_thread::sleep_for(between_waits);
        }
        is_stopped_ = true;
        thread_.join();
    }

  private:
    std::atomic<bool> has_ended_ = false;
    std::atomic<bool> is_stopped_ = false;
    ThreadGroup thread_;  // last: uses the other members
};

PrioritizedPortfolio::PrioritizedPortfolio(SharedDistances& distances, FleetPlan& plan,
                                           std::span<const RobotId> order)
    : plan_(plan),
      hasty_plan_(plan),
      patient_{plan_, Prioritized(distances, plan_, patient)},
      hasty_{hasty_plan_, Prioritized(distances, hasty_plan_, hasty)} {
    patient_.planner.start(order);
    hasty_.planner.start(order);
}

bool PrioritizedPortfolio::run(std::int64_t n_searches, bool has_second_thread,
                               const StopCondition& is_over, const StopCondition& is_late) {
    {
        std::optional<SecondThread> second_thread;
        if (has_second_thread) {
            second_thread.emplace(hasty_, patient_, n_searches);
        } else {
            hasty_.run(n_searches, is_over);
        }
        patient_.run(n_searches, [&] {
            return hasty_.is_complete ? is_late() || patient_.is_beaten_by(hasty_) : is_over();
        });
        if (second_thread) {
            second_thread->finish(is_over);
        }
    }
    return patient_.is_complete || hasty_.is_complete;
}

const FleetPlan& PrioritizedPortfolio::best() const {
    const bool is_hasty = hasty_.is_complete && (!patient_.is_complete || is_hasty_better());
    return is_hasty ? hasty_plan_ : plan_;
}

bool PrioritizedPortfolio::has_ended() const {
    return (patient_.is_complete || patient_.is_beaten_by(hasty_)) &&
           (hasty_.is_complete || hasty_.is_beaten_by(patient_));
}

// Compares projections before flowtimes, because a run may have been stopped for its projection.
bool PrioritizedPortfolio::is_hasty_better() const {
    return patient_.is_beaten_by(hasty_) ||
           (!hasty_.is_beaten_by(patient_) && hasty_plan_.cost() < plan_.cost());
}

}  // namespace rightofway
