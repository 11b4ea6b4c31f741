// The tracks of a fleet, what they book, and what they cost. Robots may be without a track.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "problem/problem.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

struct TimedTrack {
    std::vector<Visit> visits;  // none: the robot has no track
    Tick completion = 0;
};

class FleetPlan {
  public:
    explicit FleetPlan(const Problem& problem);

    RobotId n_robots() const { return problem_->n_robots(); }
    const BookingTable& bookings() const { return bookings_; }
    const TimedTrack& track(RobotId robot) const {
        return tracks_[static_cast<std::size_t>(robot)];
    }
    bool has_track(RobotId robot) const { return !track(robot).visits.empty(); }
    Tick flowtime() const { return flowtime_; }
    Tracks tracks() const;

    // Exchanges a robot's track, bookings included, for the given one; either may be empty.
    void exchange(RobotId robot, TimedTrack& track);

    // Whether a track overlaps no booking of another robot, and swaps with none.
    bool fits(RobotId robot, const TimedTrack& track) const;

    // The other robots that a track would overlap or swap with, each once, in order.
    void in_the_way(RobotId robot, const TimedTrack& track, std::vector<RobotId>& robots) const;

    // Keeps the home of a robot without a track free until then; 0 ends that.
    void hold_home(RobotId robot, Tick until);

    // Makes all robots as early as the order of visits at every vertex allows; each has a track.
    void retime();

    // What visit k of a track books.
    Booking booking(const TimedTrack& track, std::size_t k) const;

  private:
    template <class Found>
    void meet(RobotId robot, const TimedTrack& track, const Found& found) const;

    const Problem* problem_;
    BookingTable bookings_;
    std::vector<TimedTrack> tracks_;
    std::vector<Tick> held_;
    Tick flowtime_ = 0;
};

}  // namespace rightofway
