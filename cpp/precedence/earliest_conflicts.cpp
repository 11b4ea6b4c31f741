#include "precedence/earliest_conflicts.hpp"

#include <algorithm>
#include <functional>

namespace rightofway {

EarliestConflicts::EarliestConflicts(const Routes& routes, const Timetable& timetable,
                                     const ConflictIndex& index)
    : routes_(routes),
      timetable_(timetable),
      index_(index),
      looked_up_(static_cast<std::size_t>(routes.n_robots()), 0),
      changed_(static_cast<std::size_t>(routes.n_robots()), 0) {
    for (RobotId r = 0; r < routes.n_robots(); ++r) {
        forget(r);
    }
}

void EarliestConflicts::forget(RobotId robot) {
    if (changed_[index(robot)] <= looked_up_[index(robot)]) {
        to_look_up_.push_back(robot);
    }
    changed_[index(robot)] = ++now_;
}

std::optional<Conflict> EarliestConflicts::next() {
    for (const RobotId robot : to_look_up_) {
        look_up(robot);
    }
    to_look_up_.clear();
    while (!known_.empty()) {
        const Known top = known_.front();
        if (is_current(top)) {
            return top.conflict;
        }
        std::pop_heap(known_.begin(), known_.end(), std::greater<>());
        known_.pop_back();
        if (top.at == looked_up_[index(top.robot)]) {  // else a newer entry replaces this one
            look_up(top.robot);
        }
    }
    return std::nullopt;
}

bool EarliestConflicts::is_current(const Known& known) const {
    return known.at == looked_up_[index(known.robot)] &&
           changed_[index(known.conflict.robot_a)] <= known.at &&
           changed_[index(known.conflict.robot_b)] <= known.at;
}

void EarliestConflicts::look_up(RobotId robot) {
    looked_up_[index(robot)] = ++now_;
    if (const auto found = search(robot, [this](VisitId x) { return index_.earliest(x); })) {
        known_.push_back({*found, now_, robot});
        std::push_heap(known_.begin(), known_.end(), std::greater<>());
    }
}

std::optional<Conflict> EarliestConflicts::between(RobotId robot, RobotId other) const {
    return search(robot, [this, other](VisitId x) { return index_.earliest(x, other); });
}

// Visits are in order of time; no conflict of a visit is before the start of its booking.
template <class Find>
std::optional<Conflict> EarliestConflicts::search(RobotId robot, Find&& find) const {
    std::optional<Conflict> best;
    const Tick earlier = routes_.longest_approach(robot);
    for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
        if (best && timetable_.enter(x) - earlier > best->tick) {
            break;
        }
        if (const std::optional<Conflict> found = find(x)) {
            best = best ? std::min(*best, *found) : *found;
        }
    }
    return best;
}

}  // namespace rightofway
