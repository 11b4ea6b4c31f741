// What trips with several stops, work and a last vertex add to SIPP: stages and their times, and
// the bound from the bookings of the last vertex.
#include <algorithm>

#include "search/sipp.hpp"

namespace rightofway {
namespace {

constexpr std::int64_t states_per_drive = 8;  // limit for aiming

}  // namespace

// The last visit can serve all final stages at the last vertex, without turns. Each stage before
// them takes its work, its turn and the way to the next stage.
void SafeIntervalSearch::measure_stages(const Trip& trip) {
    const std::size_t n = trip.n_stages();
    const std::size_t first = trip.first_stage_at_end();
    first_last_ = static_cast<std::int32_t>(first);
    to_go_.assign(n + 1, 0);
    for (std::size_t k = n; k-- > 0;) {
        to_go_[k] = trip.stage_work[k];
        to_go_[k] += k >= first ? to_go_[k + 1]
                                : trip.turn_after(k) +
                                      rest(trip.stage_vertex[k], static_cast<std::int32_t>(k) + 1);
    }
    if (trip.times.are_known()) {
        measure_times(trip);
    }
}

// The least completion by the earliest begin of each stage and the stages after it, and the latest
// arrival from which all of these can end in time.
void SafeIntervalSearch::measure_times(const Trip& trip) {
    const std::size_t n = trip.n_stages();
    soonest_.assign(n + 1, 0);
    in_time_.assign(n + 1, never);
    for (std::size_t k = n; k-- > 0;) {
        soonest_[k] = std::max(trip.times.earliest[k] + to_go_[k], soonest_[k + 1]);
        in_time_[k] =
            in_time_[k + 1] >= never ? never : in_time_[k + 1] - to_go_[k] + to_go_[k + 1];
        if (trip.times.latest[k] < never) {
            in_time_[k] = std::min(in_time_[k], trip.times.latest[k] - trip.stage_work[k]);
        }
    }
}

bool SafeIntervalSearch::is_in_time(const SearchNode& node) const {
    const auto stage = index(node.stage);
    return in_time_[stage] >= never ||
           node.ready + trip_->to_stage[stage].from(node.vertex) <= in_time_[stage];
}

// Where ends cost, h is the cost of the stages left for a robot that is alone on the roads and does
// not turn between edges.
Tick SafeIntervalSearch::value_in_time(const SearchNode& node, Tick way) const {
    const auto n = index(n_stages());
    if (has_completed(node)) {
        return node.cost;
    }
    if (!costs_ends_) {
        return std::max(node.ready + way, soonest_[index(node.stage)]) + node.cost;
    }
    auto stage = index(node.stage);
    Tick now = node.ready;
    Tick sum = node.cost;
    if (stage < n) {
        now += trip_->to_stage[stage].from(node.vertex);
    }
    for (; stage < n; ++stage) {
        const Tick end = std::max(now, trip_->times.earliest[stage]) + trip_->stage_work[stage];
        sum += trip_->times.cost_of(stage, end);
        now = end + to_go_[stage] - to_go_[stage + 1] - trip_->stage_work[stage];
    }
    return sum + trip_->times.weight * now;
}

// A lower bound of completion plus prices from the bookings of the last vertex: the robot enters
// after the end of a booking, or pays for the booking.
Tick SafeIntervalSearch::least_end() const {
    if (trip_->ends_anywhere() || costs_ends_ || last_gap_ != none) {
        return 0;
    }
    const auto last = at(trip_->stage_vertex.back());
    Tick paid = 0;
    Tick least = never;
    for (std::size_t k = last.size(); k > 0 && paid < least; --k) {
        least = std::min(least, paid + free_end(last.first(k)));
        paid += price(last[k - 1].robot);
    }
    least = std::min(least, paid + trip_->stage_work.back());
    return std::max({least, ends_from_, stays_from_ + trip_->stage_work.back()});
}

// The least completion time after all these bookings of the last vertex.
Tick SafeIntervalSearch::free_end(std::span<const BookedBy> before) const {
    if (before.empty()) {
        return trip_->stage_work.back();
    }
    const Tick approach = rules_.books_ahead ? least_drive_ : 0;
    return before.back().time.end + approach + trip_->stage_work.back();
}

// Whether bookings of the last vertex, or its earliest start, raise the bound above the completion
// time alone, and the bound is to wait for all of them.
bool SafeIntervalSearch::is_worth_aiming() const {
    if (trip_->ends_anywhere() || costs_ends_ || last_gap_ != none) {
        return false;
    }
    const auto last = at(trip_->stage_vertex.back());
    const Tick alone = trip_->times.ready + rest(trip_->home, 0);
    return least_f_ > (has_times_ ? std::max(alone, soonest_[0]) : alone) &&
           least_f_ >= free_end(last);
}

SearchEnd SafeIntervalSearch::aim(const StopCondition& is_over) {
    is_aiming_ = true;
    has_one_label_ = true;
    prices_ = {};
    limit_ = least_f_;
    return search(states_per_drive * (least_f_ / least_drive_ + 1), is_over);
}

// Ends the track: the last visit needs the gap that is asked for, or one without end, or pays for
// later bookings.
void SafeIntervalSearch::finish(std::int32_t node) {
    SearchNode after = states_[node];
    const auto here = at(after.vertex);
    if (!is_at_end(after) || (!may_stay_at_once() && index(after.gap) <= here.size())) {
        return;
    }
    if (last_gap_ != none && after.gap != last_gap_) {
        return;
    }
    for (auto k = index(after.gap); k < here.size() && last_gap_ == none; ++k) {
        after.cost += price(here[k].robot);
        if (after.cost >= never) {
            return;
        }
    }
    after.gap = static_cast<std::int32_t>(here.size());
    after.parent = node;
    after.drive = 0;
    if (has_times_) {
        finish_in_time(after);
        return;
    }
    after.ready += to_go_[index(after.stage)];
    after.stage = n_stages();
    reach(after, rest(after));
}

void SafeIntervalSearch::finish_in_time(SearchNode after) {
    const bool has_completed_before = has_completed(after);
    for (auto stage = index(after.stage); stage < trip_->n_stages(); ++stage) {
        after.ready = trip_->end_of(stage, after.ready);
        if (after.ready >= never) {
            return;
        }
        after.cost += costs_ends_ ? trip_->times.cost_of(stage, after.ready) : 0;
    }
    after.stage = n_stages();
    if (rest_price_ > 0 && trip_->ends_anywhere() && trip_->is_wanted(after.vertex)) {
        after.cost += rest_price_;
    }
    if (!has_completed_before && after.ready > latest_) {
        return;
    }
    if (!has_completed_before && completes_before_end_) {
        after.cost += completion_cost(after.ready);
    }
    reach(after, 0);
}

// Whether a visit of this node's vertex can be the last one.
bool SafeIntervalSearch::is_at_end(const SearchNode& node) const {
    return node.stage >= first_last_ && node.stage < n_stages() &&
           (node.vertex == trip_->stage_vertex.back() ||
            (trip_->ends_anywhere() && node.vertex < trip_->times.n_places));
}

// The earliest enter of a last visit.
Tick SafeIntervalSearch::earliest_stay(const SearchNode& candidate, Tick approach) const {
    return std::max(
        {candidate.ready, stays_from_ + approach, ends_from_ - to_go_[index(candidate.stage)]});
}

// Enters the gap without end to stay, as early as a last visit may begin.
void SafeIntervalSearch::stay_between(SearchNode candidate, Tick way, Tick latest, Tick approach,
                                      std::span<const BookedBy> along) {
    candidate.gap = static_cast<std::int32_t>(at(candidate.vertex).size());
    candidate.ready = free_drive(along, earliest_stay(candidate, approach), candidate.drive);
    if (candidate.ready <= latest && candidate.ready < never && price_of_swaps(candidate) == 0) {
        ++candidate.gap;
        reach(candidate, way);
    }
}

// Serves the next stage if the vertex is right and the gap is long enough.
void SafeIntervalSearch::serve(std::int32_t node) {
    if (has_times_) {
        serve_in_time(node);
        return;
    }
    SearchNode after = states_[node];
    if (after.stage + 1 >= n_stages() || trip_->stage_vertex[index(after.stage)] != after.vertex) {
        return;
    }
    after.ready += trip_->stage_work[index(after.stage)] + trip_->stage_turn[index(after.stage)];
    if (!pay_until(after, after.ready)) {
        return;
    }
    ++after.stage;
    after.parent = node;
    after.drive = 0;
    reach(after, rest(after));
}

// Stays at a vertex until a drive that begins at `tick`, and pays for the bookings that begin
// before it; false if a price is infinite.
bool SafeIntervalSearch::pay_until(SearchNode& node, Tick tick) const {
    const auto here = at(node.vertex);
    const std::int32_t n = static_cast<std::int32_t>(here.size());
    for (; node.gap < n && here[index(node.gap)].time.start <= tick + rules_.headway; ++node.gap) {
        node.cost += price(here[index(node.gap)].robot);
        if (node.cost >= never) {
            return false;
        }
    }
    return true;
}

// Serves the next stage; the next two; and so on. Each time the robot can turn and leave, which no
// stage served in the same visit afterwards needs.
void SafeIntervalSearch::serve_in_time(std::int32_t node) {
    SearchNode after = states_[node];
    after.parent = node;
    after.drive = 0;
    Tick now = after.ready;
    while (after.stage + 1 < n_stages() &&
           trip_->stage_vertex[index(after.stage)] == after.vertex) {
        const auto stage = index(after.stage);
        now = trip_->end_of(stage, now);
        if (now >= never) {
            return;
        }
        after.ready = now + trip_->stage_turn[stage];
        after.cost += costs_ends_ ? trip_->times.cost_of(stage, now) : 0;
        if (!pay_until(after, after.ready)) {
            return;
        }
        ++after.stage;
        SearchNode leaving = after;
        if (has_completed(leaving)) {
            if (now > latest_) {
                return;
            }
            leaving.cost += completion_cost(now);
        }
        reach(leaving, rest(leaving));
    }
}

}  // namespace rightofway
