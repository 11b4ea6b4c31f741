// Overlapping bookings of different robots at one vertex, of bookings in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"

namespace rightofway {

// Bookings by vertex, then by start. Borrowed.
struct BookingColumns {
    std::span<const VertexId> vertex;
    std::span<const Tick> start;
    std::span<const Tick> end;
    std::span<const RobotId> robot;
};

// Pairs of bookings; the later one of each pair starts not before the earlier one.
struct Overlaps {
    std::vector<std::int32_t> earlier;
    std::vector<std::int32_t> later;
    SearchEnd end = SearchEnd::found;  // `stopped`: the pairs are not all
};

// Finds all pairs by one sweep, which keeps the bookings of a vertex that have not ended. Ends
// `stopped` after `most` pairs, or when the condition holds. Throws std::invalid_argument if the
// columns do not fit together or the order is another one.
Overlaps find_overlaps(const BookingColumns& bookings, std::size_t most,
                       const StopCondition& is_over);

}  // namespace rightofway
