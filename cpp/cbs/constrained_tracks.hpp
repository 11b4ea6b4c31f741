// The best track of one robot under constraints, alone on the roads: the low level of
// conflict-based search. Each robot and set of constraints is searched once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "cbs/constraint_sets.hpp"
#include "cbs/held_tables.hpp"
#include "cbs/joint_search.hpp"
#include "core/search_end.hpp"
#include "distances/shared_distances.hpp"
#include "distances/trip.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"
#include "search/sipp.hpp"

namespace rightofway {

struct RowBooking {
    std::int32_t row;
    Booking time;
};

// A drive along an edge, by the tick at which it ends.
struct Move {
    Tick enter;
    EdgeId edge;
    VertexId tail;
    VertexId head;
};

struct ConstrainedTrack {
    std::vector<Visit> visits;
    std::vector<RowBooking> bookings;  // by row, then by start
    std::vector<Move> moves;           // by time; only where robots may follow each other at once
    Tick completion = 0;
    Tick cost = 0;  // completion time and surcharges of the edges, by the robot's weight
};

// Tracks of some robots.
struct JointPlan {
    SearchEnd end = SearchEnd::stopped;
    std::int64_t n_states = 0;                    // searched
    Tick bound = 0;                               // of their costs; `never` if there is no plan
    std::vector<const ConstrainedTrack*> tracks;  // where the search found a plan
};

// What the tracks of some robots exclude others from, besides closures.
class Traffic {
  public:
    // Borrows the problem.
    explicit Traffic(const Problem& problem);

    // Gives a robot another track; null for none. Borrows the track.
    void exchange(RobotId robot, const ConstrainedTrack* track);

    // The other robots that a track of this robot conflicts with, in order.
    const std::vector<RobotId>& robots_met(RobotId robot, const ConstrainedTrack& track);

    BookingTable& table() { return table_; }

  private:
    template <class Use>
    void for_each_mark(const ConstrainedTrack& track, const Use& use) const;

    const Problem& problem_;
    BookingTable table_;
    std::vector<const ConstrainedTrack*> tracks_;
    std::vector<RobotId> met_;
};

class ConstrainedTracks {
  public:
    // Borrows the problem and its distances.
    ConstrainedTracks(const Problem& problem, SharedDistances& distances);

    const Problem& problem() const { return problem_; }
    ConstraintSets& sets() { return sets_; }

    // A track of least cost that books nothing closed and keeps the constraints; null if it is
    // proven that there is none. Throws Stopped. The pointer stays valid.
    const ConstrainedTrack* best(RobotId robot, SetId set, const StopCondition& is_over);

    // A track of at most this cost, by the robot's weight, that keeps the constraints and overlaps
    // the fewest bookings of others in the traffic; with surcharges, one that overlaps none. Null
    // if there is none, or none is found in some thousand states. The traffic has no track of the
    // robot afterwards. Throws Stopped.
    const ConstrainedTrack* clearest(RobotId robot, SetId set, Tick cost, Traffic& traffic,
                                     const StopCondition& is_over);

    // The tracks of least cost with which some robots, alone on the roads, keep clear of each other
    // and of the constraints, each within a cost (empty: any); the bound where the search stops
    // after `most_nodes` joint states. Throws Stopped. The pointers stay valid.
    JointPlan together(std::span<const RobotId> robots, std::span<const SetId> sets,
                       std::span<const Tick> most, std::int64_t most_nodes,
                       const StopCondition& is_over);

    std::int64_t n_searches() const { return n_searches_; }
    // About how much memory the tracks take [bytes].
    std::size_t bytes() const { return bytes_; }

  private:
    const ConstrainedTrack* search(RobotId robot, std::span<const Constraint> constraints,
                                   SearchRequest request, BookingTable& table,
                                   const StopCondition& is_over);
    SearchRequest constrained(std::span<const Constraint> constraints, SearchRequest request,
                              BookingTable& table) const;
    void release(std::span<const Constraint> constraints, BookingTable& table) const;
    const ConstrainedTrack* keep(RobotId robot, ConstrainedTrack&& track);
    void book(RobotId robot, ConstrainedTrack& track) const;

    const Problem& problem_;
    Traffic no_traffic_;
    HeldTables held_;
    std::deque<TripReader> trips_;  // one per robot: a reader keeps one trip
    SafeIntervalSearch search_;
    ConstraintSets sets_;
    std::vector<Tick> prices_;  // of an overlap with each robot
    JointSearch joint_;
    std::deque<ConstrainedTrack> tracks_;
    std::unordered_map<std::uint64_t, const ConstrainedTrack*> known_;
    std::int64_t n_searches_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace rightofway
