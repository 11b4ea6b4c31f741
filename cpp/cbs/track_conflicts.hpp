// The conflicts of two tracks, each with the two constraints of which every plan keeps one.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// Bookings of two robots that overlap, or a swap. No plan breaks both constraints, so no plan is
// lost where one child keeps the first and another child keeps the second.
struct TrackConflict {
    std::array<RobotId, 2> robot;
    std::array<Constraint, 2> constraint;
    // What each robot loses by its constraint, and its set with it; -1 while not known.
    std::array<Tick, 2> loss{-1, -1};
    std::array<SetId, 2> set{-1, -1};
    Tick since = never;  // first tick of the overlap, of the last of which the constraints are
};

// The constraint for a robot whose drive along an edge ends at `tick`, together with robots that
// drive out of its head. It forbids the drive to end in [tick, tick + drive), and no other stay.
Constraint against_move(const Problem& problem, EdgeId edge, Tick tick);

// What the tracks of other robots are compared with.
class ConflictFinder {
  public:
    // Borrows the problem. With `targets`, a robot that has reached its end for ever is a conflict
    // of its own kind.
    ConflictFinder(const Problem& problem, bool targets) : problem_(problem), targets_(targets) {}

    // Prepares the comparison of a robot's track with many others. Borrows the track.
    void take(RobotId robot, const ConstrainedTrack& track);

    // Appends the conflicts of the track that was taken with the track of another robot.
    void meet(RobotId other, const ConstrainedTrack& track,
              std::vector<TrackConflict>& conflicts) const;

  private:
    struct Mark {
        std::int32_t row;  // excluded from other robots
        std::int32_t own;  // by a booking of this row
        Booking time;
    };

    void meet_swaps(RobotId other, const ConstrainedTrack& track,
                    std::vector<TrackConflict>& conflicts) const;

    TrackConflict meet_at_end(const Mark& own, RobotId other, const RowBooking& booking) const;

    const Problem& problem_;
    bool targets_;
    RobotId robot_ = nobody;
    const ConstrainedTrack* track_ = nullptr;
    std::vector<Mark> marks_;  // by row
};

// Robots that rotate at one instant, each of which enters what the next one leaves; empty if there
// are none. Only for rules that forbid rotations.
struct Rotation {
    std::vector<RobotId> robots;
    std::vector<Constraint> constraints;  // no plan breaks all of them
};
Rotation find_rotation(const Problem& problem, std::span<const RobotId> robots,
                       std::span<const ConstrainedTrack* const> tracks);

}  // namespace rightofway
