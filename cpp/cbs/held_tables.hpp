// Holds as bookings: a robot that must be at or next to a vertex at a tick finds all others booked.
// That is nearly every row of the map, and a robot is searched again and again with the same holds,
// so a few tables keep those of the robots that were searched last.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cbs/constraint_sets.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

class HeldTables {
  public:
    // Borrows the problem, and a table with its closures.
    HeldTables(const Problem& problem, const BookingTable& closed)
        : problem_(problem), closed_(closed) {}

    // A table with the closures and these holds of a robot, which are in order. What the caller
    // adds it takes out again; the table stays as it is until the next call.
    BookingTable& at(RobotId robot, std::span<const Constraint> holds);

    // Puts a hold into a table of bookings by vertex, or takes it out.
    void insert(const Constraint& hold, BookingTable& table) const;
    void erase(const Constraint& hold, BookingTable& table) const;

  private:
    struct Entry {
        RobotId robot;
        std::vector<Constraint> holds;  // that are in the table
        BookingTable table;
        std::size_t last_use;
    };
    static constexpr std::size_t most_tables = 8;  // each is a copy of all rows

    template <class Use>
    void for_each_left(const Constraint& hold, const Use& use) const;
    Entry& entry_of(RobotId robot);

    const Problem& problem_;
    const BookingTable& closed_;
    std::vector<Entry> entries_;
    std::size_t n_uses_ = 0;
};

}  // namespace rightofway
