// Who else books this vertex? All visits, grouped by vertex, each with its present booking.
//
// Routes are fixed, so the groups are made once and only the bookings in them change. A group lies
// in one piece of memory: looking at all bookings of a vertex is one short walk.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/routes.hpp"

namespace rightofway {

class BookingIndex {
  public:
    struct Slot {
        Booking booking;
        VisitId visit;
        RobotId robot;
    };

    // At first nothing is booked.
    explicit BookingIndex(const Routes& routes);

    void set(VisitId visit, const Booking& booking) { slots_[slot_[visit]].booking = booking; }
    const Booking& booking(VisitId visit) const { return slots_[slot_[visit]].booking; }

    // The number of pairs of visits that share a vertex: a bound on the conflicts there can be.
    std::int64_t n_pairs() const;

    // Calls use(slot, tick, weight) for each booking of another robot that overlaps this visit's.
    template <class Use>
    void for_each_overlap(VisitId visit, Use&& use) const {
        const Slot& own = slots_[slot_[visit]];
        const std::size_t end = group_start_[group_[visit] + 1];
        for (std::size_t k = group_start_[group_[visit]]; k < end; ++k) {
            const Slot& other = slots_[k];
            const Tick weight = overlap(own.booking, other.booking);
            if (weight > 0 && other.robot != own.robot) {
                use(other, std::max(own.booking.start, other.booking.start), weight);
            }
        }
    }

  private:
    std::vector<Slot> slots_;  // by vertex, then by visit
    std::vector<std::size_t> group_start_;
    std::vector<std::int32_t> group_;  // of each visit
    std::vector<std::int32_t> slot_;   // of each visit
};

}  // namespace rightofway
