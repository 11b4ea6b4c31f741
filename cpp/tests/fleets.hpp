// Fleets for tests: roads, robots, and the arrays that a problem borrows.
#pragma once

#include <utility>
#include <vector>

#include "corridors.hpp"
#include "problem/problem.hpp"

namespace rightofway::test {

struct Stage {
    VertexId vertex;
    Tick dwell = 0;
    Tick earliest = 0;
    Tick latest = never;
};

struct Robot {
    VertexId home;
    std::vector<Stage> stages;
    std::int32_t edge_ticks = 1;
};

// Every edge has the same length. It must outlive its problem.
class Fleet {
  public:
    Fleet(Roads roads, const std::vector<Robot>& robots, BookingRules rules = {})
        : roads_(std::move(roads)), rules_(rules) {
        length_class_.assign(roads_.heads.size(), 0);
        for (const Robot& robot : robots) {
            pace_of_.push_back(static_cast<std::int32_t>(home_.size()));
            home_.push_back(robot.home);
            paces_.push_back(robot.edge_ticks);
            for (const Stage& stage : robot.stages) {
                stage_vertex_.push_back(stage.vertex);
                stage_work_.push_back(stage.dwell);
                stage_turn_.push_back(0);
                earliest_.push_back(stage.earliest);
                latest_.push_back(stage.latest);
            }
            ready_.push_back(0);
            first_turn_of_.push_back(0);
            first_stage_.push_back(static_cast<std::int32_t>(stage_vertex_.size()));
        }
    }

    // With times of stages, of which before[k] ends before after[k] begins.
    Problem problem_with_times(const std::vector<std::int32_t>& before = {},
                               const std::vector<std::int32_t>& after = {}) const {
        WorkArrays work{earliest_, latest_, ready_, first_turn_of_, {}, before, after};
        work.n_places = roads_.graph().n_vertices();
        return Problem({roads_.indptr, roads_.heads, length_class_, paces_, pace_of_, home_,
                        first_stage_, stage_vertex_, stage_work_, stage_turn_, 1},
                       rules_, {}, {}, {}, work);
    }

    Problem problem() const {
        return Problem({roads_.indptr, roads_.heads, length_class_, paces_, pace_of_, home_,
                        first_stage_, stage_vertex_, stage_work_, stage_turn_, 1},
                       rules_);
    }

  private:
    Roads roads_;
    BookingRules rules_;
    std::vector<std::int32_t> length_class_;
    std::vector<std::int32_t> paces_;
    std::vector<std::int32_t> pace_of_;
    std::vector<VertexId> home_;
    std::vector<std::int32_t> first_stage_{0};
    std::vector<VertexId> stage_vertex_;
    std::vector<Tick> stage_work_;
    std::vector<Tick> stage_turn_;
    std::vector<Tick> earliest_;
    std::vector<Tick> latest_;
    std::vector<Tick> ready_;
    std::vector<std::int32_t> first_turn_of_{0};
};

}  // namespace rightofway::test
