// The bookings of each vertex, by start, for robots with known times.
//
// One array has the rows of all vertices. A full row moves to a place of twice the size; a freed
// place is used again. So insert and erase shift a few entries and mostly allocate nothing, and a
// copy of the table is three copies of memory. A *gap* is the time between two bookings of one
// vertex. The bookings of a vertex overlap only while the plan has conflicts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct BookedBy {
    Booking time;
    Tick reach;  // latest end of this booking and of all bookings before it in the row
    RobotId robot;
};

class BookingTable {
  public:
    // Throws std::invalid_argument if `n_vertices` is negative.
    explicit BookingTable(VertexId n_vertices);

    VertexId n_vertices() const { return static_cast<VertexId>(rows_.size()); }
    std::span<const BookedBy> at(VertexId vertex) const {
        const Row& row = rows_[static_cast<std::size_t>(vertex)];
        return {pool_.data() + row.first, static_cast<std::size_t>(row.size)};
    }

    // Adds a booking. Throws std::invalid_argument for an unknown vertex, an empty booking, or an
    // overlap with a booking of another robot.
    void book(VertexId vertex, const Booking& time, RobotId robot);

    // Adds a booking without checks; bookings may overlap.
    void insert(VertexId vertex, const Booking& time, RobotId robot);

    // Removes the robot's booking with this start, if the vertex has one.
    void erase(VertexId vertex, Tick start, RobotId robot);

    // The number of bookings with start <= time.
    static std::int32_t started(std::span<const BookedBy> bookings, Tick time) {
        const BookedBy* first = bookings.data();
        std::size_t length = bookings.size();
        while (length > 0) {  // branch-free binary search
            const std::size_t half = length / 2;
            const bool is_right = first[half].time.start <= time;
            first += is_right ? half + 1 : 0;
            length = is_right ? length - half - 1 : half;
        }
        return static_cast<std::int32_t>(first - bookings.data());
    }

  private:
    struct Row {
        std::uint32_t first = 0;
        std::int32_t size = 0;
        std::int32_t size_class = -1;  // its place has 1 << size_class entries; -1: no place
    };

    void grow(Row& row);

    std::vector<Row> rows_;
    std::vector<BookedBy> pool_;
    std::array<std::vector<std::uint32_t>, 32> unused_;  // freed places by size class
};

}  // namespace rightofway
