// The precedence graph of a fleet: routes, rights of way, their timetable, remaining conflicts.
//
// A planner reads the next conflict, gives one of its visits the right of way over the other visit,
// compares times and conflicts, and rolls back if another choice is better. Times and conflicts are
// updated incrementally; a rollback costs as much as the change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/conflict_index.hpp"
#include "precedence/earliest_conflicts.hpp"
#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

class PrecedenceGraph {
  public:
    // All methods throw std::invalid_argument on an unknown robot or visit.
    explicit PrecedenceGraph(const RouteArrays& arrays);

    // No copies: members refer to each other.
    PrecedenceGraph(const PrecedenceGraph&) = delete;
    PrecedenceGraph& operator=(const PrecedenceGraph&) = delete;

    RobotId n_robots() const { return routes_.n_robots(); }
    VisitId n_visits() const { return routes_.n_visits(); }
    std::span<const Tick> enters() const { return timetable_.enters(); }
    std::vector<RightOfWay> rights_of_way() const { return timetable_.rights_of_way(); }
    Tick enter_of(VisitId visit) const;
    Tick completion(RobotId robot) const;
    Tick completion_sum() const;  // of the active robots

    // The rights of way of a robot over others, and of others over the robot.
    std::vector<RightOfWay> rights_of(RobotId robot) const;

    // The rights of way on a longest path to a robot's last visit, latest first.
    std::vector<RightOfWay> critical_rights(RobotId robot) const;

    // All incompatible visits of two robots, flat: visit of the robot, visit of the other robot,
    // and the visits whose starts count (see IncompatibleVisit). Empty where no robot has a size.
    std::vector<VisitId> incompatible(RobotId robot, RobotId other) const;

    // The weight of all conflicts, or of one robot's with robots whose mask is nonzero.
    Tick conflicts() const { return conflicts_; }
    Tick conflicts_of(RobotId robot, std::span<const std::uint8_t> others) const;

    std::optional<Conflict> next_conflict() { return earliest_.next(); }
    std::optional<Conflict> next_conflict_between(RobotId robot, RobotId other) const;

    // See Timetable. Throws std::invalid_argument unless a and b are visits of two active robots
    // to the same vertex. Where robots have sizes, the visits may be at different vertices.
    bool precede(VisitId a, VisitId b);
    // See Timetable: orders the visits of every vertex at once. A rollback below this change is
    // refused. Throws std::invalid_argument unless there is one number per visit, rising along
    // each route, and the graph has no rights of way yet.
    bool keep_order(std::span<const Tick> when, const StopCondition& interrupt = {});
    std::span<const VisitId> cycle() const { return timetable_.cycle(); }

    // Takes back one right of way, given at any time; times become the earliest that keep the
    // other rights of way. False if a has no right of way over b.
    bool take_back(VisitId a, VisitId b);

    // A mark counts changes (rights of way given or taken back) that are not undone. A mark is
    // valid until a rollback goes below its number; rollback() throws std::invalid_argument on an
    // invalid mark.
    std::int64_t checkpoint() const { return static_cast<std::int64_t>(timetable_.n_changes()); }
    void rollback(std::int64_t mark);

    // Makes a robot inactive: the robot has no conflicts, and all rights of way of and over the
    // robot are taken back. A rollback below this change is refused.
    void withdraw(RobotId robot);

  private:
    void check_pair(VisitId a, VisitId b) const;
    template <class Use>
    void for_each_touched(Use&& use) const;
    void count_change();

    Routes routes_;
    Timetable timetable_;
    ConflictIndex index_;
    EarliestConflicts earliest_;
    Tick conflicts_ = 0;
    std::int64_t n_kept_ = 0;             // changes that no rollback can undo
    std::vector<Tick> conflicts_before_;  // per change
};

}  // namespace rightofway
