#include "rightofway/prioritized.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// For how many of its slowest edges a robot's home is kept free: at first, and as much longer each
// time it has lost its track.
constexpr Tick hold_edges = 16;

constexpr Tick highest_price = Tick{1} << 32;

// See Errand.
constexpr Tick greed = 1;

}  // namespace

Prioritized::Prioritized(const Fleet& fleet, FleetPlan& plan, const TrackPrices& prices)
    : fleet_(fleet),
      plan_(plan),
      track_prices_(prices),
      search_(fleet.roads(), fleet.rules()),
      reader_(fleet),
      prices_(static_cast<std::size_t>(fleet.n_robots())),
      holds_(prices_.size()),
      next_raise_(prices.states_between_raises) {
    for (RobotId robot = 0; robot < fleet.n_robots(); ++robot) {
        prices_[static_cast<std::size_t>(robot)] = prices.first * first_hold(robot);
        holds_[static_cast<std::size_t>(robot)] = first_hold(robot);
    }
}

Tick Prioritized::first_hold(RobotId robot) const {
    const auto pace = fleet_.pace(robot);
    return pace.empty() ? 1 : hold_edges * *std::max_element(pace.begin(), pace.end());
}

void Prioritized::start(std::span<const RobotId> order) {
    waiting_.assign(order.begin(), order.end());
    for (const RobotId robot : order) {
        plan_.hold_home(robot, holds_[static_cast<std::size_t>(robot)]);
    }
}

SearchEnd Prioritized::run(std::int64_t n_searches, const SafeIntervalSearch::IsOver& is_over) {
    for (; !waiting_.empty(); waiting_.pop_front()) {
        if (n_searches_ >= n_searches || !place(waiting_.front(), is_over)) {
            return SearchEnd::stopped;
        }
        ++n_searches_;
        raise_prices();
    }
    return SearchEnd::found;
}

bool Prioritized::place(RobotId robot, const SafeIntervalSearch::IsOver& is_over) {
    plan_.hold_home(robot, 0);
    const Errand errand{reader_.read(robot), plan_.bookings(), prices_, infinity, greed};
    if (search_.run(errand, is_over) != SearchEnd::found) {
        return false;
    }
    search_.track(track_.visits);
    track_.completion = search_.completion();
    plan_.in_the_way(robot, track_, met_);
    for (const RobotId other : met_) {
        if (plan_.has_track(other)) {
            evict(other);
        }
    }
    plan_.exchange(robot, track_);
    return true;
}

void Prioritized::raise_prices() {
    for (; search_.n_expanded() >= next_raise_;
         next_raise_ += track_prices_.states_between_raises) {
        for (Tick& price : prices_) {
            price = std::min(price + price / 4, highest_price);
        }
    }
}

void Prioritized::evict(RobotId robot) {
    TimedTrack none;
    plan_.exchange(robot, none);
    plan_.hold_home(robot, holds_[static_cast<std::size_t>(robot)]);
    prices_[static_cast<std::size_t>(robot)] += track_prices_.dearer * first_hold(robot);
    holds_[static_cast<std::size_t>(robot)] += first_hold(robot);
    waiting_.push_back(robot);
    ++n_evictions_;
}

}  // namespace rightofway
