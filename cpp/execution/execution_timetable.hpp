// A plan on a floor where robots are late: by right of way, and by the clock.
//
// By right of way, each visit begins as soon as its robot is there and the visit before it at its
// vertex is over: longest paths in the precedence graph, over arcs as long as things really take.
// Visits that wait for each other round a circle of no length (a rotation of robots) are one joint
// event. The order in which events can take place is found once, without a look at the plan's
// times; what is left over can never take place, and is a deadlock.
//
// By the clock, each robot keeps its planned times as well as it can, and nobody looks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "execution/adg.hpp"
#include "execution/delays.hpp"

namespace rightofway {

// When things really happen; `never` where they never do. Reused from run to run.
struct ActualTimes {
    std::vector<Tick> enter;       // of each visit
    std::vector<Tick> start;       // from when each visit books its vertex
    std::vector<Tick> completion;  // of each robot
    std::vector<VisitId> cause;  // of each visit: the one whose enter it follows from; or no_visit
    std::vector<VisitId> to_blame;  // of each visit: the one that lasted from its cause until it
    std::vector<std::uint8_t> is_broken;  // of each robot: it stands still for ever
};

class ExecutionTimetable {
  public:
    explicit ExecutionTimetable(const ActionDependencyGraph& plan);

    // Robots that can never complete their routes, since they wait for each other.
    std::span<const RobotId> deadlocked() const { return deadlocked_; }

    // Whether a visit is among what can never take place.
    bool can_take_place(VisitId visit) const { return is_impossible_[visit] == 0; }

    void by_right_of_way(const DelaySample& setbacks, ActualTimes& times);

  private:
    void order_events();
    void emit(std::span<const VisitId> group);
    bool is_possible(std::span<const VisitId> group) const;
    void take_place(VisitId visit, const DelaySample& setbacks, ActualTimes& times);
    void take_place_jointly(std::span<const VisitId> group, const DelaySample& setbacks,
                            ActualTimes& times);

    const ActionDependencyGraph& plan_;
    std::vector<VisitId> events_;  // all but first visits, in an order in which they can happen
    std::vector<std::int32_t> first_of_group_{0};  // joint events are one group
    std::vector<std::uint8_t> is_impossible_;      // per visit
    std::vector<RobotId> deadlocked_;
    std::vector<std::int32_t> next_standstill_;  // per robot
};

// Fills everything but `cause` and `to_blame`.
void by_clock(const ActionDependencyGraph& plan, const DelaySample& setbacks, ActualTimes& times);

}  // namespace rightofway
