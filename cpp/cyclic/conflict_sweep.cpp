#include "cyclic/conflict_sweep.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "cyclic/rolling_timetable.hpp"

namespace rightofway {

ConflictSweep::ConflictSweep(const CyclicRoutes& routes, const RollingTimetable& timetable)
    : routes_(routes),
      timetable_(timetable),
      at_(static_cast<std::size_t>(routes.n_rows())),
      sweeps_(static_cast<std::size_t>(routes.n_robots())) {
    restart();
}

void ConflictSweep::restart() {
    for (Place& place : at_) {
        place.booked.clear();
    }
    upcoming_.clear();
    conflicts_.clear();
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        sweeps_[index(r)].number = timetable_.start(r);
        find_next(r);
    }
}

void ConflictSweep::end_changed(RobotId robot, std::int32_t old_end) {
    const std::int32_t swept = sweeps_[index(robot)].number;
    if (routes_.books_edges()) {
        // The last visit in the window is swept without the edge driven out of it.
        const std::int32_t last = std::min(old_end, timetable_.end(robot)) - 1;
        if (swept > last) {
            unsweep(robot, std::max(last, timetable_.start(robot)));
        }
    } else if (timetable_.end(robot) < swept) {
        unsweep(robot, timetable_.end(robot));
    } else if (swept == old_end || swept == timetable_.end(robot)) {
        find_next(robot);
    }
}

// A changed enter also changes the leave of the previous visit.
void ConflictSweep::times_changed(std::span<const RollingTimetable::Changed> changed) {
    for (const auto& [robot, from] : changed) {
        if (from <= sweeps_[index(robot)].number) {
            unsweep(robot, from - 1);
        }
    }
}

void ConflictSweep::unsweep(RobotId robot, std::int32_t from) {
    std::int32_t& swept = sweeps_[index(robot)].number;
    for (; swept > from; --swept) {
        const CyclicVisit visit{robot, swept - 1};
        take_out(routes_.vertex_row(visit), visit);
        take_out(routes_.edge_row(visit), visit);
    }
    find_next(robot);
}

void ConflictSweep::find_next(RobotId robot) {
    Sweep& sweep = sweeps_[index(robot)];
    const CyclicVisit visit{robot, sweep.number};
    sweep.place = routes_.place_in_lap(visit);
    sweep.start = visit.number < timetable_.end(robot)
                      ? timetable_.enter(visit) - routes_.approach(visit)
                      : never;
    if (sweep.start < never) {
        upcoming_.push_back({sweep.start, {robot, sweep.number}});
        std::push_heap(upcoming_.begin(), upcoming_.end(), std::greater<>());
    }
}

// Replaces the top of the heap by the robot's next visit in one sift-down: the visit usually stays
// near the top.
void ConflictSweep::replace_first_upcoming(RobotId robot) {
    const Upcoming own{sweeps_[index(robot)].start, {robot, sweeps_[index(robot)].number}};
    const std::size_t size = upcoming_.size();
    std::size_t at = 0;
    for (std::size_t child = 1; child < size; child = 2 * at + 1) {
        child += child + 1 < size && upcoming_[child + 1] < upcoming_[child];
        if (own <= upcoming_[child]) {
            break;
        }
        upcoming_[at] = upcoming_[child];
        at = child;
    }
    upcoming_[at] = own;
}

BookingStarts ConflictSweep::starts(CyclicVisit visit) const {
    const auto start = [&](CyclicVisit at) { return timetable_.enter(at) - routes_.approach(at); };
    return {start(visit), leaves(visit) ? start(visit.next()) : never};
}

Tick ConflictSweep::end(CyclicVisit visit) const {
    return timetable_.enter(visit.next()) + routes_.headway();
}

bool ConflictSweep::leaves(CyclicVisit visit) const {
    return visit.number + 1 < timetable_.end(visit.robot);
}

// The overlap of the bookings of two visits of different robots, if any.
std::optional<Conflict> ConflictSweep::conflict(CyclicVisit one, CyclicVisit other) const {
    const auto [a, b] = std::minmax(one, other);
    const auto found = routes_.incompatible(a, leaves(a), b, leaves(b));
    if (!found) {
        return std::nullopt;
    }
    const Tick tick = found->bookings.begin(starts(a), starts(b));
    if (tick >= std::min(end(a), end(b))) {
        return std::nullopt;
    }
    return Conflict{tick, a.robot, b.robot, a.number, b.number, ConflictKind::vertex};
}

bool ConflictSweep::holds(const Conflict& conflict) const {
    const CyclicVisit a{conflict.robot_a, conflict.visit_a};
    const CyclicVisit b{conflict.robot_b, conflict.visit_b};
    if (!timetable_.is_in_window(a) || !timetable_.is_in_window(b)) {
        return false;
    }
    if (conflict.kind == ConflictKind::swap) {
        return timetable_.enter(a) == conflict.tick && timetable_.enter(b) == conflict.tick;
    }
    return this->conflict(a, b) == conflict;
}

std::optional<Conflict> ConflictSweep::next(Tick limit) {
    while (true) {
        while (!conflicts_.empty() && !holds(conflicts_.front())) {
            std::pop_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
            conflicts_.pop_back();
        }
        const Tick known = conflicts_.empty() ? never : conflicts_.front().tick;
        const Tick swept_to = upcoming_.empty() ? never : upcoming_.front().start;
        if (known < swept_to) {
            return known < limit ? std::optional(conflicts_.front()) : std::nullopt;
        }
        if (swept_to >= limit) {
            return std::nullopt;
        }
        const auto& [start, visit] = upcoming_.front();
        const Sweep& own = sweeps_[index(visit.robot)];
        if (start < never && start == own.start && visit.number == own.number) {
            routes_.books_edges() ? sweep_with_sizes(visit.robot) : sweep(visit.robot);
        } else {
            std::pop_heap(upcoming_.begin(), upcoming_.end(), std::greater<>());
            upcoming_.pop_back();
        }
    }
}

// Sweeps the visit at the top of the heap.
void ConflictSweep::sweep(RobotId robot) {
    Sweep& sweep = sweeps_[index(robot)];
    const Tick leave = timetable_.enter({robot, sweep.number + 1});
    const Booked own{{robot, sweep.number}, {sweep.start, leave + routes_.headway()}};
    Place& place = at_[index(routes_.vertex_at(robot, sweep.place))];
    auto& booked = place.booked;
    place.longest = std::max(place.longest, own.booking.end - own.booking.start);
    if (booked.size() == booked.capacity()) {
        drop_past(booked);
    }
    std::size_t after = booked.size();
    for (std::size_t k = after; k-- > 0;) {
        const Booking& booking = booked[k].booking;
        if (booking.start + place.longest < own.booking.start) {
            break;
        }
        if (booking.start < own.booking.end && booking.end >= own.booking.start) {
            compare(own, booked[k]);
        }
        after = booking.start > own.booking.start ? k : after;
    }
    booked.insert(booked.begin() + static_cast<std::ptrdiff_t>(after), own);
    advance(robot, leave);
    prefetch_next(robot);
}

void ConflictSweep::take_out(std::int32_t list, CyclicVisit visit) {
    if (list == none) {
        return;
    }
    auto& booked = at_[index(list)].booked;
    const auto is_it = [visit](const Booked& one) { return one.visit == visit; };
    const auto found = std::find_if(booked.rbegin(), booked.rend(), is_it);
    if (found != booked.rend()) {  // no edge led out of the last visit in the window
        booked.erase(found.base() - 1);
    }
}

void ConflictSweep::put_in(std::int32_t list, const Booked& own) {
    Place& place = at_[index(list)];
    place.longest = std::max(place.longest, own.booking.end - own.booking.start);
    if (place.booked.size() == place.booked.capacity()) {
        drop_past(place.booked);
    }
    const auto starts_later = [](const Booking& booking, const Booked& one) {
        return booking.start < one.booking.start;
    };
    place.booked.insert(
        std::upper_bound(place.booked.begin(), place.booked.end(), own.booking, starts_later), own);
}

// Sweeps the visit at the top of the heap, from its start on as a whole: a conflict begins at or
// after the later start of its two visits.
void ConflictSweep::sweep_with_sizes(RobotId robot) {
    const Sweep& sweep = sweeps_[index(robot)];
    const CyclicVisit visit{robot, sweep.number};
    const Tick leave = timetable_.enter(visit.next());
    const Booked own{visit, {sweep.start, leave + routes_.headway()}};
    const auto meet = [&](const std::int32_t& row) {
        for (const std::int32_t list : routes_.excluded(row)) {
            const Place& place = at_[index(list)];
            for (std::size_t k = place.booked.size(); k-- > 0;) {
                const Booked& other = place.booked[k];
                if (other.booking.start + place.longest < own.booking.start) {
                    break;
                }
                const bool is_near =
                    other.booking.start < own.booking.end && other.booking.end > own.booking.start;
                if (!is_near || other.visit.robot == robot) {
                    continue;
                }
                if (const auto found = conflict(visit, other.visit)) {
                    conflicts_.push_back(*found);
                    std::push_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
                }
            }
        }
    };
    const std::int32_t at_vertex = routes_.vertex_row(visit);
    meet(at_vertex);
    put_in(at_vertex, own);
    if (leaves(visit)) {
        const std::int32_t along_edge = routes_.edge_row(visit);
        meet(along_edge);
        put_in(along_edge, own);
    }
    advance(robot, leave);
}

// Goes on to the robot's next visit.
void ConflictSweep::advance(RobotId robot, Tick leave) {
    Sweep& sweep = sweeps_[index(robot)];
    ++sweep.number;
    sweep.place = sweep.place + 1 == routes_.length(robot) ? 0 : sweep.place + 1;
    sweep.start = sweep.number < timetable_.end(robot)
                      ? leave - routes_.approach_at(robot, sweep.place)
                      : never;
    replace_first_upcoming(robot);
}

// Visits are scattered in memory. Other robots are swept before the robot's next visit; meanwhile,
// the list and the leave of the next visit are loaded, and the head of the following list.
void ConflictSweep::prefetch_next(RobotId robot) const {
    const std::int32_t place = sweeps_[index(robot)].place;
    const std::int32_t next = place + 1 == routes_.length(robot) ? 0 : place + 1;
    const auto& booked = at_[index(routes_.vertex_at(robot, place))].booked;
    if (!booked.empty()) {
        prefetch(&booked.back());
    }
    prefetch(&at_[index(routes_.vertex_at(robot, next))]);
    timetable_.prefetch_enter({robot, sweeps_[index(robot)].number + 1});
}

// Removes bookings that ended before the window, mostly the first ones, before a list grows.
void ConflictSweep::drop_past(std::vector<Booked>& booked) const {
    const Tick begins = timetable_.begins();
    const auto is_now = [begins](const Booked& one) { return one.booking.end > begins; };
    booked.erase(booked.begin(), std::find_if(booked.begin(), booked.end(), is_now));
}

// Finds a swap at the vertex that the other robot leaves as the own robot enters.
void ConflictSweep::compare(const Booked& own, const Booked& other) {
    if (own.visit.robot == other.visit.robot) {
        return;
    }
    if (overlap(own.booking, other.booking) > 0) {
        const Tick tick = std::max(own.booking.start, other.booking.start);
        add(own.visit, other.visit, tick, ConflictKind::vertex);
        return;
    }
    const CyclicVisit there = other.visit.next();
    if (own.booking.start == other.booking.end && routes_.gap_before(own.visit) == 0 &&
        own.visit.number > timetable_.start(own.visit.robot) && timetable_.is_in_window(there) &&
        routes_.gap_before(there) == 0 &&
        routes_.vertex(there) == routes_.vertex(own.visit.before())) {
        add(own.visit, there, own.booking.start, ConflictKind::swap);
    }
}

void ConflictSweep::add(CyclicVisit one, CyclicVisit other, Tick tick, ConflictKind kind) {
    const auto [a, b] = std::minmax(one, other);
    conflicts_.push_back({tick, a.robot, b.robot, a.number, b.number, kind});
    std::push_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
}

}  // namespace rightofway
