// What soft intervals add to SIPP (MAPF-LNS2): a track may overlap bookings and pays for them.
#include <algorithm>

#include "search/rotations.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// Stays past the start of the next booking and pays its price.
void SafeIntervalSearch::stay_on(std::int32_t node) {
    SearchNode after = states_[node];
    const auto here = at(after.vertex);
    if (index(after.gap) == here.size()) {
        return;
    }
    const BookedBy& next = here[index(after.gap)];
    after.cost += price(next.robot);
    if (after.cost >= never) {
        return;
    }
    after.ready = std::max(after.ready, next.time.start - rules_.headway);
    ++after.gap;
    after.parent = node;
    after.drive = 0;
    reach(after, rest(after));
}

// Enters as early as possible and at each end of a booking, and pays for the bookings that have not
// ended.
void SafeIntervalSearch::drive_across(const SearchNode& soonest, Tick way, Tick latest,
                                      Tick approach, std::span<const BookedBy> along) {
    const auto to = at(soonest.vertex);
    const auto enter = [&](Tick tick, bool to_stay) {
        SearchNode candidate = soonest;
        candidate.ready = tick;
        candidate.gap = BookingTable::started(to, tick + rules_.headway);
        candidate.cost += price_of_entry(candidate, approach);
        if (candidate.cost < never) {
            candidate.cost += price_of_swaps(candidate);
        }
        if (candidate.cost < never) {
            candidate.cost += price_of_drive(along, tick, candidate.drive);
        }
        if (to_stay) {
            for (auto k = index(candidate.gap); k < to.size() && candidate.cost < never; ++k) {
                candidate.cost += price(to[k].robot);
            }
            candidate.gap = static_cast<std::int32_t>(to.size()) + 1;
        }
        if (candidate.cost < never) {
            reach(candidate, way);
        }
    };
    const Tick stays =
        !may_stay_at_once() && is_at_end(soonest) ? earliest_stay(soonest, approach) : never;
    const auto enter_at = [&](Tick tick) {
        enter(tick, false);
        if (tick >= stays) {
            enter(tick, true);
        }
    };
    enter_at(soonest.ready);
    if (stays > soonest.ready && stays <= latest) {
        enter(stays, true);
    }
    const auto first = std::partition_point(to.begin(), to.end(), [&](const BookedBy& one) {
        return one.reach + approach <= soonest.ready;
    });
    for (auto one = first; one != to.end() && one->time.start + approach < latest; ++one) {
        const Tick tick = one->time.end + approach;
        if (one->time.end < never && tick > soonest.ready && tick <= latest) {
            enter_at(tick);
        }
    }
    for (const BookedBy& one : along) {
        const Tick tick = one.time.end + soonest.drive;
        if (one.time.end < never && tick > soonest.ready && tick <= latest) {
            enter_at(tick);
        }
    }
}

// The price of the bookings of an edge that overlap a drive.
Tick SafeIntervalSearch::price_of_drive(std::span<const BookedBy> along, Tick tick,
                                        Tick drive) const {
    const auto n_started = BookingTable::started(along, tick + rules_.headway - 1);
    return price_of_all(along.first(index(n_started)), tick - drive);
}

// The price of the bookings that have not ended at the enter, or begin before the headway is over.
Tick SafeIntervalSearch::price_of_entry(const SearchNode& candidate, Tick approach) const {
    const auto started = at(candidate.vertex).first(index(candidate.gap));
    return price_of_all(started, candidate.ready - approach);
}

// The price of those bookings that end after `start`.
Tick SafeIntervalSearch::price_of_all(std::span<const BookedBy> bookings, Tick start) const {
    Tick sum = 0;
    BookingTable::any_ending_after(bookings, start, [&](const BookedBy& one) {
        sum += price(one.robot);
        return sum >= never;
    });
    return std::min(sum, never);
}

// The price of swap conflicts: a robot leaves the head of the edge and enters its tail at this
// instant. Where rotations are forbidden, several robots may do so in a chain.
Tick SafeIntervalSearch::price_of_swaps_at(const SearchNode& candidate) const {
    const SearchNode& before = states_[candidate.parent];
    const auto from = at(before.vertex);
    const auto to = at(candidate.vertex);
    Tick sum = 0;
    for (auto j = index(before.gap); j < from.size() && from[j].time.start == candidate.ready;
         ++j) {
        for (std::int32_t k = candidate.gap; k > 0 && to[index(k - 1)].reach >= candidate.ready;
             --k) {
            if (to[index(k - 1)].time.end == candidate.ready &&
                to[index(k - 1)].robot == from[j].robot && from[j].robot != nobody) {
                sum += price(from[j].robot);
            }
        }
    }
    const bool is_entered =
        index(before.gap) < from.size() && from[index(before.gap)].time.start == candidate.ready;
    if (!rules_.rotations && is_entered && sum == 0) {
        const RobotId ahead =
            find_rotation_ahead(roads_.graph, *bookings_, trip_->first_row,
                                {before.vertex, candidate.vertex, candidate.ready});
        sum = ahead == nobody ? 0 : price(ahead);
    }
    return std::min(sum, never);
}

}  // namespace rightofway
