// What closures add to the timetable: bookings that overlap one start after it. Times still are the
// least that keep all arcs, but a visit that falls does not lead to the visits that fall with it.
#include "precedence/timetable.hpp"

namespace rightofway {
namespace {

const StopCondition never_asked;  // empty

}  // namespace

// Raises visits above closures after a change that raised others. Notes them in `raised_` and in
// the trail.
bool Timetable::clear_closures() {
    std::vector<VisitId> open = raised_;
    Poll poll(never_asked);
    const bool is_possible = rise_above_closures(open, poll);
    trail_.insert(trail_.end(), risen_.begin(), risen_.end());
    for (const VisitId x : raised_) {
        is_in_instant_[index(x)] = 1;
    }
    const std::size_t n_known = raised_.size();
    for (const OldEnter& one : risen_) {
        if (is_in_instant_[index(one.visit)] == 0) {
            raised_.push_back(one.visit);
        }
    }
    for (std::size_t k = 0; k < n_known; ++k) {
        is_in_instant_[index(raised_[k])] = 0;
    }
    return is_possible;
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

bool Timetable::recompute() {
    Poll poll(never_asked);
    return recompute(poll);
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

}  // namespace rightofway
