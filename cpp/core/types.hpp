// The integer types of the core (ids and ticks) and their special values.
//
// Plain aliases of int32 (ids) and int64 (ticks), so arrays cross the binding without a copy. The
// alias names the numbering in a signature: vertices, edges, robots or visits.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace rightofway {

using VertexId = std::int32_t;
using EdgeId = std::int32_t;
using RobotId = std::int32_t;
using VisitId = std::int32_t;  // index into the concatenated routes of all robots
using Tick = std::int64_t;     // integer unit of time

inline constexpr std::int32_t none = -1;  // no index, in any numbering
inline constexpr RobotId nobody = -1;

// The place of an id in an array. Checks nothing: the id is not negative.
constexpr std::size_t index(std::signed_integral auto id) { return static_cast<std::size_t>(id); }

inline constexpr std::int32_t barred = -1;  // the pace of a robot that may not drive an edge

// The tick of an event that never happens; example: the leave of a last visit. Far above every tick
// of a plan (routes.hpp checks this), and small enough to add ticks without overflow.
inline constexpr Tick never = Tick{1} << 62;

// The most ticks that one conflict adds to the count of conflicts. Two robots that stay at one
// vertex for ever overlap without end; the cap keeps each sum finite.
inline constexpr Tick conflict_cap = Tick{1} << 32;

// The half-open interval [start, end) for which a robot books a vertex [ticks].
struct Booking {
    Tick start = never;
    Tick end = never;

    bool is_empty() const { return start >= end; }
    bool operator==(const Booking&) const = default;
};

// A booking that overlaps nothing, not even one without end.
inline constexpr Booking no_booking{};

}  // namespace rightofway
