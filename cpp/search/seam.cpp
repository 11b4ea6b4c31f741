#include "search/seam.hpp"

#include <algorithm>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick latest_tick = Tick{1} << 50;

void require_stretch(const Seam::Stretch& stretch, VertexId n_vertices) {
    require_length("dwell", stretch.dwell.size(), stretch.vertex.size());
    require_length("drive", stretch.drive.size(), stretch.vertex.size());
    for (std::size_t k = 0; k < stretch.vertex.size(); ++k) {
        require_id("vertex[" + std::to_string(k) + "]", stretch.vertex[k], n_vertices);
        if (stretch.dwell[k] < 0 || stretch.dwell[k] > latest_tick) {
            reject_entry("dwell", k, stretch.dwell[k], "is negative or too long");
        }
        if (stretch.drive[k] <= 0 || stretch.drive[k] > latest_tick) {
            reject_entry("drive", k, stretch.drive[k], "is not above 0, or too long");
        }
    }
}

}  // namespace

Seam::Seam(VertexId n_vertices, Tick headway, bool books_ahead)
    : headway_(headway), books_ahead_(books_ahead) {
    if (n_vertices < 0) {
        reject("n_vertices", n_vertices, "is negative");
    }
    if (headway < 0 || headway > latest_tick) {
        reject("headway", headway, "is negative or too long");
    }
    at_.resize(static_cast<std::size_t>(n_vertices));
}

void Seam::add(RobotId robot, const Stretch& stretch, std::span<const Tick> enter, Tick leave) {
    require_stretch(stretch, n_vertices());
    require_length("enter", enter.size(), stretch.vertex.size());
    for (std::size_t k = 0; k < enter.size(); ++k) {
        if ((k + 1 < enter.size() ? enter[k + 1] : leave) <= enter[k]) {
            reject_entry("enter", k, enter[k], "is not before the next");
        }
    }
    for (std::size_t k = 0; k < enter.size(); ++k) {
        const Tick end = (k + 1 < enter.size() ? enter[k + 1] : leave) + headway_;
        const Booking booking{enter[k] - approach(stretch, k), end, robot};
        auto& row = at_[static_cast<std::size_t>(stretch.vertex[k])];
        row.insert(std::upper_bound(row.begin(), row.end(), booking, is_earlier), booking);
    }
}

void Seam::remove(RobotId robot, std::span<const VertexId> vertices) {
    for (const VertexId vertex : vertices) {
        require_id("vertex", vertex, n_vertices());
        std::erase_if(at_[static_cast<std::size_t>(vertex)],
                      [robot](const Booking& one) { return one.robot == robot; });
    }
}

bool Seam::is_earlier(const Booking& left, const Booking& right) {
    return left.start != right.start ? left.start < right.start : left.robot < right.robot;
}

// Calls use(gap) for each gap that begins no later than `to` and ends after `from`, in order, until
// it returns false. Where bookings of others overlap there is none.
template <class Use>
void Seam::for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const {
    const auto& row = at_[static_cast<std::size_t>(vertex)];
    auto next = std::lower_bound(row.begin(), row.end(), from,
                                 [](const Booking& one, Tick tick) { return one.start < tick; });
    for (;; ++next) {
        const Tick start = next == row.begin() ? -never : std::prev(next)->end;
        const RobotId before = next == row.begin() ? nobody : std::prev(next)->robot;
        if (start > to) {
            return;
        }
        const Tick end = next == row.end() ? never : next->start;
        const RobotId after = next == row.end() ? nobody : next->robot;
        if ((start <= end && !use(Gap{start, end, before, after})) || next == row.end()) {
            return;
        }
    }
}

Tick Seam::enters(const Gap& here, const Gap& there, Tick soonest, Tick last, Tick approach) const {
    const Tick enter = there.start == -never ? soonest : std::max(soonest, there.start + approach);
    const bool fits = there.end == never || enter + headway_ < there.end;
    const bool swaps = headway_ == 0 && approach == 0 && there.start == enter &&
                       here.end == enter && there.before == here.after;
    return enter <= last && fits && !swaps ? enter : never;
}

bool Seam::connect(const Stretch& stretch, Tick from, Tick until, Tick leave,
                   std::vector<Tick>& enter) {
    require_stretch(stretch, n_vertices());
    const std::size_t n = stretch.vertex.size();
    if (n == 0) {
        reject("vertex", 0, "visits are too few");
    }
    rest_.assign(n, 0);
    for (std::size_t k = n - 1; k-- > 0;) {
        rest_[k] = rest_[k + 1] + stretch.dwell[k] + stretch.drive[k + 1];
    }
    stays_.resize(std::max(stays_.size(), n));
    for (std::size_t k = 0; k < n; ++k) {
        stays_[k].clear();
    }
    reached_ = 0;
    const Tick start = from - approach(stretch, 0);
    for_each_gap(stretch.vertex[0], start, start, [&](const Gap& gap) {
        if (gap.start <= start && from + headway_ < gap.end) {
            stays_[0].push_back({from, gap, nobody});
        }
        return true;
    });
    for (std::size_t k = 0; k + 1 < n && !stays_[k].empty(); ++k) {
        reached_ = k;
        for (std::size_t one = 0; one < stays_[k].size(); ++one) {
            go_on(stretch, k, static_cast<std::int32_t>(one), until);
        }
    }
    const auto& last = stays_[n - 1];
    const auto found = std::find_if(last.begin(), last.end(), [&](const Stay& stay) {
        return stay.enter <= until && (stay.gap.end == never || leave + headway_ <= stay.gap.end);
    });
    if (found == last.end()) {
        return false;
    }
    enter.resize(n);
    auto stay = static_cast<std::int32_t>(found - last.begin());
    for (std::size_t k = n; k-- > 0;) {
        const Stay& one = stays_[k][static_cast<std::size_t>(stay)];
        enter[k] = one.enter;
        stay = one.from;
    }
    return true;
}

// Drives from a stay into every gap of the next vertex that it can enter.
void Seam::go_on(const Stretch& stretch, std::size_t k, std::int32_t from, Tick latest) {
    const Stay here = stays_[k][static_cast<std::size_t>(from)];
    const Tick soonest = here.enter + stretch.dwell[k] + stretch.drive[k + 1];
    const Tick last =
        std::min(here.gap.end == never ? never : here.gap.end - headway_, latest - rest_[k + 1]);
    if (soonest > last) {
        return;
    }
    const Tick ahead = approach(stretch, k + 1);
    for_each_gap(stretch.vertex[k + 1], soonest - ahead, last - ahead, [&](const Gap& gap) {
        const Tick enter = enters(here.gap, gap, soonest, last, ahead);
        if (enter < never) {
            arrive(k + 1, {enter, gap, from});
        }
        return true;
    });
}

void Seam::arrive(std::size_t k, const Stay& stay) {
    for (Stay& known : stays_[k]) {
        if (known.gap.start == stay.gap.start && known.gap.end == stay.gap.end) {
            if (stay.enter < known.enter) {
                known = stay;
            }
            return;
        }
    }
    stays_[k].push_back(stay);
}

std::vector<RobotId> Seam::users(VertexId vertex, Tick from, Tick to) const {
    require_id("vertex", vertex, n_vertices());
    std::vector<RobotId> found;
    for (const Booking& one : at_[static_cast<std::size_t>(vertex)]) {
        if (one.start < to && from < one.end) {
            found.push_back(one.robot);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace rightofway
