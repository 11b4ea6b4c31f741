#include "precedence/booking_index.hpp"

#include <numeric>

namespace rightofway {

// Vertex ids are only compared, never used as positions: they may be as sparse as they like.
BookingIndex::BookingIndex(const Routes& routes)
    : group_(routes.n_visits()), slot_(routes.n_visits()) {
    std::vector<VisitId> order(routes.n_visits());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&routes](VisitId left, VisitId right) {
        return routes.vertex(left) < routes.vertex(right);
    });
    slots_.reserve(order.size());
    for (const VisitId x : order) {
        if (slots_.empty() || routes.vertex(slots_.back().visit) != routes.vertex(x)) {
            group_start_.push_back(slots_.size());
        }
        group_[x] = static_cast<std::int32_t>(group_start_.size() - 1);
        slot_[x] = static_cast<std::int32_t>(slots_.size());
        slots_.push_back({no_booking, x, routes.robot(x)});
    }
    group_start_.push_back(slots_.size());
}

std::int64_t BookingIndex::n_pairs() const {
    std::int64_t pairs = 0;
    for (std::size_t g = 1; g < group_start_.size(); ++g) {
        const auto size = static_cast<std::int64_t>(group_start_[g] - group_start_[g - 1]);
        pairs += size * (size - 1) / 2;
    }
    return pairs;
}

}  // namespace rightofway
