#include "cyclic/conflict_sweep.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/prefetch.hpp"

namespace rightofway {

ConflictSweep::ConflictSweep(const CyclicRoutes& routes, const RollingTimetable& timetable)
    : routes_(routes), timetable_(timetable), at_(routes.n_vertices()), sweeps_(routes.n_robots()) {
    restart();
}

void ConflictSweep::restart() {
    for (Place& place : at_) {
        place.booked.clear();
    }
    ahead_.clear();
    conflicts_.clear();
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        sweeps_[r].number = timetable_.start(r);
        look_ahead(r);
        push_ahead(r);
    }
}

void ConflictSweep::show(RobotId robot, std::int32_t old_end) {
    const std::int32_t swept = sweeps_[robot].number;
    if (timetable_.end(robot) < swept) {
        take_out(robot, timetable_.end(robot));
    } else if (swept == old_end || swept == timetable_.end(robot)) {
        look_ahead(robot);
        push_ahead(robot);
    }
}

// A visit that is entered at another time was left at another one before.
void ConflictSweep::change(std::span<const RollingTimetable::Changed> changed) {
    for (const auto& [robot, from] : changed) {
        if (from <= sweeps_[robot].number) {
            take_out(robot, from - 1);
        }
    }
}

void ConflictSweep::take_out(RobotId robot, std::int32_t from) {
    std::int32_t& swept = sweeps_[robot].number;
    for (; swept > from; --swept) {
        const CyclicVisit visit{robot, swept - 1};
        auto& booked = at_[routes_.vertex(visit)].booked;
        const auto is_it = [visit](const Booked& one) { return one.visit == visit; };
        booked.erase(std::find_if(booked.rbegin(), booked.rend(), is_it).base() - 1);
    }
    look_ahead(robot);
    push_ahead(robot);
}

void ConflictSweep::look_ahead(RobotId robot) {
    Sweep& sweep = sweeps_[robot];
    const CyclicVisit visit{robot, sweep.number};
    sweep.place = routes_.place_in_lap(visit);
    sweep.start = visit.number < timetable_.end(robot)
                      ? timetable_.enter(visit) - routes_.approach(visit)
                      : never;
}

void ConflictSweep::push_ahead(RobotId robot) {
    const Sweep& sweep = sweeps_[robot];
    if (sweep.start < never) {
        ahead_.push_back({sweep.start, {robot, sweep.number}});
        std::push_heap(ahead_.begin(), ahead_.end(), std::greater<>());
    }
}

// The robot that was swept goes on, most often by little: one way down the heap will do.
void ConflictSweep::replace_first_ahead(RobotId robot) {
    const Ahead own{sweeps_[robot].start, {robot, sweeps_[robot].number}};
    const std::size_t size = ahead_.size();
    std::size_t at = 0;
    for (std::size_t child = 1; child < size; child = 2 * at + 1) {
        child += child + 1 < size && ahead_[child + 1] < ahead_[child];
        if (own <= ahead_[child]) {
            break;
        }
        ahead_[at] = ahead_[child];
        at = child;
    }
    ahead_[at] = own;
}

Booking ConflictSweep::booking(CyclicVisit visit) const {
    return {timetable_.enter(visit) - routes_.approach(visit),
            timetable_.enter(visit.next()) + routes_.headway()};
}

bool ConflictSweep::is_shown(CyclicVisit visit) const {
    return timetable_.start(visit.robot) <= visit.number &&
           visit.number < timetable_.end(visit.robot);
}

bool ConflictSweep::holds(const Conflict& conflict) const {
    const CyclicVisit a{conflict.robot_a, conflict.visit_a};
    const CyclicVisit b{conflict.robot_b, conflict.visit_b};
    if (!is_shown(a) || !is_shown(b)) {
        return false;
    }
    if (conflict.kind == ConflictKind::swap) {
        return timetable_.enter(a) == conflict.tick && timetable_.enter(b) == conflict.tick;
    }
    const Booking one = booking(a);
    const Booking other = booking(b);
    return overlap(one, other) > 0 && std::max(one.start, other.start) == conflict.tick;
}

std::optional<Conflict> ConflictSweep::next(Tick limit) {
    while (true) {
        while (!conflicts_.empty() && !holds(conflicts_.front())) {
            std::pop_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
            conflicts_.pop_back();
        }
        const Tick known = conflicts_.empty() ? never : conflicts_.front().tick;
        const Tick swept_to = ahead_.empty() ? never : ahead_.front().start;
        if (known < swept_to) {
            return known < limit ? std::optional(conflicts_.front()) : std::nullopt;
        }
        if (swept_to >= limit) {
            return std::nullopt;
        }
        const auto& [start, visit] = ahead_.front();
        const Sweep& own = sweeps_[visit.robot];
        if (start < never && start == own.start && visit.number == own.number) {
            sweep(visit.robot);
        } else {
            std::pop_heap(ahead_.begin(), ahead_.end(), std::greater<>());
            ahead_.pop_back();
        }
    }
}

// Sweeps the visit that is first of all ahead.
void ConflictSweep::sweep(RobotId robot) {
    ++n_swept_;
    Sweep& sweep = sweeps_[robot];
    const Tick leave = timetable_.enter({robot, sweep.number + 1});
    const Booked own{{robot, sweep.number}, {sweep.start, leave + routes_.headway()}};
    Place& place = at_[routes_.vertex_at(robot, sweep.place)];
    auto& booked = place.booked;
    place.longest = std::max(place.longest, own.booking.end - own.booking.start);
    if (booked.size() == booked.capacity()) {
        forget_past(booked);
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
    ++sweep.number;
    sweep.place = sweep.place + 1 == routes_.length(robot) ? 0 : sweep.place + 1;
    sweep.start = sweep.number < timetable_.end(robot)
                      ? leave - routes_.approach_at(robot, sweep.place)
                      : never;
    replace_first_ahead(robot);
    prepare(robot);
}

// Each visit is at another place in memory. Others are swept before this robot's next one, time
// enough to fetch what that needs; and the list of the one after it, to see where its entries are.
void ConflictSweep::prepare(RobotId robot) const {
    const std::int32_t place = sweeps_[robot].place;
    const std::int32_t next = place + 1 == routes_.length(robot) ? 0 : place + 1;
    const auto& booked = at_[routes_.vertex_at(robot, place)].booked;
    if (!booked.empty()) {
        prefetch(&booked.back());
    }
    prefetch(&at_[routes_.vertex_at(robot, next)]);
    timetable_.prepare({robot, sweeps_[robot].number + 1});
}

// Before a list grows: most often the first ones in it are long over.
void ConflictSweep::forget_past(std::vector<Booked>& booked) const {
    const Tick begins = timetable_.begins();
    const auto is_now = [begins](const Booked& one) { return one.booking.end > begins; };
    booked.erase(booked.begin(), std::find_if(booked.begin(), booked.end(), is_now));
}

// A swap shows at the vertex that the other one leaves as this one enters.
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
        own.visit.number > timetable_.start(own.visit.robot) && is_shown(there) &&
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
