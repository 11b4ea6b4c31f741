// The vertices that a robot may choose next, in its order of preference.
//
// PIBT as published sorts the neighbours of a vertex by their distance to the goal, and breaks ties
// at random. Here robots have several stops, own speeds and work times: a candidate costs the time
// until the robot is there, after those that stand there, plus the way on to the next stop at the
// pace of the robot's quickest edge. The next vertex of the preferred path of the leg
// (space_utilization.hpp) counts as one step nearer and wins ties. Turns on the spot delay
// arrivals, but no robot prefers a place for them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "distances/space_utilization.hpp"
#include "distances/step_tables.hpp"
#include "lacam/chosen_moves.hpp"
#include "lacam/fleet_state.hpp"
#include "problem/problem.hpp"

namespace rightofway {

struct Candidate {
    std::int64_t cost;
    std::uint32_t tie;
    VertexId vertex;
};

class Candidates {
  public:
    // Borrows everything.
    Candidates(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
               const ChosenMoves& moves, std::uint64_t seed);

    // The ticks that a robot needs for its quickest edge.
    Tick pace(RobotId robot) const { return pace_[index(robot)]; }
    // The steps from a vertex to the target of a robot.
    std::int32_t way(const FleetState& now, RobotId robot, VertexId vertex) {
        return tables_.steps(stage_table_[index(now.stage(robot))], vertex);
    }

    // The steps to the target from the robot's vertex, and from its neighbours: from each head of
    // the roadmap, unreachable over an edge that is barred to the robot.
    struct Outlook {
        VertexId here = -1;
        std::int32_t stage = -1;
        std::int32_t steps = 0;
        VertexId preferred = -1;  // the neighbour on the preferred path
    };
    const Outlook& outlook(const FleetState& now, RobotId robot);
    const std::int32_t* steps_beside(RobotId robot) const {
        return steps_beside_.data() + index(robot) * most_heads_;
    }

    // Adds the neighbours of the robot's vertex, and the vertex itself: the best of them first.
    void push(const FleetState& now, RobotId robot, std::vector<Candidate>& candidates);
    // The best of them, if it is no worse than to stay; as `push` would rank it next.
    Candidate best(const FleetState& now, RobotId robot) const;
    // Draws the ties of a robot without a look at them.
    void skip(VertexId vertex);

  private:
    Candidate candidate(const FleetState& now, RobotId robot, std::size_t k) const;
    static bool ranks_before(const Candidate& left, const Candidate& right);
    Tick soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const;

    const Problem& problem_;
    StepTables& tables_;
    const SpaceUtilization& paths_;
    const ChosenMoves& moves_;
    std::vector<StepTables::TableId> stage_table_;
    std::vector<Tick> pace_;
    std::vector<Outlook> outlook_;            // of each robot, at its latest choice
    std::size_t most_heads_ = 0;              // greatest out-degree
    std::vector<std::int32_t> steps_beside_;  // per robot: most_heads_ neighbours
    Random ties_;
};

}  // namespace rightofway
