// Replans a part of the track of a robot with many stages: a window of visits. The visits before
// keep their times. The visits after keep their vertices and their order among the bookings of
// others, and shift by as much as the robot comes sooner or later.
//
// Each of these visits lies in a gap between two bookings of others. A plan in which the robot is
// in the same gaps keeps the order of visits, whatever its times; so a visit begins at the end of
// the booking before its gap or later, and the one after it no later than the booking after its gap
// begins. From both follows how much later the robot may come at the end of its window.
//
// Only for stages with times, for points, and for robots that turn in no time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "distances/trip.hpp"
#include "lns/fleet_plan.hpp"
#include "search/sipp.hpp"

namespace rightofway {

struct TrackWindow {
    std::size_t first = 0;  // visits first + 1 to last - 1 are replanned, and when `last` begins
    std::size_t last = 0;
    std::size_t first_stage = 0;  // stages first_stage to end_stage - 1 end in the window
    std::size_t end_stage = 0;
    Tick until = 0;   // when the robot is ready to leave the first visit
    Tick value = 0;   // what the ends of the stages and the end of the window cost
    Tick least = 0;   // the same without other robots
    Tick weight = 0;  // what a tick of the end of the window costs, about
};

// Whether windows may be replanned in the tracks of a problem.
bool may_have_windows(const Problem& problem);

class WindowSearch {
  public:
    // Borrows both.
    WindowSearch(SharedDistances& distances, FleetPlan& plan);

    // Chooses the window of a robot from some ticks before a time to the end of a stage some ticks
    // after it. False if the robot has served all its stages by then.
    bool choose(RobotId robot, Tick middle, Tick around, TrackWindow& window);

    // The best track with a window of which value is at most `limit`, for a robot whose window is
    // open; releases it. False if there is none, or `is_over`.
    bool find(RobotId robot, const TrackWindow& window, Tick limit, const StopCondition& is_over,
              TimedTrack& found);

    // The value of the window of the latest track that was found.
    Tick value() const { return search_.cost(); }
    std::int64_t n_expanded() const { return search_.n_expanded(); }

  private:
    struct Gap {
        Tick begin = -never;  // the booking of another robot before it ends
        Tick end = never;     // that after it begins
    };

    void read(RobotId robot);
    void cut(const TrackWindow& window);
    Gap gap_at(RobotId robot, const Visit& visit) const;
    Tick find_latest(RobotId robot, const TrackWindow& window) const;
    Tick weigh(RobotId robot, const TrackWindow& window) const;
    Tick work_in(std::size_t visit, Tick now) const;
    bool shift(RobotId robot, const TrackWindow& window, Tick done, TimedTrack& found) const;
    Tick value_of(std::span<const Tick> ends, const TrackWindow& window) const;

    const Problem& problem_;
    FleetPlan& plan_;
    SafeIntervalSearch search_;
    TripReader reader_;
    const Trip* trip_ = nullptr;  // of the whole track
    Trip part_;                   // of the window
    StageLimits limits_;
    std::vector<std::int32_t> stage_after_;
    std::vector<Tick> ends_;
    std::vector<Visit> visits_;
};

}  // namespace rightofway
