#include "execution/visit_works.hpp"

#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// whole * part / all, rounded down, for 0 <= part <= all < 2^31 without overflow; 0 for 0 / 0.
Tick scale(Tick whole, Tick part, Tick all) {
    return all == 0 ? 0 : whole / all * part + whole % all * part / all;
}

}  // namespace

VisitWorks::VisitWorks(const VisitWorkArrays& arrays, std::span<const Tick> dwell,
                       std::size_t n_robots)
    : first_work_(arrays.first_work.begin(), arrays.first_work.end()),
      ticks_(arrays.ticks.begin(), arrays.ticks.end()),
      earliest_(arrays.earliest.begin(), arrays.earliest.end()),
      planned_(arrays.planned.begin(), arrays.planned.end()),
      first_before_(arrays.first_before.begin(), arrays.first_before.end()),
      before_(arrays.before.begin(), arrays.before.end()),
      ends_with_work_(arrays.ends_with_work.begin(), arrays.ends_with_work.end()) {
    if (first_work_.empty()) {
        return;
    }
    require_length("first_work", first_work_.size(), dwell.size() + 1);
    require_lists("first_work", first_work_, ticks_.size(), "works");
    require_length("earliest", earliest_.size(), ticks_.size());
    require_length("planned", planned_.size(), ticks_.size());
    require_length("first_before", first_before_.size(), ticks_.size() + 1);
    require_lists("first_before", first_before_, before_.size(), "works");
    require_ids("before", before_, n_works());
    require_length("ends_with_work", ends_with_work_.size(), n_robots);
    require_ranges("ticks", std::span<const Tick>(ticks_), 0, never - 1);
    require_ranges("earliest", std::span<const Tick>(earliest_), 0, never - 1);
    require_ranges("planned", std::span<const Tick>(planned_), 0, never - 1);
    visit_.resize(ticks_.size());
    until_.resize(ticks_.size());
    for (std::size_t x = 0; x < dwell.size(); ++x) {
        Tick left = dwell[x];
        for (auto k = index(first_work_[x]); k < index(first_work_[x + 1]); ++k) {
            if (ticks_[k] > left) {
                reject_entry("ticks", k, ticks_[k], "is more than is left of its visit");
            }
            left -= ticks_[k];
            visit_[k] = static_cast<VisitId>(x);
            until_[k] = dwell[x] - left;
        }
    }
}

Tick VisitWorks::sum(VisitId visit) const {
    return first_of(visit) == end_of(visit) ? 0 : until_[index(end_of(visit) - 1)];
}

Tick VisitWorks::share(WorkId work, Tick dwell, Tick real) const {
    const Tick until = until_[index(work)];
    return scale(real, until, dwell) - scale(real, until - ticks(work), dwell);
}

}  // namespace rightofway
