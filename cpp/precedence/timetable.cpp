#include "precedence/timetable.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace rightofway {

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
    if (!recompute()) {
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
    if (routes_.closures().is_known() && !clear_closures()) {
        rollback(journal_.size() - 1);
        raised_.clear();
        cycle_.clear();
        return false;
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
        recompute();
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
