#include "rightofway/endless_meetings.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace rightofway {

EndlessMeetings::EndlessMeetings(const EndlessRoutes& routes, const EndlessTimetable& timetable)
    : routes_(routes),
      timetable_(timetable),
      at_(routes.n_vertices()),
      swept_(routes.n_robots(), 0) {
    restart();
}

void EndlessMeetings::restart() {
    for (auto& list : at_) {
        list.clear();
    }
    ahead_.clear();
    conflicts_.clear();
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        swept_[r] = timetable_.start(r);
        look_ahead(r);
    }
}

void EndlessMeetings::show(RobotId robot, std::int32_t old_end) {
    if (timetable_.end(robot) < swept_[robot]) {
        take_out(robot, timetable_.end(robot));
    } else if (swept_[robot] == old_end) {
        look_ahead(robot);
    }
}

// A visit that is entered at another time was left at another one before.
void EndlessMeetings::change(std::span<const EndlessTimetable::Changed> changed) {
    for (const auto& [robot, from] : changed) {
        if (from <= swept_[robot]) {
            take_out(robot, from - 1);
        }
    }
}

void EndlessMeetings::take_out(RobotId robot, std::int32_t from) {
    for (; swept_[robot] > from; --swept_[robot]) {
        const EndlessVisit visit{robot, swept_[robot] - 1};
        auto& list = at_[routes_.vertex(visit)];
        const auto is_it = [visit](const Booked& one) { return one.visit == visit; };
        *std::find_if(list.begin(), list.end(), is_it) = list.back();
        list.pop_back();
    }
    look_ahead(robot);
}

void EndlessMeetings::look_ahead(RobotId robot) {
    const EndlessVisit visit{robot, swept_[robot]};
    if (visit.number < timetable_.end(robot)) {
        ahead_.push_back({booking(visit).start, visit});
        std::push_heap(ahead_.begin(), ahead_.end(), std::greater<>());
    }
}

Booking EndlessMeetings::booking(EndlessVisit visit) const {
    return {timetable_.enter(visit) - routes_.approach(visit),
            timetable_.enter(visit.next()) + routes_.headway()};
}

bool EndlessMeetings::is_shown(EndlessVisit visit) const {
    return timetable_.start(visit.robot) <= visit.number &&
           visit.number < timetable_.end(visit.robot);
}

bool EndlessMeetings::holds(const Conflict& conflict) const {
    const EndlessVisit a{conflict.robot_a, conflict.visit_a};
    const EndlessVisit b{conflict.robot_b, conflict.visit_b};
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

std::optional<Conflict> EndlessMeetings::next(Tick limit) {
    while (true) {
        while (!conflicts_.empty() && !holds(conflicts_.front())) {
            std::pop_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
            conflicts_.pop_back();
        }
        const Tick known = conflicts_.empty() ? infinity : conflicts_.front().tick;
        const Tick swept_to = ahead_.empty() ? infinity : ahead_.front().start;
        if (known < swept_to) {
            return known < limit ? std::optional(conflicts_.front()) : std::nullopt;
        }
        if (swept_to >= limit) {
            return std::nullopt;
        }
        const Ahead top = ahead_.front();
        std::pop_heap(ahead_.begin(), ahead_.end(), std::greater<>());
        ahead_.pop_back();
        const EndlessVisit visit = top.visit;
        const bool is_next = visit.number == swept_[visit.robot] &&
                             visit.number < timetable_.end(visit.robot) &&
                             top.start == booking(visit).start;
        if (is_next) {
            sweep(visit);
        }
    }
}

void EndlessMeetings::sweep(EndlessVisit visit) {
    ++n_swept_;
    const Booked own{visit, booking(visit)};
    auto& list = at_[routes_.vertex(visit)];
    for (std::size_t k = 0; k < list.size();) {
        if (list[k].visit.number < timetable_.start(list[k].visit.robot)) {
            list[k] = list.back();
            list.pop_back();
            continue;
        }
        compare(own, list[k]);
        ++k;
    }
    list.push_back(own);
    ++swept_[visit.robot];
    look_ahead(visit.robot);
}

// A swap shows at the vertex that the other one leaves as this one enters.
void EndlessMeetings::compare(const Booked& own, const Booked& other) {
    if (own.visit.robot == other.visit.robot) {
        return;
    }
    if (overlap(own.booking, other.booking) > 0) {
        const Tick tick = std::max(own.booking.start, other.booking.start);
        add(own.visit, other.visit, tick, ConflictKind::vertex);
        return;
    }
    const EndlessVisit there = other.visit.next();
    if (own.booking.start == other.booking.end && routes_.gap_before(own.visit) == 0 &&
        own.visit.number > timetable_.start(own.visit.robot) && is_shown(there) &&
        routes_.gap_before(there) == 0 &&
        routes_.vertex(there) == routes_.vertex(own.visit.before())) {
        add(own.visit, there, own.booking.start, ConflictKind::swap);
    }
}

void EndlessMeetings::add(EndlessVisit one, EndlessVisit other, Tick tick, ConflictKind kind) {
    const auto [a, b] = std::minmax(one, other);
    conflicts_.push_back({tick, a.robot, b.robot, a.number, b.number, kind});
    std::push_heap(conflicts_.begin(), conflicts_.end(), std::greater<>());
}

}  // namespace rightofway
