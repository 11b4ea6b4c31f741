// The timetable of an order of visits that is known as a whole, in one sweep in order of time.
#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "precedence/timetable.hpp"

namespace rightofway {

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

void Timetable::find_changes(const std::vector<Tick>& before) {
    for (VisitId x = 0; x < routes_.n_visits(); ++x) {
        if (enter_[index(x)] != before[index(x)]) {
            trail_.push_back({x, before[index(x)]});
            raised_.push_back(x);
        }
    }
}

}  // namespace rightofway
