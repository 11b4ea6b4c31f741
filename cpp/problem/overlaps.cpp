#include "problem/overlaps.hpp"

#include <algorithm>

#include "core/graph.hpp"
#include "core/poll.hpp"
#include "core/reject.hpp"

namespace rightofway {

Overlaps find_overlaps(const BookingColumns& bookings, std::size_t most,
                       const StopCondition& is_over) {
    const auto& [vertex, start, end, robot] = bookings;
    require_range("bookings", static_cast<std::int64_t>(vertex.size()), 0, INT32_MAX);
    require_length("start", start.size(), vertex.size());
    require_length("end", end.size(), vertex.size());
    require_length("robot", robot.size(), vertex.size());
    Overlaps found;
    std::vector<std::int32_t> open;  // bookings of the vertex that have not ended
    Poll poll(is_over);
    for (std::size_t k = 0; k < vertex.size(); ++k) {
        if (k > 0 && vertex[k] == vertex[k - 1]) {
            if (start[k] < start[k - 1]) {
                reject_entry("start", k, start[k], "is before the booking in front of it");
            }
            std::erase_if(open, [&](std::int32_t b) { return end[index(b)] <= start[k]; });
        } else {
            open.clear();
        }
        if (poll() || found.earlier.size() + open.size() > most) {
            found.end = SearchEnd::stopped;
            return found;
        }
        for (const std::int32_t earlier : open) {
            if (robot[index(earlier)] != robot[k]) {
                found.earlier.push_back(earlier);
                found.later.push_back(static_cast<std::int32_t>(k));
            }
        }
        open.push_back(static_cast<std::int32_t>(k));
    }
    return found;
}

}  // namespace rightofway
