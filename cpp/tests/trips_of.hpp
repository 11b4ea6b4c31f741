// Fleets with clocks for tests: roads, trips and the arrays that Trips borrows.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "corridors.hpp"
#include "problem/trips.hpp"

namespace rightofway::test {

struct Stage {
    VertexId vertex;
    Tick dwell = 0;
};

struct Robot {
    VertexId home;
    std::vector<Stage> stages;
    std::int32_t edge_ticks = 1;
};

// Every edge has the same length.
struct ClockedFleet {
    Roads roads;
    std::vector<Robot> robots;
    Tick headway = 0;
    bool books_ahead = false;
    bool may_rotate = true;

    std::vector<std::int32_t> edge_class{};
    std::vector<VertexId> home{};
    std::vector<std::int32_t> first_stage{0};
    std::vector<VertexId> stage_vertex{};
    std::vector<Tick> stage_dwell{};
    std::vector<std::int32_t> class_ticks{};

    // Borrows from this.
    Trips trips() {
        edge_class.assign(roads.heads.size(), 0);
        for (const Robot& robot : robots) {
            home.push_back(robot.home);
            for (const Stage& stage : robot.stages) {
                stage_vertex.push_back(stage.vertex);
                stage_dwell.push_back(stage.dwell);
            }
            first_stage.push_back(static_cast<std::int32_t>(stage_vertex.size()));
            class_ticks.push_back(robot.edge_ticks);
        }
        return {roads.graph(), edge_class,  home,    first_stage, stage_vertex,
                stage_dwell,   class_ticks, headway, books_ahead, may_rotate};
    }
};

}  // namespace rightofway::test
