// Many runs of a plan, by right of way and by the clock with the same delays; and the sources of
// their lateness.
//
// A robot's completion follows from a chain of visits, each from its cause. Backwards along it, the
// lateness that is more at a visit than at its cause began there, as far as it was not made up for
// later. So the parts sum up to the lateness exactly, and each belongs to a visit that took too
// long: one of the robot's own, or of another robot that it waited for.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "execution/delays.hpp"
#include "execution/executed_conflicts.hpp"
#include "execution/execution_timetable.hpp"

namespace rightofway {

class LatenessSources {
  public:
    explicit LatenessSources(const ActionDependencyGraph& plan);

    // Adds a run by right of way; robots that never complete do not count.
    void add(const ActualTimes& times);

    // Ticks of lateness that began at each visit: of its own robot, and of others.
    const std::vector<Tick>& own() const { return own_; }
    const std::vector<Tick>& of_others() const { return of_others_; }

    // Ticks that one robot is late because of another, by robot * n_robots + other.
    const std::unordered_map<std::int64_t, Tick>& between() const { return between_; }

  private:
    void charge(RobotId robot, VisitId source, Tick ticks);

    const ActionDependencyGraph& plan_;
    std::vector<Tick> own_;
    std::vector<Tick> of_others_;
    std::unordered_map<std::int64_t, Tick> between_;
};

// One entry for each run and robot, run by run; or one for each run.
struct RunBatch {
    std::vector<Tick> completion;         // by right of way; `never` if it does not
    std::vector<std::uint8_t> is_broken;  // the robot stands still for ever
    std::vector<ConflictCount> by_right_of_way;
    std::vector<ConflictCount> by_clock;
};

class ExecutionRuns {
  public:
    // Borrows both.
    ExecutionRuns(const ActionDependencyGraph& plan, const Delays& delays);

    // Runs `first` to `first + count - 1`; fewer if `is_over`. Each depends on its number and the
    // seed alone. Lateness is added to `sources`.
    RunBatch run(std::uint64_t seed, std::uint64_t first, std::size_t count,
                 LatenessSources& sources, const StopCondition& is_over);

  private:
    const ActionDependencyGraph& plan_;
    const Delays& delays_;
    ExecutionTimetable timetable_;
    ExecutedConflicts conflicts_;
    ExecutedConflicts conflicts_by_clock_;
    DelaySample sample_;
    ActualTimes times_;
    ActualTimes times_by_clock_;
};

}  // namespace rightofway
