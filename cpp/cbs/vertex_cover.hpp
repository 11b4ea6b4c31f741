// Weighted vertex cover: the least sum of numbers, one at each robot, of which each pair of robots
// has at least the weight of its edge.
//
// Li, Felner, Boyarski, Ma & Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019.
#pragma once

#include <cstddef>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct WeightedPair {
    std::size_t first;
    std::size_t second;
    Tick weight;
};

// A lower bound of the least sum for nodes 0 .. n_nodes - 1; the least sum itself where few nodes
// hang together.
Tick cover(std::size_t n_nodes, std::vector<WeightedPair> pairs);

}  // namespace rightofway
