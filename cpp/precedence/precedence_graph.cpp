#include "precedence/precedence_graph.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {

PrecedenceGraph::PrecedenceGraph(const RouteArrays& arrays)
    : routes_(arrays),
      timetable_(routes_),
      index_(routes_),
      earliest_(routes_, timetable_, index_) {
    for (VisitId x = 0; x < n_visits(); ++x) {
        conflicts_ += index_.add(x, timetable_);
    }
}

Tick PrecedenceGraph::enter_of(VisitId visit) const {
    require_id("visit", visit, n_visits());
    return timetable_.enter(visit);
}

Tick PrecedenceGraph::completion(RobotId robot) const {
    require_id("robot", robot, n_robots());
    return timetable_.enter(routes_.last_of(robot));
}

Tick PrecedenceGraph::completion_sum() const {
    Tick sum = 0;
    for (RobotId r = 0; r < n_robots(); ++r) {
        sum += routes_.is_active(r) ? timetable_.enter(routes_.last_of(r)) : 0;
    }
    return sum;
}

std::vector<RightOfWay> PrecedenceGraph::rights_of(RobotId robot) const {
    require_id("robot", robot, n_robots());
    std::vector<RightOfWay> rights;
    timetable_.for_each_right_of(robot, [&rights](VisitId a, VisitId b) {
        rights.push_back({a, b});
    });
    return rights;
}

std::vector<RightOfWay> PrecedenceGraph::critical_rights(RobotId robot) const {
    require_id("robot", robot, n_robots());
    return timetable_.critical_rights(routes_.last_of(robot));
}

std::vector<VisitId> PrecedenceGraph::incompatible(RobotId robot, RobotId other) const {
    require_id("i", robot, n_robots());
    require_id("j", other, n_robots());
    std::vector<VisitId> found;
    for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
        const auto all = routes_.incompatible(x);
        auto one = std::lower_bound(
            all.begin(), all.end(), routes_.first_of(other),
            [](const IncompatibleVisit& left, VisitId visit) { return left.visit < visit; });
        for (; one != all.end() && one->visit <= routes_.last_of(other); ++one) {
            found.insert(found.end(), {x, one->visit, one->own_starts(x), one->starts()});
        }
    }
    return found;
}

Tick PrecedenceGraph::conflicts_of(RobotId robot, std::span<const std::uint8_t> others) const {
    require_id("robot", robot, n_robots());
    require_length("others", others.size(), static_cast<std::size_t>(n_robots()));
    Tick total = 0;
    for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
        total += index_.weight(x, others);
    }
    return total;
}

std::optional<Conflict> PrecedenceGraph::next_conflict_between(RobotId robot, RobotId other) const {
    require_id("i", robot, n_robots());
    require_id("j", other, n_robots());
    if (robot == other) {
        reject("j", other, "is the same robot as i");
    }
    return earliest_.between(robot, other);
}

bool PrecedenceGraph::precede(VisitId a, VisitId b) {
    check_pair(a, b);
    if (!timetable_.precede(a, b)) {
        return false;
    }
    count_change();
    return true;
}

bool PrecedenceGraph::keep_order(std::span<const Tick> when, const StopCondition& interrupt) {
    require_length("when", when.size(), static_cast<std::size_t>(n_visits()));
    if (checkpoint() > 0) {
        reject("when", checkpoint(), "changes have been made already (keep an order first)");
    }
    for (VisitId x = 1; x < n_visits(); ++x) {
        if (!routes_.is_first(x) && when[index(x)] <= when[index(x - 1)]) {
            reject_entry("when", index(x), when[index(x)], "is not after the visit before");
        }
    }
    if (!timetable_.keep_order(when, interrupt)) {
        return false;
    }
    for (VisitId x = 0; x < n_visits(); ++x) {
        index_.move(x, timetable_);
    }
    conflicts_ = 0;
    for (VisitId x = 0; x < n_visits(); ++x) {
        conflicts_ += index_.weight(x);
    }
    for (RobotId r = 0; r < n_robots(); ++r) {
        earliest_.forget(r);
    }
    conflicts_ /= 2;  // each conflict is counted for two robots
    n_kept_ = checkpoint();
    conflicts_before_.assign(timetable_.n_changes(), conflicts_);
    return true;
}

bool PrecedenceGraph::take_back(VisitId a, VisitId b) {
    check_pair(a, b);
    if (!timetable_.take_back(a, b)) {
        return false;
    }
    count_change();
    return true;
}

void PrecedenceGraph::check_pair(VisitId a, VisitId b) const {
    require_id("a", a, n_visits());
    require_id("b", b, n_visits());
    for (const VisitId x : {a, b}) {
        if (!routes_.is_active(routes_.robot(x))) {
            reject(x == a ? "a" : "b", x,
                   "is a visit of robot " + std::to_string(routes_.robot(x)) +
                       ", which is not active");
        }
    }
    if (routes_.robot(a) == routes_.robot(b)) {
        reject("b", b, "is a visit of the same robot as a, " + std::to_string(a));
    }
    if (!routes_.has_sizes() && routes_.vertex(a) != routes_.vertex(b)) {
        reject("b", b,
               "is at vertex " + std::to_string(routes_.vertex(b)) + ", but a, " +
                   std::to_string(a) + ", is at vertex " + std::to_string(routes_.vertex(a)));
    }
}

// A changed enter changes the bookings of its visit and of the previous visit, which ends then. (A
// previous visit exists: first visits never change.)
template <class Use>
void PrecedenceGraph::for_each_touched(Use&& use) const {
    for (const VisitId x : timetable_.changed()) {
        use(x - 1);
        use(x);
    }
}

void PrecedenceGraph::count_change() {
    if (conflicts_before_.size() == timetable_.n_changes()) {
        return;  // repeated right of way: no change
    }
    conflicts_before_.push_back(conflicts_);
    for_each_touched([this](VisitId x) {
        conflicts_ -= index_.remove(x);
        earliest_.forget(routes_.robot(x));
    });
    for_each_touched([this](VisitId x) { conflicts_ += index_.add(x, timetable_); });
}

void PrecedenceGraph::rollback(std::int64_t mark) {
    if (mark < n_kept_ || mark > checkpoint()) {
        reject("mark", mark,
               "is not in " + std::to_string(n_kept_) + ".." + std::to_string(checkpoint()) +
                   " (what was taken back cannot be gone back to)");
    }
    if (mark == checkpoint()) {
        return;
    }
    const auto n_changes = static_cast<std::size_t>(mark);
    timetable_.rollback(n_changes);
    conflicts_ = conflicts_before_[n_changes];
    conflicts_before_.resize(n_changes);
    for_each_touched([this](VisitId x) {
        index_.move(x, timetable_);
        earliest_.forget(routes_.robot(x));
    });
}

void PrecedenceGraph::withdraw(RobotId robot) {
    require_id("robot", robot, n_robots());
    for (const auto& [a, b] : rights_of(robot)) {
        take_back(a, b);
    }
    for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
        conflicts_ -= index_.remove(x);
    }
    routes_.deactivate(robot);
    earliest_.forget(robot);
    n_kept_ = checkpoint();
}

}  // namespace rightofway
