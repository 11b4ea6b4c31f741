#include "precedence/timetable.hpp"

#include <algorithm>
#include <compare>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "precedence/routes.hpp"

namespace rightofway {
namespace {

const StopCondition never_asked;  // empty

}  // namespace

Timetable::Timetable(const Routes& routes)
    : RaiseSearch(none),
      routes_(routes),
      enter_(static_cast<std::size_t>(routes.n_visits()), 0),
      rights_(routes.n_visits()),
      raise_(static_cast<std::size_t>(routes.n_visits()), 0),
      cause_(static_cast<std::size_t>(routes.n_visits()), none),
      is_in_instant_(static_cast<std::size_t>(routes.n_visits()), 0) {
    for (VisitId x = 0; x < routes_.n_visits(); ++x) {
        enter_[index(x)] = routes_.is_first(x) ? 0 : enter_[index(x - 1)] + routes_.least(x - 1);
    }
    Poll poll(never_asked);
    if (!recompute(poll)) {
        throw std::invalid_argument("closed_from: a route is closed at all times");
    }
}

bool Timetable::precede(VisitId a, VisitId b) {
    raised_.clear();
    if (rights_.find(a, b) != none) {
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
    const Tick delta = enter_[index(source)] + routes_.gap_before(b) - enter_[index(b)];
    if (delta > 0) {
        if (!spread(b, delta, source)) {
            explain(source);
            forget_raises();
            return false;
        }
        spread_on(source);
    }
    journal_.push_back({rights_.give(a, b), true, trail_.size()});
    accept();
    if (routes_.closures().is_known()) {
        std::vector<VisitId> open = raised_;
        Poll poll(never_asked);
        const bool is_possible = rise_above_closures(open, poll);
        trail_.insert(trail_.end(), risen_.begin(), risen_.end());
        for (const VisitId x : raised_) {
            is_in_instant_[index(x)] = 1;
        }
        const auto known = static_cast<std::ptrdiff_t>(raised_.size());
        for (const OldEnter& one : risen_) {
            if (is_in_instant_[index(one.visit)] == 0) {
                raised_.push_back(one.visit);
            }
        }
        std::for_each(raised_.begin(), raised_.begin() + known,
                      [this](VisitId x) { is_in_instant_[index(x)] = 0; });
        if (!is_possible) {
            rollback(journal_.size() - 1);
            raised_.clear();
            cycle_.clear();
            return false;
        }
    }
    return true;
}

// Raises visits until no booking overlaps a closure: an overlapping booking can only start after
// the closure, because times only grow. `open`: the visits to begin with. False if some booking
// cannot start later. Notes the raised visits, each once, in `risen_`.
bool Timetable::rise_above_closures(std::vector<VisitId>& open, Poll& poll) {
    risen_.clear();
    bool is_possible = true;
    while (!open.empty() && is_possible) {
        poll();
        const VisitId x = open.back();
        open.pop_back();
        for_each_arc(x,
                     [&](VisitId to, Tick length) { rise(to, enter_[index(x)] + length, open); });
        for (VisitId y = routes_.is_first(x) ? x : x - 1; y <= x && is_possible; ++y) {
            const Tick clear = routes_.is_active(routes_.robot(y)) ? clear_of_closures(y) : 0;
            is_possible = clear <= enter_[index(y)] || (clear < never && !routes_.is_first(y));
            if (is_possible) {
                rise(y, clear, open);
            }
        }
    }
    for (const OldEnter& one : risen_) {
        raise_[index(one.visit)] = 0;
    }
    return is_possible;
}

void Timetable::rise(VisitId visit, Tick tick, std::vector<VisitId>& open) {
    if (tick <= enter_[index(visit)]) {
        return;
    }
    if (raise_[index(visit)] == 0) {
        raise_[index(visit)] = 1;
        risen_.push_back({visit, enter_[index(visit)]});
    }
    enter_[index(visit)] = tick;
    open.push_back(visit);
}

// The least enter, from the present one on, with which a visit's bookings overlap no closure.
Tick Timetable::clear_of_closures(VisitId visit) const {
    const VisitClosures& closed = routes_.closures();
    const Tick approach = routes_.approach(visit);
    const Tick drive = closed.drive(visit);
    const Tick end = routes_.is_last(visit) ? never : enter_[index(visit + 1)] + routes_.headway();
    Tick enter = closed.free_at(visit, enter_[index(visit)] - approach, end);
    enter = enter >= never ? never : enter + approach;
    if (!routes_.is_first(visit) && enter < never) {
        const Tick start = closed.free_along(visit, enter - drive, drive + routes_.headway());
        enter = start >= never ? never : start + drive;
    }
    return enter;
}

// Computes the earliest times from the rights of way alone where there are closures, with which
// times that fall cannot be followed from visit to visit.
bool Timetable::recompute(Poll& poll) {
    if (!routes_.closures().is_known()) {
        return true;
    }
    std::vector<VisitId> all;
    for (VisitId x = routes_.n_visits() - 1; x >= 0; --x) {
        enter_[index(x)] = 0;
        all.push_back(x);
    }
    const bool is_possible = rise_above_closures(all, poll);
    risen_.clear();
    return is_possible;
}

void Timetable::find_changes(const std::vector<Tick>& before) {
    for (VisitId x = 0; x < routes_.n_visits(); ++x) {
        if (enter_[index(x)] != before[index(x)]) {
            trail_.push_back({x, before[index(x)]});
            raised_.push_back(x);
        }
    }
}

bool Timetable::keep_order(std::span<const Tick> when, const StopCondition& interrupt) {
    raised_.clear();
    cycle_.clear();
    const std::vector<Tick> before = enter_;
    const auto restore = [&] {
        enter_ = before;
        rollback(0);
    };
    Poll poll(interrupt);
    bool is_possible = false;
    try {
        is_possible = order_all(when, poll);
    } catch (...) {
        std::fill(raise_.begin(), raise_.end(), 0);
        risen_.clear();
        restore();
        throw;
    }
    if (!is_possible) {
        restore();
        return false;
    }
    find_changes(before);
    return true;
}

bool Timetable::order_all(std::span<const Tick> when, Poll& poll) {
    return (routes_.has_sizes() ? give_incompatible_in_order(when, poll)
                                : give_in_order(when, poll)) &&
           sweep(when, poll) && recompute(poll);
}

bool Timetable::give_in_order(std::span<const Tick> when, Poll& poll) {
    std::vector<VisitId> visits;
    for (VisitId x = 0; x < routes_.n_visits(); ++x) {
        if (routes_.is_active(routes_.robot(x))) {
            visits.push_back(x);
        }
    }
    const auto key = [&](VisitId x) { return std::tuple(routes_.vertex(x), when[index(x)], x); };
    std::sort(visits.begin(), visits.end(), [&](VisitId x, VisitId y) {
        poll();
        return key(x) < key(y);
    });
    for (std::size_t k = 1; k < visits.size(); ++k) {
        poll();
        const VisitId a = visits[k - 1];
        const VisitId b = visits[k];
        if (routes_.vertex(a) != routes_.vertex(b) || routes_.robot(a) == routes_.robot(b)) {
            continue;
        }
        if (routes_.is_last(a) || routes_.is_first(b) || when[index(a + 1)] > when[index(b)] ||
            closes_swap(a, b)) {
            return false;
        }
        journal_.push_back({rights_.give(a, b), true, trail_.size()});
    }
    return true;
}

// The start of each visit gets, from each other robot, the latest visit that leaves before it, if
// no earlier start of the same robot has it already.
bool Timetable::give_incompatible_in_order(std::span<const Tick> when, Poll& poll) {
    const auto leaves = [&](VisitId x) { return routes_.is_last(x) ? never : when[index(x + 1)]; };
    std::vector<VisitId> latest(static_cast<std::size_t>(routes_.n_robots()), none);
    std::vector<RobotId> met;
    std::vector<VisitId> firsts;
    for (RobotId robot = 0; robot < routes_.n_robots(); ++robot) {
        for (VisitId b = routes_.first_of(robot); b <= routes_.last_of(robot); ++b) {
            firsts.clear();
            for (const VisitId x : {b - 1, b}) {  // the edge driven into b, then its vertex
                if (x < routes_.first_of(robot) || !routes_.is_active(robot)) {
                    continue;
                }
                for (const IncompatibleVisit& other : routes_.incompatible(x)) {
                    poll();
                    const VisitId a = other.visit;
                    if (other.own_starts(x) != b || !routes_.is_active(routes_.robot(a)) ||
                        leaves(a) > leaves(x)) {
                        continue;
                    }
                    if (routes_.is_last(a) || routes_.is_first(b) || leaves(a) == leaves(x) ||
                        when[index(a + 1)] >= when[index(b)]) {
                        return false;
                    }
                    firsts.push_back(a);
                }
            }
            std::sort(firsts.rbegin(), firsts.rend());
            for (const VisitId a : firsts) {
                VisitId& known = latest[index(routes_.robot(a))];
                if (known == none) {
                    met.push_back(routes_.robot(a));
                }
                if (a > known) {
                    known = a;
                    journal_.push_back({rights_.give(a, b), true, trail_.size()});
                }
            }
        }
        for (const RobotId other : met) {
            latest[index(other)] = none;
        }
        met.clear();
    }
    return true;
}

// Visits of one number may hold each other (a rotation): the loop repeats until no time changes.
// More rounds than visits prove a cycle of positive length.
bool Timetable::sweep(std::span<const Tick> when, Poll& poll) {
    std::vector<VisitId> in_order(enter_.size());
    std::iota(in_order.begin(), in_order.end(), 0);
    std::sort(in_order.begin(), in_order.end(), [&](VisitId x, VisitId y) {
        poll();
        return std::tuple(when[index(x)], x) < std::tuple(when[index(y)], y);
    });
    for (std::size_t first = 0, end = 0; first < in_order.size(); first = end) {
        while (end < in_order.size() &&
               when[index(in_order[end])] == when[index(in_order[first])]) {
            ++end;
        }
        std::size_t rounds_left = end - first + 1;
        for (bool has_changed = true; has_changed;) {
            if (rounds_left-- == 0) {
                return false;
            }
            has_changed = false;
            for (std::size_t k = first; k < end; ++k) {
                poll();
                const VisitId x = in_order[k];
                const Tick held = routes_.is_first(x) ? 0 : held_to(x);
                has_changed = has_changed || held > enter_[index(x)];
                enter_[index(x)] = std::max(enter_[index(x)], held);
            }
        }
    }
    return true;
}

bool Timetable::take_back(VisitId a, VisitId b) {
    raised_.clear();
    const std::int32_t right = rights_.find(a, b);
    if (right == none) {
        return false;
    }
    const bool was_tight = enter_[index(b)] == enter_[index(a + 1)] + routes_.gap_before(b);
    rights_.take_back(right);
    if (routes_.closures().is_known()) {
        const std::vector<Tick> before = enter_;
        const std::size_t mark = trail_.size();
        Poll poll(never_asked);
        recompute(poll);
        find_changes(before);
        journal_.push_back({right, false, mark});
        return true;
    }
    if (was_tight) {
        lower(b);
    }
    journal_.push_back({right, false, trail_.size()});
    accept();
    return true;
}

// A swap is a cycle of two robots and zero length: b enters the vertex that a leaves, and a's robot
// enters the vertex that b's robot leaves, each no earlier than the other. (With a gap the cycle
// has a positive length: a deadlock.) Longer cycles of zero length are rotations, which are
// allowed.
bool Timetable::closes_swap(VisitId a, VisitId b) const {
    return routes_.swaps_conflict() && rights_.find(b - 1, a + 1) != none;
}

// Lowers b and the visits held by b. Visits of one instant may hold each other (a rotation), so
// they fall together.
void Timetable::lower(VisitId b) {
    queue_lowering(b);
    while (!to_lower_.empty()) {
        gather_instant();
        lower_instant();
        for (const VisitId x : instant_) {
            is_in_instant_[index(x)] = 0;
            if (raise_[index(x)] < 0) {
                raised_.push_back(x);
                for_each_arc(x, [this, x](VisitId next, Tick length) {
                    if (length > 0 && enter_[index(next)] == enter_[index(x)] + length) {
                        queue_lowering(next);  // held by x, at a later instant
                    }
                });
            }
        }
    }
}

// Min-heap by enter; visits of one instant are popped together, so ties do not matter.
void Timetable::queue_lowering(VisitId visit) {
    to_lower_.push_back(visit);
    std::push_heap(to_lower_.begin(), to_lower_.end(),
                   [this](VisitId x, VisitId y) { return enter_[index(x)] > enter_[index(y)]; });
}

// Collects the visits that fall from the earliest instant, and visits held by them at this instant.
void Timetable::gather_instant() {
    const auto add = [this](VisitId x) {
        if (is_in_instant_[index(x)] == 0) {
            is_in_instant_[index(x)] = 1;
            instant_.push_back(x);
        }
    };
    const Tick now = enter_[index(to_lower_.front())];
    instant_.clear();
    while (!to_lower_.empty() && enter_[index(to_lower_.front())] == now) {
        std::pop_heap(to_lower_.begin(), to_lower_.end(),
                      [this](VisitId x, VisitId y) { return enter_[index(x)] > enter_[index(y)]; });
        add(to_lower_.back());
        to_lower_.pop_back();
    }
    for (std::size_t k = 0; k < instant_.size(); ++k) {
        rights_.for_each_second(instant_[k] - 1, [&](VisitId second) {
            if (enter_[index(second)] == now && routes_.gap_before(second) == 0) {
                add(second);
            }
        });
    }
}

// Lowers each visit to its bound from outside the instant, then raises visits held by one another.
void Timetable::lower_instant() {
    for (const VisitId x : instant_) {
        raise_[index(x)] = held_to(x) - enter_[index(x)];
    }
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (const VisitId x : instant_) {
            rights_.for_each_second(x - 1, [&](VisitId second) {
                if (is_in_instant_[index(second)] != 0 &&
                    raise_[index(second)] < raise_[index(x)]) {
                    raise_[index(second)] = raise_[index(x)];
                    has_changed = true;
                }
            });
        }
    }
}

// The bound of a visit from its route and the rights of way over it, outside the falling instant.
Tick Timetable::held_to(VisitId visit) const {
    Tick held = enter_[index(visit - 1)] + raise_[index(visit - 1)] + routes_.least(visit - 1);
    rights_.for_each_first(visit, [&](VisitId first) {
        const VisitId after = first + 1;
        if (is_in_instant_[index(after)] == 0) {
            held = std::max(
                held, enter_[index(after)] + raise_[index(after)] + routes_.gap_before(visit));
        }
    });
    return held;
}

void Timetable::accept() {
    for (const VisitId x : raised_) {
        trail_.push_back({x, enter_[index(x)]});
        enter_[index(x)] += raise_[index(x)];
        raise_[index(x)] = 0;
    }
}

void Timetable::rollback(std::size_t n_changes) {
    raised_.clear();
    if (n_changes >= journal_.size()) {
        return;
    }
    restore_enters(journal_[n_changes].trail_mark);
    while (journal_.size() > n_changes) {
        if (journal_.back().is_given) {
            rights_.forget_latest();
        } else {
            rights_.restore(journal_.back().right);
        }
        journal_.pop_back();
    }
}

std::vector<RightOfWay> Timetable::critical_rights(VisitId visit) const {
    std::vector<RightOfWay> rights;
    std::vector<VisitId> passed;  // at this instant; a rotation is a circle
    for (VisitId x = visit; !routes_.is_first(x);) {
        const VisitId first = held_by(x, passed);
        const VisitId cause = first == none ? x - 1 : first + 1;
        if (first == none && enter_[index(x)] > enter_[index(x - 1)] + routes_.least(x - 1)) {
            break;  // a closure holds it
        }
        if (first != none) {
            rights.push_back({first, x});
        }
        if (enter_[index(cause)] < enter_[index(x)]) {
            passed.clear();
        }
        passed.push_back(cause);
        x = cause;
    }
    return rights;
}

// The visit with the right of way that a visit waited for; `none` without a wait.
VisitId Timetable::held_by(VisitId visit, std::span<const VisitId> passed) const {
    VisitId found = none;
    if (enter_[index(visit)] > enter_[index(visit - 1)] + routes_.least(visit - 1)) {
        rights_.for_each_first(visit, [&](VisitId first) {
            const bool holds =
                enter_[index(visit)] == enter_[index(first + 1)] + routes_.gap_before(visit);
            const bool is_new = std::find(passed.begin(), passed.end(), first + 1) == passed.end();
            if (holds && is_new) {
                found = std::max(found, first);
            }
        });
    }
    return found;
}

void Timetable::restore_enters(std::size_t trail_length) {
    while (trail_.size() > trail_length) {
        const OldEnter old = trail_.back();
        trail_.pop_back();
        enter_[index(old.visit)] = old.enter;
        if (raise_[index(old.visit)] == 0) {  // first time in this rollback
            raise_[index(old.visit)] = 1;
            raised_.push_back(old.visit);
        }
    }
    for (const VisitId x : raised_) {
        raise_[index(x)] = 0;
    }
}

}  // namespace rightofway
