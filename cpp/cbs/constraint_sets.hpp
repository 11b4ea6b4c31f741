// Constraints of conflict-based search: bookings without a robot, in sets that are stored once.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// The robot may not book the row at any tick of [start, end). Rows that no robot books stand for
// other constraints: two for the end of its track, what it must not have begun, or completed,
// before `end`; and one for each row that it must be at or next to at `start` (disjoint splitting).
struct Constraint {
    static constexpr std::int32_t last_visit = -1;  // the booking of its last visit
    static constexpr std::int32_t completion = -2;  // its completion

    static constexpr Constraint hold(std::int32_t row, Tick tick) {
        return {completion - 1 - row, tick, tick + 1};
    }
    bool is_hold() const { return row < completion; }
    std::int32_t held_row() const { return completion - 1 - row; }

    std::int32_t row;
    Tick start;
    Tick end;

    auto operator<=>(const Constraint&) const = default;
};

using SetId = std::int32_t;

// Two nodes of a constraint tree that constrain a robot alike have one set, in whatever order they
// got there, so that all that depends on a robot and its set is computed once.
class ConstraintSets {
  public:
    static constexpr SetId empty = 0;

    ConstraintSets() : sets_(1) {}

    std::span<const Constraint> at(SetId set) const { return sets_[index(set)]; }

    // The set with one more constraint.
    SetId with(SetId set, const Constraint& added);

  private:
    std::vector<std::vector<Constraint>> sets_;  // each in order
    std::unordered_multimap<std::uint64_t, SetId> known_;
};

}  // namespace rightofway
