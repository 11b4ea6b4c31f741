#include "search/sipp.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr std::int64_t states_between_questions = 256;
constexpr std::span<const BookedBy> no_bookings;

}  // namespace

SafeIntervalSearch::SafeIntervalSearch(const Roads& roads, const BookingRules& rules)
    : roads_(roads), rules_(rules) {}

void SafeIntervalSearch::begin(const SearchRequest& request) {
    trip_ = &request.trip;
    bookings_ = &request.bookings;
    books_edges_ = bookings_->n_rows() > roads_.graph.n_vertices();
    prices_ = request.prices;
    limit_ = request.limit;
    latest_ = request.latest;
    rest_price_ = request.rest_price;
    stays_from_ = request.stays_from;
    ends_from_ = request.ends_from;
    starts_at_ = request.starts_at;
    last_gap_ = request.last_gap;
    goal_ = none;
    greed_ = request.greed;
    has_times_ = trip_->times.are_known();
    completes_before_end_ = has_times_ && trip_->completes_before_end();
    costs_ends_ = greed_ == 0 && trip_->times.cost_ends();
    // Overlaps that no price buys make an earlier, dearer node worth keeping.
    has_one_label_ =
        (prices_.empty() && trip_->surcharges.empty() && !completes_before_end_ && !costs_ends_) ||
        (greed_ > 0 && !bookings_->has_closures());
    measure_stages(request.trip);
    least_drive_ = never;
    for (const std::int32_t ticks : trip_->pace) {
        least_drive_ = ticks == barred ? least_drive_ : std::min<Tick>(least_drive_, ticks);
    }
    least_drive_ = least_drive_ == never ? 1 : least_drive_;
    least_f_ = least_end();
    is_aiming_ = false;
}

SearchEnd SafeIntervalSearch::run(const SearchRequest& request, const StopCondition& is_over) {
    begin(request);
    if (least_f_ >= never || least_f_ > limit_) {
        return SearchEnd::proven_none;
    }
    if (is_worth_aiming()) {
        const SearchEnd end = aim(is_over);
        if (end == SearchEnd::found) {
            return end;
        }
        begin(request);
    }
    return search(never, is_over);
}

// A* from home: lines 1 to 4, and line 13 for the states that `expand` reaches.
SearchEnd SafeIntervalSearch::search(std::int64_t most_states, const StopCondition& is_over) {
    const std::size_t n_places =
        trip_->turns.take_time() ? roads_.graph.indices.size() + 1 : roads_.graph.indptr.size() - 1;
    states_.clear(n_places, trip_->turns.take_time(), has_one_label_);
    open_.clear();
    const auto home = at(trip_->home);
    SearchNode first{};
    first.vertex = trip_->home;
    first.gap = BookingTable::started(home, starts_at_ + rules_.headway);
    first.ready = starts_at_;
    first.parent = none;
    first.cost = price_of_entry(first, 0);
    if (first.cost >= never || !pay_until(first, trip_->times.ready)) {
        return SearchEnd::proven_none;  // another robot books the home before this one is ready
    }
    first.ready = trip_->times.ready;
    first_f_ = has_times_ ? value(first, rest(first)) - first.cost : rest(first);
    reach(first, rest(first));  // 1
    while (!open_.empty()) {
        const OpenList::Entry top = open_.pop();  // 2
        const SearchNode& node = states_[top.node];
        if (node.is_beaten) {
            continue;
        }
        if (node.stage == n_stages()) {
            goal_ = top.node;
            return SearchEnd::found;  // 3
        }
        if (most_states-- == 0) {
            return SearchEnd::stopped;
        }
        if (++n_expanded_ % states_between_questions == 0 && is_over()) {
            return SearchEnd::stopped;
        }
        expand(top.node);
    }
    return SearchEnd::proven_none;
}

// Lines 4 and 5. Besides a drive, a robot can serve a stage, end its track, and pay for a booking.
void SafeIntervalSearch::expand(std::int32_t node) {
    finish(node);
    if (index(states_[node].gap) > at(states_[node].vertex).size()) {
        return;  // it stays
    }
    serve(node);
    if (!prices_.empty()) {
        stay_on(node);
    }
    const VertexId vertex = states_[node].vertex;
    for (EdgeId edge = roads_.graph.indptr[index(vertex)];
         edge < roads_.graph.indptr[index(vertex + 1)]; ++edge) {
        drive(node, edge);
    }
}

// Lines 6 to 8: the drive along an edge that begins at once, and the latest arrival of a drive that
// begins before the robot's gap ends.
void SafeIntervalSearch::drive(std::int32_t node, EdgeId edge) {
    const SearchNode& here = states_[node];
    const auto from = at(here.vertex);
    const std::int32_t length_class = roads_.length_class[index(edge)];
    const std::int32_t ticks = trip_->pace[index(length_class)];
    if (ticks == barred) {
        return;
    }
    SearchNode candidate = here;
    if (!trip_->surcharges.empty()) {
        candidate.cost +=
            (costs_ends_ ? trip_->times.weight : 1) * trip_->surcharges[index(length_class)];
    }
    candidate.vertex = roads_.graph.indices[index(edge)];
    candidate.ready += Tick{trip_->turns.between(here.edge, edge)} + ticks;
    candidate.parent = node;
    candidate.drive = ticks;
    candidate.edge = edge;
    const bool never_ends = index(here.gap) == from.size();
    const Tick latest = never_ends ? never : from[index(here.gap)].time.start - rules_.headway;
    const Tick way = rest(candidate);
    if (candidate.ready > latest || way < 0 || value(candidate, way) > limit_ ||
        (candidate.ready + way > latest_ && !has_completed(candidate))) {
        return;
    }
    Tick in_time = latest;
    if (costs_time(candidate)) {
        in_time = limit_ == never ? latest : std::min(latest, limit_ - way - candidate.cost);
        in_time = std::min(in_time, latest_ - way);
    }
    const Tick approach = rules_.books_ahead ? ticks : 0;
    const auto along = books_edges_ ? at(roads_.graph.n_vertices() + edge) : no_bookings;
    if (prices_.empty()) {
        drive_between(candidate, way, in_time, approach, along);
    } else {
        drive_across(candidate, way, in_time, approach, along);
    }
}

// Lines 9 to 13: enters each gap between bookings as early as possible.
void SafeIntervalSearch::drive_between(SearchNode candidate, Tick way, Tick latest, Tick approach,
                                       std::span<const BookedBy> along) {
    const auto to = at(candidate.vertex);
    const std::int32_t n = static_cast<std::int32_t>(to.size());
    for (std::int32_t k = BookingTable::started(to, candidate.ready + rules_.headway); k <= n;
         ++k) {  // 9
        if (k > 0) {
            candidate.ready = std::max(candidate.ready, to[index(k - 1)].reach + approach);
        }
        candidate.ready = free_drive(along, candidate.ready, candidate.drive);  // 11
        if (candidate.ready > latest || candidate.ready >= never) {
            return;  // 10
        }
        candidate.gap = k;
        if ((k == n || candidate.ready + rules_.headway < to[index(k)].time.start) &&
            price_of_swaps(candidate) == 0) {  // 12
            reach(candidate, way);             // 13
        }
    }
    if (!may_stay_at_once() && is_at_end(candidate)) {
        stay_between(candidate, way, latest, approach, along);
    }
}

// The earliest end of a drive, from `tick` on, that overlaps no booking of its edge.
Tick SafeIntervalSearch::free_drive(std::span<const BookedBy> along, Tick tick, Tick drive) const {
    for (;;) {
        const std::int32_t k = BookingTable::started(along, tick + rules_.headway - 1);
        if (k == 0 || along[index(k - 1)].reach <= tick - drive || tick >= never) {
            return tick;
        }
        tick = along[index(k - 1)].reach + drive;
    }
}

// Line 13: adds a state to OPEN unless it is known to be reached as early and as cheaply.
void SafeIntervalSearch::reach(const SearchNode& candidate, Tick way) {
    const Tick f = value(candidate, way);
    if (way < 0 || f > limit_ || (candidate.ready + way > latest_ && !has_completed(candidate)) ||
        (has_times_ && !is_in_time(candidate))) {
        return;
    }
    const std::int32_t node = states_.add(candidate);
    if (node != none) {
        open_.push(is_aiming_ ? OpenList::key(way, candidate.ready)
                              : OpenList::key(f - first_f_ + way * greed_ / 8, way),
                   node);
    }
}

void SafeIntervalSearch::track(std::vector<Visit>& visits) const {
    visits.clear();
    for (std::int32_t node = goal_; node != none; node = states_[node].parent) {
        const SearchNode& one = states_[node];
        if (one.parent == none) {
            visits.push_back({0, one.vertex, 0});
        } else if (one.drive > 0) {
            const EdgeId before = states_[one.parent].edge;
            visits.push_back(
                {one.ready, one.vertex, one.drive, trip_->turns.between(before, one.edge)});
        }
    }
    std::reverse(visits.begin(), visits.end());
}

}  // namespace rightofway
