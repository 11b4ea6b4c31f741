// The actual times of a plan executed with delays: by right of way, or by the clock.
//
// By right of way, a visit begins as soon as its robot is ready and the previous visit to its
// vertex has ended: longest paths in the action dependency graph, with actual durations. Visits
// that wait for each other in a cycle of zero length (a rotation) are one joint event. A
// topological order of events is computed once, from the graph alone; visits outside this order can
// never take place: a deadlock.
//
// Works in visits are events, too: a robot leaves after the last work of its visit. A work begins
// when its robot is there, its time has come, and the works before it have ended.
//
// Closures are kept by the clock: a robot starts a drive only if its bookings along the edge and of
// the next stay, of planned durations, overlap no closure. A robot with a booking that overlaps one
// all the same is caught.
//
// By the clock, each robot follows its planned times as closely as possible, regardless of others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "execution/adg.hpp"
#include "execution/delays.hpp"

namespace rightofway {

// Actual times; `never` if a visit does not take place. Reused from run to run.
struct ActualTimes {
    std::vector<Tick> enter;       // of each visit
    std::vector<Tick> start;       // of each visit: start of its booking
    std::vector<Tick> completion;  // of each robot
    std::vector<Tick> begin;       // of each work
    std::vector<Tick> end;         // of each work
    std::vector<VisitId> cause;    // of each visit: its predecessor on a longest path, or `none`
    std::vector<VisitId> source;   // of each visit: charged for lateness beyond the cause
    std::vector<VisitId> stay;     // of each work: the visit whose stay its end is due to
    std::vector<std::uint8_t> is_broken;  // of each robot: broken down
    std::vector<std::uint8_t> is_caught;  // of each robot: books something that is closed
};

class ExecutionTimetable {
  public:
    explicit ExecutionTimetable(const ActionDependencyGraph& plan);

    // Robots that can never complete their routes because of a deadlock.
    std::span<const RobotId> deadlocked() const { return deadlocked_; }

    // False for a visit in or behind a deadlock.
    bool can_take_place(VisitId visit) const { return is_possible_event(visit); }

    // Ends early only by an exception of `interrupt`, which is polled.
    void by_right_of_way(const DelaySample& sample, ActualTimes& times,
                         const StopCondition& interrupt = {});

  private:
    // An event: the begin of a visit, or, beyond the number of visits, a work.
    using EventId = std::int32_t;

    void order_events();
    void emit(std::span<const EventId> group);
    bool is_possible(std::span<const EventId> group) const;
    bool is_possible_event(EventId event) const { return is_impossible_[index(event)] == 0; }
    bool is_work(EventId event) const { return event >= plan_.n_visits(); }
    EventId last_event_in(VisitId visit) const;
    EventId own_event_before(EventId event) const;
    std::size_t n_others_before(EventId event) const;
    EventId other_before(EventId event, std::size_t which) const;
    void do_work(WorkId work, const DelaySample& sample, ActualTimes& times);
    VisitId stay_until_done_in(VisitId visit, const ActualTimes& times) const;
    Tick planned_stay(VisitId visit, Tick enter) const;
    void start_visit(VisitId visit, const DelaySample& sample, ActualTimes& times);
    Tick clear_of_closures(VisitId visit, Tick start) const;
    void find_caught(const DelaySample& sample, ActualTimes& times) const;
    void start_jointly(std::span<const VisitId> group, const DelaySample& sample,
                       ActualTimes& times);

    const ActionDependencyGraph& plan_;
    std::vector<EventId> events_;                  // all but first visits, in topological order
    std::vector<std::int32_t> first_of_group_{0};  // a group is one joint event
    std::vector<std::uint8_t> is_impossible_;      // per event
    std::vector<RobotId> deadlocked_;
    std::vector<std::int32_t> next_stoppage_;  // per robot
};

// Fills all members except `cause`, `source` and `is_caught`.
void by_clock(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times);

}  // namespace rightofway
