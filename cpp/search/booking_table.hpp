// The bookings of each row, by start, for robots with known times.
//
// A row is a vertex; where robots have sizes, a vertex or an edge as robots of one size see it, and
// a booking is inserted in every row from which it excludes others (problem.hpp).
//
// One array has all rows. A full row moves to a place of twice the size; a freed
// place is used again. So insert and erase shift a few entries and mostly allocate nothing, and a
// copy of the table is three copies of memory. A *gap* is the time between two bookings of one
// row. The bookings of a row overlap while the plan has conflicts, and where robots have sizes.
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
    // Throws std::invalid_argument if `n_rows` is negative or above 2^26.
    explicit BookingTable(std::int32_t n_rows);

    std::int32_t n_rows() const { return static_cast<std::int32_t>(rows_.size()); }
    std::span<const BookedBy> at(std::int32_t row) const {
        const Row& one = rows_[index(row)];
        return {pool_.data() + one.first, static_cast<std::size_t>(one.size)};
    }

    // Adds a booking. Throws std::invalid_argument for an unknown row, an empty booking, or an
    // overlap with a booking of another robot.
    void book(std::int32_t row, const Booking& time, RobotId robot);

    // Adds a booking that may overlap others. Throws std::invalid_argument for an unknown row or
    // robot, or an empty booking. A booking of nobody is a closure.
    void mark(std::int32_t row, const Booking& time, RobotId robot);

    // Adds a booking without checks; bookings may overlap. A booking of nobody is a closure.
    void insert(std::int32_t row, const Booking& time, RobotId robot);

    // Removes the robot's booking with this start, if the row has one.
    void erase(std::int32_t row, Tick start, RobotId robot);

    // Whether there are bookings of nobody, which no robot can be moved from.
    bool has_closures() const { return has_closures_; }

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

    // Calls `use` with each of these bookings, which are the first of a row, that ends after
    // `start`: the latest start first, until `use` returns true. Returns whether it did.
    template <class Use>
    static bool any_ending_after(std::span<const BookedBy> bookings, Tick start, const Use& use) {
        for (std::size_t k = bookings.size(); k > 0 && bookings[k - 1].reach > start; --k) {
            if (bookings[k - 1].time.end > start && use(bookings[k - 1])) {
                return true;
            }
        }
        return false;
    }
    // The same for each booking of a row that overlaps a time.
    template <class Use>
    static bool any_overlap(std::span<const BookedBy> bookings, const Booking& time,
                            const Use& use) {
        const auto n_started = index(started(bookings, time.end - 1));
        return any_ending_after(bookings.first(n_started), time.start, use);
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
    bool has_closures_ = false;
    std::array<std::vector<std::uint32_t>, 32> unused_;  // freed places by size class
};

}  // namespace rightofway
