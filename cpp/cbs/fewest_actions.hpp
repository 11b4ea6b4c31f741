// Of the plans that cost as little as a plan that is given, one in which robots wait and drive less
// often.
//
// Of a few robots, all joint states tell the fewest actions. Of more, one robot after the other
// that waits looks for a track with fewer of them among the bookings of all others, until nobody
// has one.
#pragma once

#include <cstdint>
#include <span>

#include "core/search_end.hpp"
#include "core/types.hpp"
#include "distances/shared_distances.hpp"
#include "lns/fleet_plan.hpp"

namespace rightofway {

// Changes the tracks of a plan that keeps the rules. `waits` has how often each robot waits. No
// robot completes after `latest`. Each search stops after `most_states` states. Whether it is
// proven that no plan of no higher cost has fewer actions. Where it is stopped, the plan is as good
// as it has got.
bool take_fewest_actions(SharedDistances& distances, FleetPlan& plan, std::span<Tick> waits,
                         Tick latest, std::int64_t most_states, const StopCondition& is_over);

}  // namespace rightofway
