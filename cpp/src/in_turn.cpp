#include "rightofway/in_turn.hpp"

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

namespace rightofway {
namespace {

constexpr auto between_questions = std::chrono::milliseconds(5);

// Goes on with a planner in another thread, as long as this lives.
class Beside {
  public:
    Beside(Prioritized& planner, std::int64_t n_searches)
        : thread_([this, &planner, n_searches] {
              end_ = planner.run(n_searches, [this] { return is_stopped_.load(); });
              has_ended_ = true;
          }) {}
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;
    ~Beside() {
        is_stopped_ = true;
        thread_.join();
    }

    bool has_found() const { return has_ended_ && end_ == SearchEnd::found; }

    SearchEnd wait(const SafeIntervalSearch::IsOver& is_over) const {
        while (!has_ended_ && !is_over()) {
            std::this_thread::sleep_for(between_questions);
        }
        return has_ended_ ? end_ : SearchEnd::stopped;
    }

  private:
    SearchEnd end_ = SearchEnd::stopped;
    std::atomic<bool> has_ended_ = false;
    std::atomic<bool> is_stopped_ = false;
    std::thread thread_;  // last, as it uses the others
};

}  // namespace

InTurn::InTurn(const Fleet& fleet, FleetPlan& plan, std::span<const RobotId> order)
    : plan_(plan),
      plan_in_haste_(fleet),
      patient_(fleet, plan, patient),
      hasty_(fleet, plan_in_haste_, hasty) {
    patient_.start(order);
    hasty_.start(order);
}

bool InTurn::run(std::int64_t n_searches, bool has_second_thread,
                 const SafeIntervalSearch::IsOver& is_over,
                 const SafeIntervalSearch::IsOver& is_late) {
    std::optional<Beside> beside;
    if (has_second_thread) {
        beside.emplace(hasty_, n_searches);
    }
    const auto is_enough = [&] { return beside && beside->has_found() ? is_late() : is_over(); };
    if (patient_.run(n_searches, is_enough) == SearchEnd::found) {
        return true;
    }
    return take(beside ? beside->wait(is_over) : hasty_.run(n_searches, is_over));
}

bool InTurn::take(SearchEnd second) {
    if (second != SearchEnd::found) {
        return false;
    }
    plan_ = plan_in_haste_;
    return true;
}

}  // namespace rightofway
