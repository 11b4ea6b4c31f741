// Who has booked which vertex when, for robots whose times are known.
//
// The bookings of a vertex lie side by side in order of time, all vertices in one array; a row that
// outgrows its place moves to one twice as long, and places that are given up are used again. So
// booking and taking back shift a few neighbours and allocate nothing, and a copy is three copies
// of memory. In a fleet without conflicts the bookings of a vertex do not overlap, and what lies
// between two of them is a *gap*; while conflicts are still being repaired, they may.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct BookedBy {
    Booking time;
    Tick reach;  // the latest end of this booking and those before it
    RobotId robot;
};

class BookingTable {
  public:
    // Throws std::invalid_argument if the number is negative.
    explicit BookingTable(VertexId n_vertices);

    VertexId n_vertices() const { return static_cast<VertexId>(rows_.size()); }
    std::span<const BookedBy> at(VertexId vertex) const {
        const Row& row = rows_[static_cast<std::size_t>(vertex)];
        return {pool_.data() + row.first, static_cast<std::size_t>(row.size)};
    }

    // Throws std::invalid_argument for an unknown vertex, an empty booking, or one that overlaps
    // another robot's.
    void book(VertexId vertex, const Booking& time, RobotId robot);

    // The same unchecked; bookings may overlap.
    void insert(VertexId vertex, const Booking& time, RobotId robot);

    // Takes back the booking of a robot that starts at a tick; nothing happens if there is none.
    void erase(VertexId vertex, Tick start, RobotId robot);

    // How many bookings start by then.
    static std::int32_t started(std::span<const BookedBy> bookings, Tick time) {
        const BookedBy* first = bookings.data();
        std::size_t length = bookings.size();
        while (length > 0) {  // written so that no branch has to be guessed
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
        std::int32_t size_class = -1;  // its place has 1 << size_class entries; -1: none yet
    };

    void grow(Row& row);

    std::vector<Row> rows_;
    std::vector<BookedBy> pool_;
    std::array<std::vector<std::uint32_t>, 32> unused_;  // places by size class
};

}  // namespace rightofway
