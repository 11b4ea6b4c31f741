// Planning robots in turn, patiently; and in haste at the same time, in case that takes too long.
//
// The patient plan is the better one, but where the floor is full its searches go a long way before
// they take a track away. The plan made in haste is a net: it is used only if the patient one
// fails, so what comes out does not depend on threads unless time runs out. With it, patience may
// last longer.
#pragma once

#include <cstdint>
#include <span>

#include "rightofway/fleet_plan.hpp"
#include "rightofway/prioritized.hpp"

namespace rightofway {

class InTurn {
  public:
    // Borrows both. The plan is without tracks.
    InTurn(const Fleet& fleet, FleetPlan& plan, std::span<const RobotId> order);

    // Gives all robots a track each, in at most so many searches since the beginning. False if that
    // does not work out, with the plan in an unknown state; it can go on from there. Once there is
    // a plan made in haste, `is_late` is asked instead of `is_over`; both by the calling thread.
    bool run(std::int64_t n_searches, bool has_second_thread,
             const SafeIntervalSearch::IsOver& is_over, const SafeIntervalSearch::IsOver& is_late);

  private:
    bool take(SearchEnd second);

    FleetPlan& plan_;
    FleetPlan plan_in_haste_;
    Prioritized patient_;
    Prioritized hasty_;
};

}  // namespace rightofway
