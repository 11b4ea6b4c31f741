#include "rightofway/earliest_conflicts.hpp"

#include <algorithm>

namespace rightofway {

EarliestConflicts::EarliestConflicts(const Routes& routes, const Timetable& timetable,
                                     const ConflictIndex& index)
    : routes_(routes),
      timetable_(timetable),
      index_(index),
      known_(routes.n_robots()),
      known_at_(routes.n_robots(), -1),
      changed_at_(routes.n_robots(), 0) {}

std::optional<Conflict> EarliestConflicts::next() {
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        if (known_at_[r] < changed_at_[r]) {
            look_up(r);
        }
    }
    while (true) {
        RobotId earliest = -1;
        for (RobotId r = 0; r < routes_.n_robots(); ++r) {
            if (known_[r] && (earliest < 0 || *known_[r] < *known_[earliest])) {
                earliest = r;
            }
        }
        if (earliest < 0) {
            return std::nullopt;
        }
        if (is_current(earliest)) {
            return known_[earliest];
        }
        look_up(earliest);
    }
}

bool EarliestConflicts::is_current(RobotId robot) const {
    const Conflict& conflict = *known_[robot];
    return changed_at_[conflict.robot_a] <= known_at_[robot] &&
           changed_at_[conflict.robot_b] <= known_at_[robot];
}

void EarliestConflicts::look_up(RobotId robot) {
    known_[robot] = search(robot, [this](VisitId x) { return index_.earliest(x); });
    known_at_[robot] = now_;
}

std::optional<Conflict> EarliestConflicts::between(RobotId robot, RobotId other) const {
    return search(robot, [this, other](VisitId x) { return index_.earliest(x, other); });
}

// Visits are in order of time, and none has a conflict before its booking starts.
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
