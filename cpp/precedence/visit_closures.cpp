#include "precedence/visit_closures.hpp"

#include "core/reject.hpp"

namespace rightofway {
namespace {

// As far below `never` as the times of routes.
constexpr Tick longest_drive = Tick{1} << 60;

// No closure begins at `never`.
Tick end_of(Tick start, Tick ticks) { return ticks >= never - start ? never : start + ticks; }

}  // namespace

VisitClosures::VisitClosures(const VisitClosureArrays& arrays, std::size_t n_visits)
    : first_(arrays.first.begin(), arrays.first.end()),
      drive_(arrays.drive.begin(), arrays.drive.end()) {
    if (arrays.first.empty()) {
        require_length("closed_from", arrays.from.size(), 0);
        require_length("closed_until", arrays.until.size(), 0);
        return;
    }
    require_length("first_closed", arrays.first.size(), 2 * n_visits + 1);
    require_length("drive", arrays.drive.size(), n_visits);
    require_ranges("drive", arrays.drive, 0, longest_drive);
    require_length("closed_until", arrays.until.size(), arrays.from.size());
    require_lists("first_closed", first_, arrays.from.size(), "closures");
    require_ranges("closed_from", arrays.from, 0, never);
    for (std::size_t k = 0; k < arrays.from.size(); ++k) {
        if (arrays.until[k] <= arrays.from[k] || arrays.until[k] > never) {
            reject_entry("closed_until", k, arrays.until[k], "is not after closed_from");
        }
        closed_.push_back({arrays.from[k], arrays.until[k]});
    }
    for (std::size_t list = 0; list + 1 < first_.size(); ++list) {
        for (auto k = index(first_[list]) + 1; k < index(first_[list + 1]); ++k) {
            if (arrays.from[k] < arrays.until[k - 1]) {
                reject_entry("closed_from", k, arrays.from[k],
                             "is before the end of the closure before it");
            }
        }
    }
}

Tick VisitClosures::free(std::int32_t list, Tick start, Tick end) const {
    for (std::int32_t k = first_[index(list)];
         k < first_[index(list + 1)] && closed_[index(k)].start < end; ++k) {
        if (closed_[index(k)].end > start) {
            start = closed_[index(k)].end;
        }
    }
    return start;
}

Tick VisitClosures::free_stay(VisitId visit, Tick start, Tick ticks) const {
    for (;;) {
        const Tick later = free_at(visit, start, end_of(start, ticks));
        if (later == start || later >= never) {
            return later;
        }
        start = later;
    }
}

Tick VisitClosures::free_along(VisitId visit, Tick start, Tick ticks) const {
    for (;;) {
        const Tick later = free(2 * visit + 1, start, end_of(start, ticks));
        if (later == start || later >= never) {
            return later;
        }
        start = later;
    }
}

}  // namespace rightofway
