// Who has booked which vertex when, for robots whose times are known.
//
// The bookings of a vertex are kept in order of time and do not overlap; what lies between two of
// them is a *gap*, a time in which the vertex is free for somebody else. Searches for one more
// robot walk over gaps.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rightofway/conflict.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

struct BookedBy {
    Booking time;
    RobotId robot;
};

// The robots are those of the bookings right before and after, nobody (-1) where there is none.
struct Gap {
    Tick start;
    Tick end;
    RobotId before;
    RobotId after;
};

class BookingTable {
  public:
    // Throws std::invalid_argument if the number is negative.
    explicit BookingTable(VertexId n_vertices);

    VertexId n_vertices() const { return static_cast<VertexId>(at_.size()); }
    std::span<const BookedBy> at(VertexId vertex) const { return at_[vertex]; }

    // A robot that comes back to a vertex before its booking of it is over books on without a gap.
    // Throws std::invalid_argument for an unknown vertex, an empty booking, or one that overlaps
    // another robot's (so that the table is always one of a fleet without conflicts).
    void book(VertexId vertex, const Booking& time, RobotId robot);

    // Takes back all that a robot has booked.
    void release(RobotId robot);

    // Gap k lies before booking k; the last one never ends. Gaps may be empty.
    std::int32_t n_gaps(VertexId vertex) const {
        return static_cast<std::int32_t>(at_[vertex].size()) + 1;
    }
    Gap gap(VertexId vertex, std::int32_t k) const;

    // The first gap that ends after a time.
    std::int32_t first_gap_after(VertexId vertex, Tick time) const;

  private:
    std::vector<std::vector<BookedBy>> at_;
    std::vector<std::vector<VertexId>> of_;  // where each robot has bookings, once for each
};

}  // namespace rightofway
