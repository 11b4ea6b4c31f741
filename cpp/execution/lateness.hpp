// Where lateness comes from.
//
// A robot's completion follows from a chain of visits, each from its cause. Gone back along it,
// what is left of the lateness is what began earlier: at each visit as much begins as the lateness
// is more there than at its cause, as far as it was not made up for later. So the parts sum up to
// the lateness exactly, and each belongs to a visit that took too long: one of the robot's own, or
// one of somebody it waited for.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "execution/adg.hpp"
#include "execution/execution_timetable.hpp"

namespace rightofway {

class LatenessSources {
  public:
    explicit LatenessSources(const ActionDependencyGraph& plan);

    // One more run by right of way; who never completes does not count.
    void add(const ActualTimes& times);

    // Ticks that began at each visit, for its own robot and for others.
    const std::vector<Tick>& own() const { return own_; }
    const std::vector<Tick>& of_others() const { return of_others_; }

    // Ticks that one robot is late because of another, by robot * n_robots + other; never of
    // itself.
    const std::unordered_map<std::int64_t, Tick>& between() const { return between_; }

  private:
    void charge(RobotId robot, VisitId to_blame, Tick ticks);

    const ActionDependencyGraph& plan_;
    std::vector<Tick> own_;
    std::vector<Tick> of_others_;
    std::unordered_map<std::int64_t, Tick> between_;
};

}  // namespace rightofway
