// Techniques that accelerate conflict-based search; each can be switched off.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace rightofway {

// Defaults are those of rightofway.search.ConflictBasedSearch.
struct CbsOptions {
    bool cardinal;  // resolve conflicts first that cost both robots something
    bool bypass;    // replace tracks by others of equal cost with fewer conflicts
    bool clear;     // look for tracks with the fewest conflicts
    bool targets;   // resolve conflicts with robots that have reached their ends as such
    bool disjoint;  // one child of a conflict holds a robot to its row, the other keeps it away
    bool pairs;     // split by completion times of pairs that lose to each other
    // Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: no
    // such losses.
    std::int64_t pair_nodes;
    // Joint states at most, and again for each fifty nodes, for all pairs that need more nodes; and
    // for each fifty nodes for a whole fleet of few robots. 0: no such search.
    std::int64_t joint_states;
    // A plan that costs at most this factor times the bound is enough [millionths].
    std::int64_t factor;
    Tick latest;  // no robot completes later
};

}  // namespace rightofway
