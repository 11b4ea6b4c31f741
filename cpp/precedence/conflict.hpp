// The two kinds of conflict.
//
// A vertex conflict is an overlap of two bookings of one vertex by different robots. A swap
// conflict is two robots exchanging two vertices at one instant without any such overlap.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "core/types.hpp"

namespace rightofway {

// What an overlap counts: its ticks, at most `conflict_cap`; 0 or less if there is none.
inline Tick overlap(const Booking& left, const Booking& right) {
    return std::min(std::min(left.end, right.end) - std::max(left.start, right.start),
                    conflict_cap);
}

// What a swap counts.
inline constexpr Tick swap_weight = 1;

enum class ConflictKind : std::int32_t { vertex = 0, swap = 1 };

// The member order is the order of conflicts: by time, then by robots, then by visits. For a swap,
// the visits are the two that are entered at that instant.
struct Conflict {
    Tick tick;
    RobotId robot_a;  // < robot_b
    RobotId robot_b;
    VisitId visit_a;
    VisitId visit_b;
    ConflictKind kind;

    auto operator<=>(const Conflict&) const = default;
};

}  // namespace rightofway
