// The two kinds of conflict.
//
// Vertex conflict: bookings of one vertex by two robots overlap. Swap conflict: two robots exchange
// two vertices at one instant, and no bookings overlap.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "core/types.hpp"

namespace rightofway {

// Weight of a vertex conflict: ticks of overlap, at most `conflict_cap`; <= 0: no overlap.
inline Tick overlap(const Booking& left, const Booking& right) {
    return std::min(std::min(left.end, right.end) - std::max(left.start, right.start),
                    conflict_cap);
}

// Weight of a swap conflict.
inline constexpr Tick swap_weight = 1;

enum class ConflictKind : std::int32_t { vertex = 0, swap = 1 };

// Conflicts are ordered by member: time, robots, visits. The visits of a swap are the two visits
// that begin at its instant.
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
