// Many runs of a plan on a late floor, by right of way and by the clock with the same delays.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rightofway/delayed_timetable.hpp"
#include "rightofway/delays.hpp"
#include "rightofway/floor_conflicts.hpp"
#include "rightofway/lateness.hpp"

namespace rightofway {

// One entry for each run and robot, runs one behind the other; or one for each run.
struct FloorOutcome {
    std::vector<Tick> completion;         // by right of way; `infinity` for never
    std::vector<std::uint8_t> is_broken;  // it stands still for ever
    std::vector<CollisionCount> by_right_of_way;
    std::vector<CollisionCount> by_clock;
};

class FloorRuns {
  public:
    // Borrows both.
    FloorRuns(const FloorPlan& plan, const Delays& delays);

    // Runs `first`, `first` + 1, … up to so many; fewer where `is_over`, asked now and then, says
    // so. Each depends on its number and the seed alone. Lateness is added to `sources`.
    FloorOutcome run(std::uint64_t seed, std::uint64_t first, std::size_t count,
                     LatenessSources& sources, const std::function<bool()>& is_over);

  private:
    const FloorPlan& plan_;
    const Delays& delays_;
    DelayedTimetable timetable_;
    FloorConflicts conflicts_;
    FloorConflicts conflicts_by_clock_;
    Setbacks setbacks_;
    ActualTimes times_;
    ActualTimes times_by_clock_;
};

}  // namespace rightofway
