// The quantities of the core and their few special values.
//
// Everything that crosses the binding is an int32 identifier or an int64 tick, so these are plain
// aliases: they say in a signature which of the three numberings (vertices, robots, visits) is
// meant, and arrays of them cross without a copy.
#pragma once

#include <cstdint>

namespace rightofway {

using VertexId = std::int32_t;
using EdgeId = std::int32_t;
using RobotId = std::int32_t;
using VisitId = std::int32_t;  // position in the concatenation of all robots' routes
using Tick = std::int64_t;     // the integer unit of time

inline constexpr std::int32_t none = -1;  // no index, of whatever numbering
inline constexpr RobotId nobody = -1;

// The tick of what never happens, such as the leave of a last visit. Far above every tick that a
// plan may reach (routes.hpp checks that), and far enough below the type's end to add to.
inline constexpr Tick never = Tick{1} << 62;

// The most ticks that one conflict adds to the count of conflicts. Two robots that stay at one
// vertex for ever overlap without end; the cap keeps every sum of conflicts finite.
inline constexpr Tick conflict_cap = Tick{1} << 32;

// One vertex for the half-open interval [start, end) of time.
struct Booking {
    Tick start = never;
    Tick end = never;

    bool is_empty() const { return start >= end; }
};

// A booking that overlaps nothing, not even one without end.
inline constexpr Booking no_booking{};

}  // namespace rightofway
