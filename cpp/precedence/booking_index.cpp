#include "precedence/booking_index.hpp"

#include <numeric>

namespace rightofway {

// Vertex ids are only compared, never used as positions: they may be as sparse as they like.
BookingIndex::BookingIndex(const Routes& routes)
    : others_(routes.n_visits()), slot_(routes.n_visits()) {
    std::vector<VisitId> order(routes.n_visits());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&routes](VisitId left, VisitId right) {
        return routes.vertex(left) < routes.vertex(right);
    });
    slots_.reserve(order.size());
    for (const VisitId x : order) {
        slot_[x] = static_cast<std::int32_t>(slots_.size());
        slots_.push_back({no_booking, x, routes.robot(x)});
    }
    const auto n_slots = static_cast<std::int32_t>(slots_.size());
    for (std::int32_t begin = 0, end = 0; begin < n_slots; begin = end) {
        const VertexId vertex = routes.vertex(slots_[begin].visit);
        while (end < n_slots && routes.vertex(slots_[end].visit) == vertex) {
            ++end;
        }
        for (std::int32_t own = begin, own_end = begin; own < end; own = own_end) {
            while (own_end < end && slots_[own_end].robot == slots_[own].robot) {
                ++own_end;
            }
            for (std::int32_t k = own; k < own_end; ++k) {
                others_[slots_[k].visit] = {begin, own, own_end, end};
            }
        }
    }
}

std::int64_t BookingIndex::n_pairs() const {
    std::int64_t pairs = 0;
    for (const Others& others : others_) {
        pairs += others.end - others.own_end;  // each pair at its first visit
    }
    return pairs;
}

}  // namespace rightofway
