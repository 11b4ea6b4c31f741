// Who comes the other way? All moves that can be half of a swap, grouped by the pair of vertices.
//
// A move is named by the visit it enters. Two moves over the same two vertices in opposite
// directions at one instant are a swap. Like bookings, groups are fixed and only instants change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/routes.hpp"

namespace rightofway {

class MoveIndex {
  public:
    struct Slot {
        Tick instant;
        VisitId visit;
        RobotId robot;
    };

    // At first nobody moves. Visits that cannot be half of a swap have no place here at all.
    explicit MoveIndex(const Routes& routes);

    void set(VisitId visit, Tick instant) {
        if (slot_[visit] != none) {
            slots_[slot_[visit]].instant = instant;
        }
    }
    void clear(VisitId visit) { set(visit, never); }

    // Calls use(slot, tick, weight) for each move of another robot that swaps with this one.
    template <class Use>
    void for_each_swap(VisitId visit, Use&& use) const {
        if (slot_[visit] == none) {
            return;
        }
        const Tick instant = slots_[slot_[visit]].instant;
        const auto look = [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t k = begin; k < end; ++k) {
                if (slots_[k].instant == instant && instant != never) {
                    use(slots_[k], instant, swap_weight);
                }
            }
        };
        const Opposite& opposite = opposite_[slot_[visit]];
        look(opposite.begin, opposite.own_begin);
        look(opposite.own_end, opposite.end);
    }

  private:
    // The moves (to, from) of all robots, and those among them of the same robot.
    struct Opposite {
        std::int32_t begin;
        std::int32_t own_begin;
        std::int32_t own_end;
        std::int32_t end;
    };

    std::vector<Slot> slots_;         // by (from, to), then by visit, and so by robot
    std::vector<Opposite> opposite_;  // of each slot
    std::vector<std::int32_t> slot_;  // of each visit
};

}  // namespace rightofway
