// What makes conflict-based search fast, each part to be switched.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace rightofway {

struct CbsOptions {
    bool cardinal = true;  // resolve conflicts first that cost both robots something
    bool bypass = true;    // replace tracks by others of equal cost with fewer conflicts
    bool clear = true;     // look for tracks with the fewest conflicts
    bool targets = true;   // resolve conflicts with robots that have reached their ends as such
    bool pairs = true;     // split by completion times of pairs that lose to each other
    // Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: no
    // such losses.
    std::int64_t pair_nodes = 20;
    // Joint states at most to solve a pair that needs more nodes, and so many for each fifty nodes
    // to solve a whole fleet of few robots; 0: no such search.
    std::int64_t joint_states = 10'000;
    // A plan that costs at most this factor times the bound is enough [millionths].
    std::int64_t factor = 1'000'000;
    Tick latest = never;  // no robot completes later
};

}  // namespace rightofway
