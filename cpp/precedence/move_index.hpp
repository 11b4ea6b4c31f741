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
        const Slot& own = slots_[slot_[visit]];
        const Range& range = opposite_[slot_[visit]];
        for (std::size_t k = range.start; k < range.end; ++k) {
            const Slot& other = slots_[k];
            if (other.instant == own.instant && own.instant != never && other.robot != own.robot) {
                use(other, own.instant, swap_weight);
            }
        }
    }

  private:
    struct Range {
        std::size_t start;
        std::size_t end;
    };

    std::vector<Slot> slots_;         // by (from, to), then by visit
    std::vector<Range> opposite_;     // per slot: the moves (to, from)
    std::vector<std::int32_t> slot_;  // of each visit
};

}  // namespace rightofway
