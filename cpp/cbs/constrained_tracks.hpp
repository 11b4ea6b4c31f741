// The best track of one robot under constraints, alone on the roads: the low level of
// conflict-based search. Each robot and set of constraints is searched once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "cbs/constraint_sets.hpp"
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
    Tick cost = 0;  // completion time and surcharges of the edges, by the robot's weight
};

// Thrown where the stop condition ends a search.
struct Stopped {};

class ConstrainedTracks {
  public:
    // Borrows the problem and its distances.
    ConstrainedTracks(const Problem& problem, SharedDistances& distances);

    const Problem& problem() const { return problem_; }
    ConstraintSets& sets() { return sets_; }

    // A track of least cost that books nothing closed and keeps the constraints; null if it is
    // proven that there is none. Throws Stopped. The pointer stays valid.
    const ConstrainedTrack* best(RobotId robot, SetId set, const StopCondition& is_over);

    std::int64_t n_searches() const { return n_searches_; }
    // About how much memory the tracks take [bytes].
    std::size_t bytes() const { return bytes_; }

  private:
    void book(RobotId robot, ConstrainedTrack& track) const;

    const Problem& problem_;
    std::int32_t n_rows_;
    BookingTable table_;
    std::deque<TripReader> trips_;  // one per robot: a reader keeps one trip
    SafeIntervalSearch search_;
    ConstraintSets sets_;
    std::deque<ConstrainedTrack> tracks_;
    std::unordered_map<std::uint64_t, const ConstrainedTrack*> known_;
    std::int64_t n_searches_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace rightofway
