// The tracks of a fleet with their bookings and costs. A robot may have no track. The bookings
// begin with the closures of the problem.
//
// With a horizon, visits that begin later are not booked, and no stay is booked any longer: tracks
// may conflict behind it. Each track, cut at its last visit that begins by the horizon, then ends
// where its robot can stay (Li, Tinka, Kiesel, Durham, Kumar & Koenig, "Lifelong multi-agent path
// finding in large-scale warehouses", AAAI 2021).
//
// A stage may have to end before a stage of another robot begins. Then the two robots conflict if
// their tracks break that. A track is planned between the limits that the tracks of the others set
// (`find_limits`); for stages of robots without a track, their latest known ends count.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/search_end.hpp"
#include "lns/objective.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

struct TimedTrack {
    std::vector<Visit> visits;    // empty: the robot has no track
    Tick cost = 0;                // completion time or ends of stages, and surcharges of the edges
    std::vector<Tick> ends = {};  // of the work of each stage at a vertex, where stages have times
};

// The limits of the times of a robot's stages.
struct StageLimits {
    std::vector<Tick> earliest;
    std::vector<Tick> latest;
};

class FleetPlan {
  public:
    explicit FleetPlan(const Problem& problem, Objective objective = Objective::flowtime,
                       Tick horizon = never);

    RobotId n_robots() const { return problem_->n_robots(); }
    const BookingTable& bookings() const { return bookings_; }
    const TimedTrack& track(RobotId robot) const { return tracks_[index(robot)]; }
    bool has_track(RobotId robot) const { return !track(robot).visits.empty(); }
    Tick cost() const { return cost_; }  // the weighted sum over all tracks
    Objective objective() const { return objective_; }
    Tick horizon() const { return horizon_; }
    Worth worth() const;
    // The latest completion of a robot; for objectives without surcharges.
    Tick makespan() const;
    Tracks tracks() const;

    const Problem& problem() const { return *problem_; }

    // Swaps a robot's track with `track` and updates the bookings that differ; either track may be
    // empty. The robot has no window afterwards.
    void exchange(RobotId robot, TimedTrack& track);

    // Opens a window in a robot's track: visits `first` to `last` are not booked any more, but that
    // the robot is at the first one until a tick, and at the last one. `release_window` takes these
    // bookings away, and those of visits after the window that begin before a tick; `close_window`
    // books all visits again. Only where robots are points, and drives book no edges.
    void open_window(RobotId robot, std::size_t first, std::size_t last, Tick until);
    void release_window(RobotId robot, Tick until = 0);
    void close_window(RobotId robot);

    // The surcharges of the edges of a track.
    Tick surcharges(std::span<const Visit> visits) const;

    // Fills in the ends of the stages and the cost of a track, given its visits and the limits of
    // its stages. False if it misses a stage.
    bool measure(RobotId robot, TimedTrack& track) const;
    bool measure(RobotId robot, TimedTrack& track, const StageLimits& limits) const;
    // Measures tracks of all robots together, of which some may be empty, in any order of stages
    // that follow each other. The first robot whose track misses a stage; nobody if there is none.
    RobotId measure_all(std::span<TimedTrack> tracks) const;
    // The limits of a robot's stages among the tracks of the others. A track of a robot that has to
    // wait for this one limits its ends only if `keeps_followers`. Only for a problem with arcs.
    void find_limits(RobotId robot, bool keeps_followers, StageLimits& limits) const;
    // Sets the ends of stages that count until a track of their robot is known.
    void expect_ends(std::vector<Tick> ends) { ends_ = std::move(ends); }

    // Whether a track overlaps no booking, and has no swap or forbidden rotation with others.
    bool fits(RobotId robot, const TimedTrack& track) const;

    // The robots in conflict with a track (vertex, swap, rotation, or stages that follow each
    // other), each once, in order of id.
    void find_conflicting(RobotId robot, const TimedTrack& track,
                          std::vector<RobotId>& robots) const;

    // Books the home of a robot without a track until a tick; 0 removes the booking.
    void hold_home(RobotId robot, Tick until);
    // Closes the home of a robot until it is ready, when no eviction could make it leave; or opens
    // it again.
    void close_start(RobotId robot, bool is_closed);

    // Shifts each visit to the earliest time that keeps the order of bookings that exclude each
    // other. Needs all tracks, and a problem without closures. Changes nothing where stages of two
    // robots follow each other, and with a horizon. An exception of `interrupt`, which is polled,
    // leaves the plan as it was.
    void retime(const StopCondition& interrupt = {});

    // The booking of visit k of a track.
    Booking booking(const TimedTrack& track, std::size_t k) const;

  private:
    struct Window {
        std::size_t first = 0;
        std::size_t last = 0;
        bool is_open = false;
        bool is_held = false;
    };

    void insert(std::int32_t row, Booking time, RobotId robot);
    void book(RobotId robot, const TimedTrack& track, std::size_t first, std::size_t end);
    void erase(RobotId robot, const TimedTrack& track, std::size_t first, std::size_t end);
    template <class Use>
    void for_each_row(RobotId robot, const TimedTrack& track, std::size_t k, const Use& use) const;
    template <class Use>
    void for_each_mark(std::int32_t row, const Use& use) const;
    template <class Found>
    void meet(RobotId robot, const TimedTrack& track, const Found& found) const;
    template <class Found>
    bool meet_stages(RobotId robot, const TimedTrack& track, const Found& found) const;
    Tick end_of(std::int32_t stage) const { return ends_[index(stage)]; }

    const Problem* problem_;
    Objective objective_;
    Tick horizon_;
    BookingTable bookings_;
    std::vector<TimedTrack> tracks_;
    std::vector<Tick> held_;
    std::vector<Window> windows_;
    std::vector<Tick> ends_;  // the latest known ones of all stages, where some follow others
    Tick cost_ = 0;
};

}  // namespace rightofway
