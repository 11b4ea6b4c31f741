// Charge that drives take: on the quickest ways to a place, and at least to one of several.
//
// Energies are whole numbers; sums end at a given most, because no battery has more.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reverse_graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// The energy of a quickest way from every vertex, the least of those: `ticks_to` are the least
// ticks
// (-1: no way, which takes `most`), `edge_ticks` those of each edge.
std::vector<std::int64_t> find_energies_of_quickest_ways(const ReverseGraph& graph,
                                                         std::span<const std::int32_t> ticks_to,
                                                         std::span<const std::int32_t> edge_ticks,
                                                         std::span<const std::int64_t> edge_energy,
                                                         std::int64_t most);

// The least energy from every vertex to one of the targets, at most `most`, also without a way.
// Edges of energy -1 are barred.
std::vector<std::int64_t> find_least_energies(const ReverseGraph& graph,
                                              std::span<const VertexId> targets,
                                              std::span<const std::int64_t> edge_energy,
                                              std::int64_t most);

}  // namespace rightofway
