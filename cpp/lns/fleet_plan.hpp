// The tracks of a fleet with their bookings and costs. A robot may have no track. The bookings
// begin with the closures of the problem.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "lns/objective.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

struct TimedTrack {
    std::vector<Visit> visits;  // empty: the robot has no track
    Tick cost = 0;              // completion time and surcharges of the edges
};

class FleetPlan {
  public:
    explicit FleetPlan(const Problem& problem, Objective objective = Objective::flowtime);

    RobotId n_robots() const { return problem_->n_robots(); }
    const BookingTable& bookings() const { return bookings_; }
    const TimedTrack& track(RobotId robot) const { return tracks_[index(robot)]; }
    bool has_track(RobotId robot) const { return !track(robot).visits.empty(); }
    Tick cost() const { return cost_; }  // the weighted sum over all tracks
    Objective objective() const { return objective_; }
    Worth worth() const;
    // The latest completion of a robot; for objectives without surcharges.
    Tick makespan() const;
    Tracks tracks() const;

    const Problem& problem() const { return *problem_; }

    // Swaps a robot's track with `track` and updates the bookings; either track may be empty.
    void exchange(RobotId robot, TimedTrack& track);

    // The surcharges of the edges of a track.
    Tick surcharges(std::span<const Visit> visits) const;

    // Whether a track overlaps no booking, and has no swap or forbidden rotation with others.
    bool fits(RobotId robot, const TimedTrack& track) const;

    // The robots in conflict with a track (vertex, swap or rotation), each once, in order of id.
    void find_conflicting(RobotId robot, const TimedTrack& track,
                          std::vector<RobotId>& robots) const;

    // Books the home of a robot without a track until a tick; 0 removes the booking.
    void hold_home(RobotId robot, Tick until);

    // Shifts each visit to the earliest time that keeps the order of bookings that exclude each
    // other. Needs all tracks, and a problem without closures. An exception of `interrupt`, which
    // is polled, leaves the plan as it was.
    void retime(const StopCondition& interrupt = {});

    // The booking of visit k of a track.
    Booking booking(const TimedTrack& track, std::size_t k) const;

  private:
    template <class Use>
    void for_each_row(RobotId robot, const TimedTrack& track, std::size_t k, const Use& use) const;
    template <class Use>
    void for_each_mark(std::int32_t row, const Use& use) const;
    template <class Found>
    void meet(RobotId robot, const TimedTrack& track, const Found& found) const;

    const Problem* problem_;
    Objective objective_;
    BookingTable bookings_;
    std::vector<TimedTrack> tracks_;
    std::vector<Tick> held_;
    Tick cost_ = 0;
};

}  // namespace rightofway
