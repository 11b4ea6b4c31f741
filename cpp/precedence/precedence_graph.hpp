// Routes, the right of way between them, the timetable that follows, and the conflicts still left.
//
// Planners work on this object: they read the next conflict, give one of its visits the right of
// way over the other, compare times and conflicts, and take it back if another choice is better.
// Every answer is kept up to date incrementally, and undone at the same cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/conflict_index.hpp"
#include "precedence/earliest_conflicts.hpp"
#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

class PrecedenceGraph {
  public:
    // All methods below throw std::invalid_argument on an unknown robot or visit.
    explicit PrecedenceGraph(const RouteArrays& arrays);

    // Its parts refer to each other.
    PrecedenceGraph(const PrecedenceGraph&) = delete;
    PrecedenceGraph& operator=(const PrecedenceGraph&) = delete;

    RobotId n_robots() const { return routes_.n_robots(); }
    VisitId n_visits() const { return routes_.n_visits(); }
    std::span<const Tick> enters() const { return timetable_.enters(); }
    std::vector<RightOfWay> rights_of_way() const { return timetable_.rights_of_way(); }
    Tick enter_of(VisitId visit) const;
    Tick completion(RobotId robot) const;
    Tick completion_sum() const;  // of the active robots

    // The rights of way that a robot has, or that others have over it.
    std::vector<RightOfWay> rights_of(RobotId robot) const;

    // The rights of way on a longest path to a robot's last visit, the latest first.
    std::vector<RightOfWay> critical_rights(RobotId robot) const;

    // The weight of the conflicts left: of all, or of one robot's with those whose mask is not 0.
    Tick conflicts() const { return conflicts_; }
    Tick conflicts_of(RobotId robot, std::span<const std::uint8_t> others) const;

    std::optional<Conflict> next_conflict() { return earliest_.next(); }
    std::optional<Conflict> next_conflict_between(RobotId robot, RobotId other) const;

    // See Timetable. Throws std::invalid_argument unless a and b are visits of two active robots
    // to one vertex.
    bool precede(VisitId a, VisitId b);
    // See Timetable; all visits of a vertex in their order at once. A rollback below this is
    // refused. Throws std::invalid_argument unless there is a number for each visit, rising along
    // each route, and nobody has any right of way yet.
    bool keep_order(std::span<const Tick> when);
    std::span<const VisitId> cycle() const { return timetable_.cycle(); }

    // Takes back one right of way, whenever it was given; the others get the earliest times that
    // keep theirs. False if there is none.
    bool take_back(VisitId a, VisitId b);

    // A mark is the number of changes so far: rights of way given or taken back, and not undone
    // since. It stays good for as long as no rollback goes below it. Throws std::invalid_argument
    // if one has.
    std::int64_t checkpoint() const { return static_cast<std::int64_t>(timetable_.n_changes()); }
    void rollback(std::int64_t mark);

    // Makes a robot inactive: it has no conflicts, its rights of way and those over it are taken
    // back. A rollback below this is refused.
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
