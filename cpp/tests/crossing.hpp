// A fleet that crosses a grid from side to side, and the first plans of it, for the tests of
// searches over whole fleets.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <numeric>
#include <vector>

#include "corridors.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/prioritized.hpp"

namespace rightofway::test {

// Robots that cross a grid of `size` * `size` from side to side, each from its own row or column.
struct Crossing {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;
    std::vector<std::int32_t> classes;
    std::vector<std::int32_t> paces{1, 3};
    std::vector<std::int32_t> pace_of;
    std::vector<VertexId> home;
    std::vector<std::int32_t> first_stage{0};
    std::vector<VertexId> stage;
    std::vector<Tick> nothing;
    std::int32_t n_classes = 1;

    explicit Crossing(VertexId size) {
        for (VertexId v = 0; v < size * size; ++v) {
            for (const VertexId step : {1, size, -1, -size}) {
                const bool leaves_row =
                    std::abs(step) == 1 && (v + step + size) / size != v / size + 1;
                if (v + step >= 0 && v + step < size * size && !leaves_row) {
                    heads.push_back(v + step);
                }
            }
            indptr.push_back(static_cast<EdgeId>(heads.size()));
        }
        classes.assign(heads.size(), 0);
        for (VertexId k = 1; k + 1 < size; ++k) {
            add(k * size, k * size + size - 1, 0);
            add(k * size + size - 1, k * size, 1);
            add(k, (size - 1) * size + k, 0);
        }
    }

    void add(VertexId from, VertexId to, std::int32_t pace) {
        home.push_back(from);
        stage.push_back(to);
        pace_of.push_back(pace);
        first_stage.push_back(static_cast<std::int32_t>(stage.size()));
        nothing.push_back(0);
    }

    ProblemArrays arrays() const {
        return {indptr,      heads, classes, paces,   pace_of,  home,
                first_stage, stage, nothing, nothing, n_classes};
    }
};

inline std::vector<Tick> alone(SharedDistances& distances) {
    std::vector<Tick> ticks;
    for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
        ticks.push_back(distances.alone(robot));
    }
    return ticks;
}

inline std::vector<RobotId> in_turn(SharedDistances& distances) {
    std::vector<RobotId> order(static_cast<std::size_t>(distances.problem().n_robots()));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

inline SearchEnd plan_all(SharedDistances& distances, FleetPlan& plan, std::int64_t n_searches) {
    Prioritized planner(distances, plan);
    planner.start(in_turn(distances));
    return planner.run(n_searches, no_deadline);
}

inline FleetPlan planned(SharedDistances& distances) {
    FleetPlan plan(distances.problem());
    REQUIRE(plan_all(distances, plan, 1000) == SearchEnd::found);
    return plan;
}

inline bool is_sound(SharedDistances& distances, const FleetPlan& plan) {
    bool sound = true;
    for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
        sound = sound && plan.has_track(robot) && plan.fits(robot, plan.track(robot));
    }
    return sound;
}

}  // namespace rightofway::test
