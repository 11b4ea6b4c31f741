// Planning robots in turn, patiently; and in haste at the same time, in case that takes too long.
//
// The patient plan is the better one, but where the floor is full its searches go a long way before
// they take a track away. The plan made in haste is used only if the patient one fails, so what
// comes out does not depend on threads unless time runs out.
#pragma once

#include <cstdint>
#include <span>

#include "rightofway/fleet_plan.hpp"
#include "rightofway/safe_interval_search.hpp"

namespace rightofway {

// Gives all robots of a plan without tracks one each, in at most so many searches; false, with the
// plan in an unknown state, if that does not work out. `is_over` is asked by the calling thread.
bool plan_in_turn(const Fleet& fleet, FleetPlan& plan, std::span<const RobotId> order,
                  std::int64_t n_searches, bool has_second_thread,
                  const SafeIntervalSearch::IsOver& is_over);

}  // namespace rightofway
