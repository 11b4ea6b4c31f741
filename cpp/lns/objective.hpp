// Comparison of plans of a fleet: the objective, and the worth of a plan under it.
#pragma once

#include <compare>

#include "core/types.hpp"

namespace rightofway {

// The weighted flowtime with surcharges; the makespan, and the flowtime on ties; or, for each unit
// of weight, the makespan and the completion time of the robot. A makespan has no surcharges.
enum class Objective { flowtime, makespan, both };

// Less is better, the first number first. Plans of equal makespan are not alike: with fewer robots
// that complete last, one is nearer to an earlier makespan.
struct Worth {
    Tick value = 0;   // of the objective
    Tick n_last = 0;  // the number of robots that complete last; 0 for the flowtime
    Tick cost = 0;    // the weighted flowtime with surcharges

    friend auto operator<=>(const Worth&, const Worth&) = default;
};

}  // namespace rightofway
