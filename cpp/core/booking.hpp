// A booking: one vertex for the half-open interval [start, end) of time.
#pragma once

#include "core/types.hpp"

namespace rightofway {

struct Booking {
    Tick start = never;
    Tick end = never;

    bool is_empty() const { return start >= end; }
};

// A booking that overlaps nothing, not even one without end.
inline constexpr Booking no_booking{};

}  // namespace rightofway
