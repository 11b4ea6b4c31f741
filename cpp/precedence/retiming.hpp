// The earliest times along the routes of a plan that keep its order of visits at every vertex.
#pragma once

#include "problem/problem.hpp"
#include "problem/tracks.hpp"

namespace rightofway {

// The longest paths of the precedence graph that the tracks describe, by one sweep over their
// visits. The tracks keep the rules; no visit becomes later.
void retime(const Problem& problem, Tracks& tracks);

}  // namespace rightofway
