// The times of a plan that is executed with delays: by right of way, and by the clock.
//
// By right of way, each visit begins as soon as its robot is ready and the visit before it at its
// vertex has been left: longest paths in the action dependency graph, with actual durations. Visits
// that wait for each other in a cycle of zero length (a rotation of robots) are one joint event. An
// order in which events can take place is found once, from the graph alone; visits without a place
// in it can never take place, and are a deadlock.
//
// By the clock, each robot keeps its planned times as well as it can, without regard to others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "execution/adg.hpp"
#include "execution/delays.hpp"

namespace rightofway {

// Actual times, `never` where a visit does not take place. Reused from run to run.
struct ActualTimes {
    std::vector<Tick> enter;       // of each visit
    std::vector<Tick> start;       // of each visit: when its booking begins
    std::vector<Tick> completion;  // of each robot
    std::vector<VisitId> cause;    // of each visit: the one whose enter it follows from; or none
    std::vector<VisitId> source;   // of each visit: the one that lasted from its cause until it
    std::vector<std::uint8_t> is_broken;  // of each robot: it stands still for ever
};

class ExecutionTimetable {
  public:
    explicit ExecutionTimetable(const ActionDependencyGraph& plan);

    // Robots that can never complete their routes because they wait for each other.
    std::span<const RobotId> deadlocked() const { return deadlocked_; }

    // False for a visit that waits in a deadlock.
    bool can_take_place(VisitId visit) const { return is_impossible_[visit] == 0; }

    void by_right_of_way(const DelaySample& sample, ActualTimes& times);

  private:
    void order_events();
    void emit(std::span<const VisitId> group);
    bool is_possible(std::span<const VisitId> group) const;
    void take_place(VisitId visit, const DelaySample& sample, ActualTimes& times);
    void take_place_jointly(std::span<const VisitId> group, const DelaySample& sample,
                            ActualTimes& times);

    const ActionDependencyGraph& plan_;
    std::vector<VisitId> events_;  // all but first visits, in an order in which they can happen
    std::vector<std::int32_t> first_of_group_{0};  // a group is one joint event
    std::vector<std::uint8_t> is_impossible_;      // per visit
    std::vector<RobotId> deadlocked_;
    std::vector<std::int32_t> next_stoppage_;  // per robot
};

// Fills everything but `cause` and `source`.
void by_clock(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times);

}  // namespace rightofway
