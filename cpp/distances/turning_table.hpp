// The least ticks of a robot to its completion, alone on the roads, where turning takes time.
//
// One search per stage from its vertex over the reversed pairs of edges that follow each other:
// what is left of a trip depends on the heading, so a state is the edge driven in. The searches
// begin with the last stage; each starts with what the stages after it take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "distances/distance_tables.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class TurningTable {
  public:
    // Throws std::overflow_error if a least time does not fit int32.
    TurningTable(const Problem& problem, RobotId robot);

    // The least ticks to completion, -1 if no path exists: the robot has driven in along an edge
    // (-1: it starts at home), and `stage` is the first stage not served.
    Tick from(EdgeId edge, std::int32_t stage) const {
        return least_[index(stage) * n_places_ + index(edge + 1)];
    }

  private:
    std::size_t n_places_;             // the home, then the edges
    std::vector<std::int32_t> least_;  // stage * n_places_ + edge + 1
};

// The completion time of a robot that drives alone and turns in some time, by A* from its home.
// Needs the distances to the vertex of each stage; -1 if the robot cannot reach a stage.
Tick least_completion_with_turns(const Problem& problem, RobotId robot,
                                 std::span<const DistanceView> to_stage);

}  // namespace rightofway
