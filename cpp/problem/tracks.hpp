// Where robots are, when.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// One visit of a track. The next visit's `enter` is when it ends.
struct Visit {
    Tick enter;
    VertexId vertex;
    std::int32_t drive;  // ticks of the edge driven in; 0 for the first visit
};

// The visits of all robots, one robot behind the other.
struct Tracks {
    std::vector<VisitId> first_visit;  // robot r owns first_visit[r] .. [r + 1] - 1
    std::vector<VertexId> vertex;
    std::vector<Tick> enter;
};

}  // namespace rightofway
