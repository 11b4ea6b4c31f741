#include "rightofway/in_turn.hpp"

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "rightofway/prioritized.hpp"

namespace rightofway {
namespace {

constexpr auto between_questions = std::chrono::milliseconds(5);

// A plan that is being made in haste by another thread, as long as this lives.
class SecondPlan {
  public:
    SecondPlan(const Fleet& fleet, std::span<const RobotId> order, std::int64_t n_searches)
        : plan_(fleet), thread_([this, &fleet, order, n_searches] {
              const auto is_over = [this] { return is_stopped_.load(); };
              Prioritized planner(fleet, plan_, hasty);
              is_found_ = planner.run(order, n_searches, is_over) == SearchEnd::found;
              has_ended_ = true;
          }) {}
    SecondPlan(const SecondPlan&) = delete;
    SecondPlan& operator=(const SecondPlan&) = delete;
    ~SecondPlan() {
        is_stopped_ = true;
        thread_.join();
    }

    // Waits for it; false if there is none.
    bool take(FleetPlan& plan, const SafeIntervalSearch::IsOver& is_over) {
        while (!has_ended_ && !is_over()) {
            std::this_thread::sleep_for(between_questions);
        }
        if (!has_ended_ || !is_found_) {
            return false;
        }
        plan = plan_;
        return true;
    }

  private:
    FleetPlan plan_;
    bool is_found_ = false;
    std::atomic<bool> has_ended_ = false;
    std::atomic<bool> is_stopped_ = false;
    std::thread thread_;  // last, as it uses the others
};

}  // namespace

bool plan_in_turn(const Fleet& fleet, FleetPlan& plan, std::span<const RobotId> order,
                  std::int64_t n_searches, bool has_second_thread,
                  const SafeIntervalSearch::IsOver& is_over) {
    std::optional<SecondPlan> second;
    if (has_second_thread) {
        second.emplace(fleet, order, n_searches);
    }
    if (Prioritized(fleet, plan).run(order, n_searches, is_over) == SearchEnd::found) {
        return true;
    }
    if (second) {
        return second->take(plan, is_over);
    }
    plan = FleetPlan(fleet);
    return Prioritized(fleet, plan, hasty).run(order, n_searches, is_over) == SearchEnd::found;
}

}  // namespace rightofway
