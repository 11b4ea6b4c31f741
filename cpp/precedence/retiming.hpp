// The earliest times along the routes of a plan that keep its order of visits at every vertex.
//
// The longest paths of the precedence graph (timetable.hpp), for a plan whose times say in which
// order to go through its visits: one sweep in that order does it, in place. Visits that begin at
// one instant may wait for each other round a circle; they are gone through until nothing changes.
#pragma once

#include "lns/fleet_plan.hpp"
#include "problem/tracks.hpp"
#include "problem/trips.hpp"

namespace rightofway {

// The tracks keep the rules; afterwards nobody is later.
void retime(const Trips& trips, Tracks& tracks);

// The same for a plan in which every robot has a track.
void retime(const Problem& fleet, FleetPlan& plan);

}  // namespace rightofway
