#include "lns/prioritized.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// The start hold of a robot in drives of its slowest edge: at first, and the increase per eviction.
constexpr Tick hold_edges = 16;

constexpr double raise = 1.25;
constexpr double highest_level = 1000;

}  // namespace

Prioritized::Prioritized(SharedDistances& distances, FleetPlan& plan, const TrackPrices& prices)
    : distances_(distances),
      problem_(distances.problem()),
      plan_(plan),
      track_prices_(prices),
      search_(problem_.roads(), problem_.rules()),
      reader_(distances),
      prices_(static_cast<std::size_t>(problem_.n_robots())),
      n_evictions_(prices_.size(), 0),
      expected_(prices_.size()),
      next_raise_(prices.states_between_raises) {
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        prices_[index(robot)] = prices.first * first_hold(robot);
    }
}

Tick Prioritized::first_hold(RobotId robot) const {
    return problem_.pace(robot).empty() ? 1 : hold_edges * problem_.slowest_edge(robot);
}

void Prioritized::keep_home(RobotId robot) {
    const Tick holds = 1 + n_evictions_[index(robot)];
    plan_.hold_home(robot, problem_.ready(robot) + holds * first_hold(robot));
}

void Prioritized::start(std::span<const RobotId> order) {
    waiting_.assign(order.begin(), order.end());
    for (const RobotId robot : order) {
        keep_home(robot);
        Tick& expected = expected_[index(robot)];
        expected = distances_.alone(robot);
        outlook_ += problem_.weight(robot) * expected;
    }
    highest_outlook_ = outlook_;
}

SearchEnd Prioritized::run(std::int64_t n_searches, const StopCondition& is_over) {
    close_starts(true);
    const SearchEnd end = place_all(n_searches, is_over);
    close_starts(false);
    return end;
}

void Prioritized::close_starts(bool are_closed) {
    for (RobotId robot = 0; robot < problem_.n_robots() && problem_.has_times(); ++robot) {
        plan_.close_start(robot, are_closed);
    }
}

SearchEnd Prioritized::place_all(std::int64_t n_searches, const StopCondition& is_over) {
    for (; !waiting_.empty(); waiting_.pop_front()) {
        if (n_searches_ >= n_searches || !place(waiting_.front(), is_over)) {
            return SearchEnd::stopped;
        }
        ++n_searches_;
        highest_outlook_ = std::max(highest_outlook_, outlook_);
        raise_prices();
    }
    return SearchEnd::found;
}

bool Prioritized::place(RobotId robot, const StopCondition& is_over) {
    plan_.close_start(robot, false);
    const bool is_placed = place_open(robot, is_over);
    plan_.close_start(robot, true);
    return is_placed;
}

bool Prioritized::place_open(RobotId robot, const StopCondition& is_over) {
    plan_.hold_home(robot, 0);
    if (!find(robot, is_over)) {
        return false;
    }
    if (evict_conflicting() && was_evicted(robot) && conflicts_with_start_holds(robot) &&
        random_.below(2) == 0) {
        if (!find(robot, is_over)) {
            return false;
        }
        evict_conflicting();
    }
    Tick& expected = expected_[index(robot)];
    outlook_ += problem_.weight(robot) * (track_.cost - expected);
    expected = track_.cost;
    plan_.exchange(robot, track_);
    return true;
}

bool Prioritized::find(RobotId robot, const StopCondition& is_over) {
    const auto search = [&](const Trip& trip) {
        SearchRequest request{trip, plan_.bookings(), prices_, never, track_prices_.greed};
        request.rest_price = track_prices_.first * first_hold(robot);
        return search_.run(request, is_over);
    };
    SearchEnd end = SearchEnd::proven_none;
    if (problem_.has_arcs()) {
        // If possible, stages end before those that wait for them begin. Otherwise robots would
        // evict each other for ends that are late for no reason.
        for (const bool keeps_followers : {true, false}) {
            if (end == SearchEnd::proven_none) {
                plan_.find_limits(robot, keeps_followers, limits_);
                end = search(reader_.read(robot, limits_.earliest, limits_.latest));
            }
        }
    } else {
        end = search(reader_.read(robot));
    }
    if (end != SearchEnd::found) {
        return false;
    }
    search_.track(track_.visits);
    if (problem_.has_arcs()) {
        plan_.measure(robot, track_, limits_);
    } else if (problem_.has_times()) {
        plan_.measure(robot, track_);
    } else {
        track_.cost = search_.completion() + plan_.surcharges(track_.visits);
    }
    plan_.find_conflicting(robot, track_, conflicting_);
    return true;
}

// Evicts the robots in conflicting_ that have tracks; conflicting_ keeps the evicted robots.
bool Prioritized::evict_conflicting() {
    std::erase_if(conflicting_, [this](RobotId other) { return !plan_.has_track(other); });
    for (const RobotId other : conflicting_) {
        evict(other);
    }
    return !conflicting_.empty();
}

// Whether the track conflicts with the start hold of a robot in conflicting_.
bool Prioritized::conflicts_with_start_holds(RobotId robot) {
    evicted_.swap(conflicting_);
    plan_.find_conflicting(robot, track_, conflicting_);
    return std::any_of(evicted_.begin(), evicted_.end(), [this](RobotId other) {
        return std::binary_search(conflicting_.begin(), conflicting_.end(), other);
    });
}

void Prioritized::raise_prices() {
    for (; search_.n_expanded() >= next_raise_ && level_ < highest_level;
         next_raise_ += track_prices_.states_between_raises) {
        level_ *= raise;
        for (Tick& price : prices_) {
            price = static_cast<Tick>(raise * static_cast<double>(price));
        }
    }
}

void Prioritized::evict(RobotId robot) {
    TimedTrack no_track;
    plan_.exchange(robot, no_track);
    const Tick dearer = track_prices_.dearer * first_hold(robot);
    prices_[index(robot)] += static_cast<Tick>(level_ * static_cast<double>(dearer));
    keep_home(robot);
    ++n_evictions_[index(robot)];
    waiting_.push_back(robot);
}

}  // namespace rightofway
