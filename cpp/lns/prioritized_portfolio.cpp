#include "lns/prioritized_portfolio.hpp"

#include <chrono>
#include <optional>
#include <thread>

namespace rightofway {
namespace {

constexpr auto between_questions = std::chrono::milliseconds(5);

}  // namespace

void PrioritizedPortfolio::Side::run(std::int64_t n_searches, const StopCondition& is_over) {
    is_there = planner.run(n_searches, is_over) == SearchEnd::found;
}

// Whether the other one was there before and does not look worse.
bool PrioritizedPortfolio::Side::is_beaten_by(const Side& other) const {
    return other.is_there && other.planner.n_expanded() <= planner.n_expanded() &&
           other.plan.flowtime() <= planner.highest_outlook();
}

// Goes on with a plan in another thread, as long as this lives and it may be better than the rival.
class PrioritizedPortfolio::Beside {
  public:
    Beside(Side& side, const Side& rival, std::int64_t n_searches)
        : thread_([this, &side, &rival, n_searches] {
              side.run(n_searches, [&] { return is_stopped_ || side.is_beaten_by(rival); });
              has_ended_ = true;
          }) {}
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;
    ~Beside() {
        is_stopped_ = true;
        thread_.join();
    }

    void wait(const StopCondition& is_over) const {
        while (!has_ended_ && !is_over()) {
            std::this_thread::sleep_for(between_questions);
        }
    }

  private:
    std::atomic<bool> has_ended_ = false;
    std::atomic<bool> is_stopped_ = false;
    std::thread thread_;  // last, as it uses the others
};

PrioritizedPortfolio::PrioritizedPortfolio(SharedDistances& distances, FleetPlan& plan,
                                           std::span<const RobotId> order)
    : plan_(plan),
      plan_in_haste_(distances.problem()),
      patient_{plan_, Prioritized(distances, plan_, patient)},
      hasty_{plan_in_haste_, Prioritized(distances, plan_in_haste_, hasty)} {
    patient_.planner.start(order);
    hasty_.planner.start(order);
}

bool PrioritizedPortfolio::run(std::int64_t n_searches, bool has_second_thread,
                               const StopCondition& is_over, const StopCondition& is_late) {
    {
        std::optional<Beside> beside;
        if (has_second_thread) {
            beside.emplace(hasty_, patient_, n_searches);
        } else {
            hasty_.run(n_searches, is_over);
        }
        patient_.run(n_searches, [&] {
            return hasty_.is_there ? is_late() || patient_.is_beaten_by(hasty_) : is_over();
        });
        if (beside) {
            beside->wait(is_over);
        }
    }
    if (hasty_.is_there && (!patient_.is_there || is_hasty_better())) {
        plan_ = plan_in_haste_;
    }
    return patient_.is_there || hasty_.is_there;
}

// Not simply whose flowtime is less, as either might have been given up because it did not look so.
bool PrioritizedPortfolio::is_hasty_better() const {
    return patient_.is_beaten_by(hasty_) ||
           (!hasty_.is_beaten_by(patient_) && plan_in_haste_.flowtime() < plan_.flowtime());
}

}  // namespace rightofway
