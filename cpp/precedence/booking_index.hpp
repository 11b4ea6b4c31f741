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

    // The number of pairs of visits of different robots that share a vertex: a bound on the number
    // of conflicts.
    std::int64_t n_pairs() const;

    // Calls use(slot, tick, weight) for each booking of another robot that overlaps this visit's.
    template <class Use>
    void for_each_overlap(VisitId visit, Use&& use) const {
        const Booking own = slots_[slot_[visit]].booking;
        const auto look = [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t k = begin; k < end; ++k) {
                const Slot& other = slots_[k];
                if (const Tick weight = overlap(own, other.booking); weight > 0) {
                    use(other, std::max(own.start, other.booking.start), weight);
                }
            }
        };
        const Others& others = others_[visit];
        look(others.begin, others.own_begin);
        look(others.own_end, others.end);
    }

  private:
    // The slots at the vertex of a visit, and those among them of the same robot.
    struct Others {
        std::int32_t begin;
        std::int32_t own_begin;
        std::int32_t own_end;
        std::int32_t end;
    };

    std::vector<Slot> slots_;         // by vertex, then by visit, and so by robot
    std::vector<Others> others_;      // of each visit
    std::vector<std::int32_t> slot_;  // of each visit
};

}  // namespace rightofway
