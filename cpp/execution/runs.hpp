// Many runs of a plan on a late floor, by right of way and by the clock with the same delays.
#pragma once

#include <cstdint>
#include <vector>

#include "core/search_end.hpp"
#include "execution/delays.hpp"
#include "execution/executed_conflicts.hpp"
#include "execution/execution_timetable.hpp"
#include "execution/lateness.hpp"

namespace rightofway {

// One entry for each run and robot, runs one behind the other; or one for each run.
struct RunBatch {
    std::vector<Tick> completion;         // by right of way; `never` for never
    std::vector<std::uint8_t> is_broken;  // it stands still for ever
    std::vector<ConflictCount> by_right_of_way;
    std::vector<ConflictCount> by_clock;
};

class ExecutionRuns {
  public:
    // Borrows both.
    ExecutionRuns(const ActionDependencyGraph& plan, const Delays& delays);

    // Runs `first`, `first` + 1, … up to so many; fewer where `is_over`, asked now and then, says
    // so. Each depends on its number and the seed alone. Lateness is added to `sources`.
    RunBatch run(std::uint64_t seed, std::uint64_t first, std::size_t count,
                 LatenessSources& sources, const StopCondition& is_over);

  private:
    const ActionDependencyGraph& plan_;
    const Delays& delays_;
    ExecutionTimetable timetable_;
    ExecutedConflicts conflicts_;
    ExecutedConflicts conflicts_by_clock_;
    DelaySample setbacks_;
    ActualTimes times_;
    ActualTimes times_by_clock_;
};

}  // namespace rightofway
