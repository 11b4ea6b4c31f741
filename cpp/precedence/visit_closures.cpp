#include "precedence/visit_closures.hpp"

#include "core/reject.hpp"

namespace rightofway {

VisitClosures::VisitClosures(const VisitClosureArrays& arrays, std::size_t n_visits)
    : first_(arrays.first.begin(), arrays.first.end()),
      drive_(arrays.drive.begin(), arrays.drive.end()) {
    if (arrays.first.empty()) {
        return;
    }
    require_length("first_closed", arrays.first.size(), 2 * n_visits + 1);
    require_length("closed_drive", arrays.drive.size(), n_visits);
    require_length("closed_until", arrays.until.size(), arrays.from.size());
    if (first_.front() != 0 || first_.back() != static_cast<std::int32_t>(arrays.from.size())) {
        reject_entry("first_closed", first_.size() - 1, first_.back(),
                     "does not end the lists of closures");
    }
    for (std::size_t k = 1; k < first_.size(); ++k) {
        if (first_[k] < first_[k - 1]) {
            reject_entry("first_closed", k, first_[k], "is less than the entry before");
        }
    }
    for (std::size_t k = 0; k < arrays.from.size(); ++k) {
        if (arrays.until[k] <= arrays.from[k] || arrays.until[k] > never) {
            reject_entry("closed_until", k, arrays.until[k], "is not after closed_from");
        }
        closed_.push_back({arrays.from[k], arrays.until[k]});
    }
}

Tick VisitClosures::free(std::int32_t list, Tick start, Tick end) const {
    for (std::int32_t k = first_[list]; k < first_[list + 1] && closed_[k].start < end; ++k) {
        if (closed_[k].end > start) {
            start = closed_[k].end;
        }
    }
    return start;
}

Tick VisitClosures::free_stay(VisitId visit, Tick start, Tick ticks) const {
    for (;;) {
        const Tick later = free_at(visit, start, start + ticks);
        if (later == start || later >= never) {
            return later;
        }
        start = later;
    }
}

Tick VisitClosures::free_along(VisitId visit, Tick start, Tick ticks) const {
    for (;;) {
        const Tick later = free(2 * visit + 1, start, start + ticks);
        if (later == start || later >= never) {
            return later;
        }
        start = later;
    }
}

}  // namespace rightofway
