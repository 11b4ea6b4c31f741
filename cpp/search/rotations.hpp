// Rotations in a booking table: three or more robots of which each enters, at one instant, the
// vertex that the next one leaves. Only where rules forbid them and bookings do not.
//
// A robot that is planned among all others closes a rotation by its own move, and the moves of the
// others are in the table. So no move that closes one is left to the search, as with swaps.
#pragma once

#include "core/graph.hpp"
#include "core/types.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

// A move along an edge from `tail` to `head` that ends at a tick.
struct InstantMove {
    VertexId tail;
    VertexId head;
    Tick tick;
    RobotId robot = nobody;  // whose bookings are left out
};

// The robot that leaves the head of a move, if the move would close a rotation; else nobody. Rows
// of vertices begin with `first_row`. In a table with overlaps there can be more than one robot to
// follow from a vertex; one of them is followed.
RobotId find_rotation_ahead(const Graph& graph, const BookingTable& table, std::int32_t first_row,
                            const InstantMove& move);

}  // namespace rightofway
