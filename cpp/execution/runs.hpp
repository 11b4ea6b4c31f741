// Runs of a plan with delay samples, by right of way and by the clock, and the sources of lateness.
//
// Causes link a robot's completion to a chain of visits. Backwards along the chain, lateness of a
// visit beyond the lateness of its cause is charged to the source of the visit, unless made up for
// later. The charges sum up to the robot's lateness exactly; each belongs to a visit that took too
// long: of the robot itself, or of another robot that it waited for.
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

    // Adds a run by right of way, except robots that never complete.
    void add(const ActualTimes& times);

    // Ticks of lateness charged to each visit: of its own robot, and of other robots.
    const std::vector<Tick>& own() const { return own_; }
    const std::vector<Tick>& of_others() const { return of_others_; }

    // Ticks of lateness of a robot charged to another robot, by robot * n_robots + other.
    const std::unordered_map<std::int64_t, Tick>& between() const { return between_; }

  private:
    VisitId completing_stay(RobotId robot, const ActualTimes& times) const;
    void charge(RobotId robot, VisitId source, Tick ticks);

    const ActionDependencyGraph& plan_;
    std::vector<Tick> own_;
    std::vector<Tick> of_others_;
    std::unordered_map<std::int64_t, Tick> between_;
};

// Completions and breakdowns: per run and robot, run by run. Conflicts: per run.
struct RunBatch {
    std::vector<Tick> completion;         // by right of way; `never` if not completed
    std::vector<std::uint8_t> is_broken;  // breakdowns of robots
    std::vector<std::uint8_t> is_caught;  // of each run and robot
    std::vector<ConflictCount> by_right_of_way;
    std::vector<ConflictCount> by_clock;
};

class ExecutionRuns {
  public:
    // Both arguments are borrowed and must outlive this object.
    ExecutionRuns(const ActionDependencyGraph& plan, const Delays& delays);

    // Executes runs `first` to `first + count - 1`; fewer if `is_over`. Each run depends on its
    // number and the seed only. Adds lateness to `sources`.
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
