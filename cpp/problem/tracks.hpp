// The visits of all robots, one robot behind the other.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct Tracks {
    std::vector<VisitId> first_visit;  // robot r owns first_visit[r] .. [r + 1] - 1
    std::vector<VertexId> vertex;
    std::vector<Tick> enter;
};

}  // namespace rightofway
