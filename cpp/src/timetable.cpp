#include "rightofway/timetable.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rightofway {

Timetable::Timetable(const Routes& routes)
    : routes_(routes),
      enter_(routes.n_visits(), 0),
      latest_right_(routes.n_visits(), none),
      raise_(routes.n_visits(), 0),
      cause_(routes.n_visits(), none) {
    run_freely();
}

void Timetable::run_freely() {
    for (VisitId x = 0; x < routes_.n_visits(); ++x) {
        enter_[x] = routes_.is_first(x) ? 0 : enter_[x - 1] + routes_.least(x - 1);
    }
}

bool Timetable::precede(VisitId a, VisitId b) {
    changed_.clear();
    if (has_right(a, b)) {
        return true;
    }
    if (routes_.is_last(a) || routes_.is_first(b)) {
        cycle_.clear();
        return false;
    }
    const VisitId source = a + 1;
    if (closes_swap(a, b)) {
        cycle_ = {b, source};
        return false;
    }
    const Tick delta = enter_[source] + routes_.gap_before(b) - enter_[b];
    if (delta > 0 && !spread(b, delta, source)) {
        explain(source);
        forget_raises();
        return false;
    }
    accept(a, b);
    return true;
}

bool Timetable::has_right(VisitId a, VisitId b) const {
    for (std::int32_t k = latest_right_[a]; k != none; k = next_right_[k]) {
        if (rights_[k].second == b) {
            return true;
        }
    }
    return false;
}

// A swap is a cycle of two robots and zero length: b enters the vertex that a leaves, and the
// robot of a enters the vertex that b's robot leaves, each no earlier than the other. (With a gap
// such a cycle has a positive length, and is refused as that anyway.) Longer cycles of zero length
// are rotations, which are allowed.
bool Timetable::closes_swap(VisitId a, VisitId b) const {
    return routes_.swaps_conflict() && has_right(b - 1, a + 1);
}

// Raises b and all that follows from it; false as soon as the raise reaches the source. No arc
// leads back in time, so only visits entered no later than the source can lead to it. They come
// first, and all others wait until it is known that there is no cycle: a refusal stays cheap.
bool Timetable::spread(VisitId b, Tick delta, VisitId source) {
    latest_ = enter_[source];
    raise_by(b, delta, none);
    if (!settle(source)) {
        return false;
    }
    latest_ = infinity;
    open_.swap(deferred_);
    std::make_heap(open_.begin(), open_.end(), is_later);
    return settle(source);
}

bool Timetable::settle(VisitId source) {
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), is_later);
        const Raise top = open_.back();
        open_.pop_back();
        if (top.delta < raise_[top.visit]) {
            continue;  // raised further since
        }
        raise_successors(top.visit);
        if (raise_[source] > 0) {
            return false;
        }
    }
    return true;
}

void Timetable::raise_successors(VisitId visit) {
    if (!routes_.is_last(visit)) {
        raise_along(visit, visit + 1, routes_.least(visit));
    }
    if (routes_.is_first(visit)) {
        return;
    }
    for (std::int32_t k = latest_right_[visit - 1]; k != none; k = next_right_[k]) {
        const VisitId second = rights_[k].second;
        raise_along(visit, second, routes_.gap_before(second));
    }
}

void Timetable::raise_along(VisitId from, VisitId to, Tick length) {
    const Tick slack = enter_[to] - enter_[from] - length;
    const Tick delta = raise_[from] - slack;
    if (delta > raise_[to]) {
        raise_by(to, delta, from);
    }
}

void Timetable::raise_by(VisitId visit, Tick delta, VisitId cause) {
    if (raise_[visit] == 0) {
        changed_.push_back(visit);
    }
    raise_[visit] = delta;
    cause_[visit] = cause;
    if (enter_[visit] > latest_) {
        deferred_.push_back({delta, visit});
        return;
    }
    open_.push_back({delta, visit});
    std::push_heap(open_.begin(), open_.end(), is_later);
}

// Largest raise first; equal raises by visit, so that the order is total.
bool Timetable::is_later(const Raise& left, const Raise& right) {
    return left.delta != right.delta ? left.delta < right.delta : left.visit > right.visit;
}

// The causes lead from the source back to b.
void Timetable::explain(VisitId source) {
    cycle_.clear();
    for (VisitId x = source; x != none; x = cause_[x]) {
        cycle_.push_back(x);
    }
    std::reverse(cycle_.begin(), cycle_.end());
}

void Timetable::forget_raises() {
    for (const VisitId x : changed_) {
        raise_[x] = 0;
    }
    changed_.clear();
    open_.clear();
    deferred_.clear();
}

void Timetable::record(VisitId a, VisitId b) {
    trail_mark_.push_back(trail_.size());
    next_right_.push_back(latest_right_[a]);
    latest_right_[a] = static_cast<std::int32_t>(rights_.size());
    rights_.push_back({a, b});
}

void Timetable::accept(VisitId a, VisitId b) {
    record(a, b);
    for (const VisitId x : changed_) {
        trail_.push_back({x, enter_[x]});
        enter_[x] += raise_[x];
        raise_[x] = 0;
    }
}

void Timetable::rollback(std::size_t n_rights) {
    changed_.clear();
    if (n_rights >= rights_.size()) {
        return;
    }
    restore_enters(trail_mark_[n_rights]);
    while (rights_.size() > n_rights) {
        latest_right_[rights_.back().first] = next_right_.back();
        rights_.pop_back();
        next_right_.pop_back();
        trail_mark_.pop_back();
    }
}

void Timetable::withdraw(RobotId robot) {
    std::vector<VisitId> in_old_order(enter_.size());
    std::iota(in_old_order.begin(), in_old_order.end(), 0);
    std::stable_sort(in_old_order.begin(), in_old_order.end(),
                     [this](VisitId left, VisitId right) { return enter_[left] < enter_[right]; });
    const std::vector<RightOfWay> rights = std::move(rights_);
    rights_.clear();
    next_right_.clear();
    trail_.clear();
    trail_mark_.clear();
    std::fill(latest_right_.begin(), latest_right_.end(), none);
    for (const auto& [first, second] : rights) {
        if (routes_.robot(first) != robot && routes_.robot(second) != robot) {
            record(first, second);
        }
    }
    run_freely();
    run_again(in_old_order);
}

// Pushes every visit behind what it waits for. In the old order of time nothing waits for a later
// visit, so one round does, and more only where rotations make visits wait for each other at one
// instant.
void Timetable::run_again(std::span<const VisitId> in_old_order) {
    bool has_changed = true;
    const auto push = [this, &has_changed](VisitId visit, Tick earliest) {
        has_changed = has_changed || enter_[visit] < earliest;
        enter_[visit] = std::max(enter_[visit], earliest);
    };
    while (has_changed) {
        has_changed = false;
        for (const VisitId x : in_old_order) {
            if (!routes_.is_last(x)) {
                push(x + 1, enter_[x] + routes_.least(x));
            }
            if (routes_.is_first(x)) {
                continue;
            }
            for (std::int32_t k = latest_right_[x - 1]; k != none; k = next_right_[k]) {
                push(rights_[k].second, enter_[x] + routes_.gap_before(rights_[k].second));
            }
        }
    }
}

void Timetable::restore_enters(std::size_t trail_length) {
    while (trail_.size() > trail_length) {
        const OldEnter old = trail_.back();
        trail_.pop_back();
        enter_[old.visit] = old.enter;
        if (raise_[old.visit] == 0) {  // the first time we meet it
            raise_[old.visit] = 1;
            changed_.push_back(old.visit);
        }
    }
    for (const VisitId x : changed_) {
        raise_[x] = 0;
    }
}

}  // namespace rightofway
