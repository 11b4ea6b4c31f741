#include "search/sipp.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr std::int64_t states_between_questions = 256;
constexpr std::size_t first_slots = 256;
constexpr std::int64_t states_per_drive = 8;  // limit for aiming
constexpr std::span<const BookedBy> no_bookings;

std::uint64_t scatter(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15U;
    return key ^ (key >> 32);
}

}  // namespace

SafeIntervalSearch::SafeIntervalSearch(const Roads& roads, const BookingRules& rules)
    : roads_(roads), rules_(rules), slots_(first_slots, unused) {}

void SafeIntervalSearch::begin(const SearchRequest& request) {
    trip_ = &request.trip;
    bookings_ = &request.bookings;
    books_edges_ = bookings_->n_rows() > roads_.graph.n_vertices();
    prices_ = request.prices;
    limit_ = request.limit;
    nodes_.clear();
    open_.clear();
    goal_ = none;
    mask_ = first_slots - 1;
    greed_ = request.greed;
    // Overlaps that no price buys make an earlier, dearer node worth keeping.
    has_one_label_ = (prices_.empty() && trip_->surcharges.empty()) ||
                     (greed_ > 0 && !bookings_->has_closures());
    next_generation();
    measure_stages(request.trip);
    least_drive_ = never;
    for (const std::int32_t ticks : trip_->pace) {
        least_drive_ = ticks == barred ? least_drive_ : std::min<Tick>(least_drive_, ticks);
    }
    least_drive_ = least_drive_ == never ? 1 : least_drive_;
    least_f_ = least_end();
    is_aiming_ = false;
}

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
    return std::min(least, paid + trip_->stage_work.back());
}

// The least completion time after all these bookings of the last vertex.
Tick SafeIntervalSearch::free_end(std::span<const BookedBy> before) const {
    if (before.empty()) {
        return trip_->stage_work.back();
    }
    const Tick approach = rules_.books_ahead ? least_drive_ : 0;
    return before.back().time.end + approach + trip_->stage_work.back();
}

// The least ticks from a vertex to completion, -1 if no path exists.
Tick SafeIntervalSearch::rest(VertexId vertex, std::int32_t stage) const {
    if (stage == n_stages()) {
        return 0;
    }
    const Tick way = trip_->to_stage[index(stage)].from(vertex);
    return way < 0 ? way : way + to_go_[index(stage)];
}

Tick SafeIntervalSearch::rest(const Node& node) const {
    if (node.stage == n_stages() || !trip_->with_turns) {
        return rest(node.vertex, node.stage);
    }
    return trip_->with_turns->from(node.edge, node.stage);
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

// Whether bookings of the last vertex raise the bound above the completion time alone, and the
// bound is to wait for all of them.
bool SafeIntervalSearch::is_worth_aiming() const {
    const auto last = at(trip_->stage_vertex.back());
    return least_f_ > rest(trip_->home, 0) && least_f_ == free_end(last);
}

SearchEnd SafeIntervalSearch::aim(const StopCondition& is_over) {
    is_aiming_ = true;
    has_one_label_ = true;
    prices_ = {};
    limit_ = least_f_;
    return search(states_per_drive * (least_f_ / least_drive_ + 1), is_over);
}

SearchEnd SafeIntervalSearch::search(std::int64_t most_states, const StopCondition& is_over) {
    const auto here = at(trip_->home);
    Node first{0,    0, trip_->home, BookingTable::started(here, rules_.headway), 0, none,
               none, 0, false};
    first.cost = price_of_entry(first, 0);
    if (first.cost >= never) {
        return SearchEnd::proven_none;  // another robot books the home at tick 0
    }
    first_f_ = rest(first);
    reach(first, first_f_);
    while (!open_.empty()) {
        const OpenList::Entry top = open_.pop();
        const Node& node = nodes_[index(top.node)];
        if (node.is_beaten) {
            continue;
        }
        if (node.stage == n_stages()) {
            goal_ = top.node;
            return SearchEnd::found;
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

void SafeIntervalSearch::expand(std::int32_t node) {
    finish(node);
    serve(node);
    if (!prices_.empty()) {
        stay_on(node);
    }
    const VertexId vertex = nodes_[index(node)].vertex;
    for (EdgeId edge = roads_.graph.indptr[index(vertex)];
         edge < roads_.graph.indptr[index(vertex + 1)]; ++edge) {
        drive(node, edge);
    }
}

// Ends the track: the last visit needs a gap without end, or pays for later bookings.
void SafeIntervalSearch::finish(std::int32_t node) {
    Node after = nodes_[index(node)];
    if (after.stage < first_last_ || after.vertex != trip_->stage_vertex.back()) {
        return;
    }
    const auto here = at(after.vertex);
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

// Serves the next stage if the vertex is right and the gap is long enough.
void SafeIntervalSearch::serve(std::int32_t node) {
    Node after = nodes_[index(node)];
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

// Stays past the start of the next booking and pays its price.
void SafeIntervalSearch::stay_on(std::int32_t node) {
    Node after = nodes_[index(node)];
    const auto here = at(after.vertex);
    if (index(after.gap) == here.size()) {
        return;
    }
    const BookedBy& next = here[index(after.gap)];
    after.cost += price(next.robot);
    if (after.cost >= never) {
        return;
    }
    after.ready = std::max(after.ready, next.time.start - rules_.headway);
    ++after.gap;
    after.parent = node;
    after.drive = 0;
    reach(after, rest(after));
}

// Drives along an edge into each gap of its head that the robot can enter before this gap ends.
void SafeIntervalSearch::drive(std::int32_t node, EdgeId edge) {
    const Node& here = nodes_[index(node)];
    const auto from = at(here.vertex);
    const std::int32_t length_class = roads_.length_class[index(edge)];
    const std::int32_t ticks = trip_->pace[index(length_class)];
    if (ticks == barred) {
        return;
    }
    Node candidate = here;
    candidate.cost += trip_->surcharges.empty() ? 0 : trip_->surcharges[index(length_class)];
    candidate.vertex = roads_.graph.indices[index(edge)];
    candidate.ready += Tick{trip_->turns.between(here.edge, edge)} + ticks;
    candidate.parent = node;
    candidate.drive = ticks;
    candidate.edge = edge;
    const bool never_ends = index(here.gap) == from.size();
    const Tick latest = never_ends ? never : from[index(here.gap)].time.start - rules_.headway;
    const Tick way = rest(candidate);
    if (candidate.ready > latest || way < 0 || candidate.ready + way + candidate.cost > limit_) {
        return;
    }
    const Tick in_time = limit_ == never ? latest : std::min(latest, limit_ - way - candidate.cost);
    const Tick approach = rules_.books_ahead ? ticks : 0;
    const auto along = books_edges_ ? at(roads_.graph.n_vertices() + edge) : no_bookings;
    if (prices_.empty()) {
        drive_between(candidate, way, in_time, approach, along);
    } else {
        drive_across(candidate, way, in_time, approach, along);
    }
}

// Enters each gap between bookings as early as possible.
void SafeIntervalSearch::drive_between(Node candidate, Tick way, Tick latest, Tick approach,
                                       std::span<const BookedBy> along) {
    const auto to = at(candidate.vertex);
    const std::int32_t n = static_cast<std::int32_t>(to.size());
    for (std::int32_t k = BookingTable::started(to, candidate.ready + rules_.headway); k <= n;
         ++k) {
        if (k > 0) {
            candidate.ready = std::max(candidate.ready, to[index(k - 1)].reach + approach);
        }
        candidate.ready = free_drive(along, candidate.ready, candidate.drive);
        if (candidate.ready > latest || candidate.ready >= never) {
            return;
        }
        candidate.gap = k;
        if ((k == n || candidate.ready + rules_.headway < to[index(k)].time.start) &&
            price_of_swaps(candidate) == 0) {
            reach(candidate, way);
        }
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

// Enters as early as possible and at each end of a booking, and pays for the bookings that have not
// ended.
void SafeIntervalSearch::drive_across(const Node& soonest, Tick way, Tick latest, Tick approach,
                                      std::span<const BookedBy> along) {
    const auto to = at(soonest.vertex);
    const auto enter = [&](Tick tick) {
        Node candidate = soonest;
        candidate.ready = tick;
        candidate.gap = BookingTable::started(to, tick + rules_.headway);
        candidate.cost += price_of_entry(candidate, approach);
        if (candidate.cost < never) {
            candidate.cost += price_of_swaps(candidate);
        }
        if (candidate.cost < never) {
            candidate.cost += price_of_drive(along, tick, candidate.drive);
        }
        if (candidate.cost < never) {
            reach(candidate, way);
        }
    };
    enter(soonest.ready);
    const auto first = std::partition_point(to.begin(), to.end(), [&](const BookedBy& one) {
        return one.reach + approach <= soonest.ready;
    });
    for (auto one = first; one != to.end() && one->time.start + approach < latest; ++one) {
        const Tick tick = one->time.end + approach;
        if (one->time.end < never && tick > soonest.ready && tick <= latest) {
            enter(tick);
        }
    }
    for (const BookedBy& one : along) {
        const Tick tick = one.time.end + soonest.drive;
        if (one.time.end < never && tick > soonest.ready && tick <= latest) {
            enter(tick);
        }
    }
}

// The price of the bookings of an edge that overlap a drive.
Tick SafeIntervalSearch::price_of_drive(std::span<const BookedBy> along, Tick tick,
                                        Tick drive) const {
    Tick sum = 0;
    for (std::int32_t k = BookingTable::started(along, tick + rules_.headway - 1);
         k > 0 && along[index(k - 1)].reach > tick - drive && sum < never; --k) {
        if (along[index(k - 1)].time.end > tick - drive) {
            sum += price(along[index(k - 1)].robot);
        }
    }
    return std::min(sum, never);
}

// The price of the bookings that have not ended at the enter.
Tick SafeIntervalSearch::price_of_entry(const Node& candidate, Tick approach) const {
    const auto to = at(candidate.vertex);
    const Tick start = candidate.ready - approach;
    Tick sum = 0;
    for (std::int32_t k = candidate.gap; k > 0 && to[index(k - 1)].reach > start; --k) {
        if (to[index(k - 1)].time.end > start) {
            sum += price(to[index(k - 1)].robot);
        }
        if (sum >= never) {
            return never;
        }
    }
    return sum;
}

// The price of swap conflicts: a robot leaves the head of the edge and enters its tail at this
// instant. With headway or booking ahead, a swap is a vertex conflict already: 0.
Tick SafeIntervalSearch::price_of_swaps(const Node& candidate) const {
    if (rules_.headway > 0 || rules_.books_ahead) {
        return 0;
    }
    const Node& before = nodes_[index(candidate.parent)];
    const auto from = at(before.vertex);
    const auto to = at(candidate.vertex);
    Tick sum = 0;
    for (auto j = index(before.gap); j < from.size() && from[j].time.start == candidate.ready;
         ++j) {
        for (std::int32_t k = candidate.gap; k > 0 && to[index(k - 1)].reach >= candidate.ready;
             --k) {
            if (to[index(k - 1)].time.end == candidate.ready &&
                to[index(k - 1)].robot == from[j].robot && from[j].robot != nobody) {
                sum += price(from[j].robot);
            }
        }
    }
    return std::min(sum, never);
}

Tick SafeIntervalSearch::price(RobotId robot) const {
    return prices_.empty() || robot == nobody ? never : prices_[index(robot)];
}

// Adds a node unless a node of its state is as early and as cheap.
void SafeIntervalSearch::reach(const Node& candidate, Tick way) {
    const Tick f = candidate.ready + way + candidate.cost;
    if (way < 0 || f > limit_) {
        return;
    }
    Slot& slot = slot_of(candidate);
    const Tick sum = candidate.ready + candidate.cost;
    if (!has_one_label_) {
        if (is_known(candidate, slot.node)) {
            return;
        }
    } else if (slot.node != none) {
        if (slot.least <= sum) {
            return;
        }
        nodes_[index(slot.node)].is_beaten = true;
    }
    slot.least = sum;
    const auto node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(candidate);
    nodes_.back().next = slot.node;
    slot.node = node;
    open_.push(is_aiming_ ? OpenList::key(way, candidate.ready)
                          : OpenList::key(f - first_f_ + way * greed_ / 8, way),
               node);
}

// Whether a node of the same state dominates the candidate (ready and cost no greater); marks the
// nodes that the candidate dominates.
bool SafeIntervalSearch::is_known(const Node& candidate, std::int32_t first) {
    for (std::int32_t k = first; k != none; k = nodes_[index(k)].next) {
        Node& known = nodes_[index(k)];
        if (known.ready <= candidate.ready && known.cost <= candidate.cost) {
            return true;
        }
        known.is_beaten |= candidate.ready <= known.ready && candidate.cost <= known.cost;
    }
    return false;
}

SafeIntervalSearch::Slot& SafeIntervalSearch::slot_of(const Node& node) {
    if (2 * nodes_.size() > mask_) {
        enlarge_slots();
    }
    const bool turns = trip_->turns.take_time();
    const std::size_t n_places =
        turns ? roads_.graph.indices.size() + 1 : roads_.graph.indptr.size() - 1;
    const auto place = static_cast<std::uint64_t>(node.stage) * n_places +
                       static_cast<std::uint64_t>(turns ? node.edge + 1 : node.vertex);
    const auto gap = static_cast<std::uint64_t>(node.gap);
    const std::uint64_t state = (place << 24) ^ gap;
    // Neighbouring slots for the gaps of one vertex.
    std::size_t k = (scatter(place) * 4 + gap) & mask_;
    while (slots_[k].generation == generation_ && slots_[k].state != state) {
        k = (k + 1) & mask_;
    }
    if (slots_[k].generation != generation_) {
        slots_[k] = {state, 0, generation_, none};
    }
    return slots_[k];
}

void SafeIntervalSearch::enlarge_slots() {
    mask_ = 4 * mask_ + 3;
    if (slots_.size() <= mask_) {
        slots_.resize(mask_ + 1, unused);
    }
    next_generation();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        Slot& slot = slot_of(nodes_[k]);
        nodes_[k].next = slot.node;
        slot.node = static_cast<std::int32_t>(k);
        slot.least = nodes_[k].ready + nodes_[k].cost;
    }
}

void SafeIntervalSearch::next_generation() {
    if (++generation_ == 0) {
        std::fill(slots_.begin(), slots_.end(), unused);
        generation_ = 1;
    }
}

void SafeIntervalSearch::track(std::vector<Visit>& visits) const {
    visits.clear();
    for (std::int32_t node = goal_; node != none; node = nodes_[index(node)].parent) {
        const Node& one = nodes_[index(node)];
        if (one.parent == none) {
            visits.push_back({one.ready, one.vertex, 0});
        } else if (one.drive > 0) {
            const EdgeId before = nodes_[index(one.parent)].edge;
            visits.push_back(
                {one.ready, one.vertex, one.drive, trip_->turns.between(before, one.edge)});
        }
    }
    std::reverse(visits.begin(), visits.end());
}

}  // namespace rightofway
