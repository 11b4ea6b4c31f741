// What trips with several stops, work and a last vertex add to SIPP: stages, and the bound from the
// bookings of the last vertex.
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
                                : trip.stage_turn[k] +
                                      rest(trip.stage_vertex[k], static_cast<std::int32_t>(k) + 1);
    }
}

// A lower bound of completion plus prices from the bookings of the last vertex: the robot enters
// after the end of a booking, or pays for the booking.
Tick SafeIntervalSearch::least_end() const {
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
    const auto last = at(trip_->stage_vertex.back());
    return least_f_ > rest(trip_->home, 0) && least_f_ >= free_end(last);
}

SearchEnd SafeIntervalSearch::aim(const StopCondition& is_over) {
    is_aiming_ = true;
    has_one_label_ = true;
    prices_ = {};
    limit_ = least_f_;
    return search(states_per_drive * (least_f_ / least_drive_ + 1), is_over);
}

// Ends the track: the last visit needs a gap without end, or pays for later bookings.
void SafeIntervalSearch::finish(std::int32_t node) {
    SearchNode after = states_[node];
    const auto here = at(after.vertex);
    if (!is_at_end(after) || (!may_stay_at_once() && index(after.gap) <= here.size())) {
        return;
    }
    for (auto k = index(after.gap); k < here.size(); ++k) {
        after.cost += price(here[k].robot);
        if (after.cost >= never) {
            return;
        }
    }
    after.ready += to_go_[index(after.stage)];
    after.gap = static_cast<std::int32_t>(here.size());
    after.stage = n_stages();
    after.parent = node;
    after.drive = 0;
    reach(after, rest(after));
}

// Whether a visit of this node's vertex can be the last one.
bool SafeIntervalSearch::is_at_end(const SearchNode& node) const {
    return node.stage >= first_last_ && node.stage < n_stages() &&
           node.vertex == trip_->stage_vertex.back();
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
    SearchNode after = states_[node];
    if (after.stage + 1 >= n_stages() || trip_->stage_vertex[index(after.stage)] != after.vertex) {
        return;
    }
    after.ready += trip_->stage_work[index(after.stage)] + trip_->stage_turn[index(after.stage)];
    const auto here = at(after.vertex);
    const std::int32_t n = static_cast<std::int32_t>(here.size());
    for (; after.gap < n && here[index(after.gap)].time.start <= after.ready + rules_.headway;
         ++after.gap) {
        after.cost += price(here[index(after.gap)].robot);
        if (after.cost >= never) {
            return;
        }
    }
    ++after.stage;
    after.parent = node;
    after.drive = 0;
    reach(after, rest(after));
}

}  // namespace rightofway
