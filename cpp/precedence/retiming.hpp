// Retiming: the earliest times of a plan that keep its order of bookings.
#pragma once

#include "core/poll.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// Shifts each visit of the tracks to the earliest time that keeps the order of bookings that
// exclude each other. Precondition: no conflicts, no closures, and no stages of two robots that
// follow each other. No visit becomes later. Only an exception of `interrupt`, which is polled,
// ends it early.
void retime(const Problem& problem, Tracks& tracks, const StopCondition& interrupt = {});

}  // namespace rightofway
