// Priority inheritance with backtracking at one instant of a fleet with clocks.
//
// Only robots that are free decide, in order of priority. Each wants the neighbour from where it
// would be at its target soonest: a robot that drives away from there is followed, and one that
// stands there and is free inherits the priority and decides next; if that finds no place, the
// first one tries its second choice. Robots on the move and at work cannot be pushed, and who wants
// to go only where others drive to waits for them. When all have chosen, the arrivals follow, from
// the front of each queue to its end; where robots may rotate, a circle arrives at one instant,
// that of its slowest.
//
// With one speed, no work and no booking ahead this is PIBT (see untimed_pibt.hpp, for references
// too).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distances/space_utilization.hpp"
#include "distances/step_tables.hpp"
#include "lacam/fleet_state.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Pibt {
  public:
    // Borrows everything.
    Pibt(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
         std::uint64_t seed);

    // Says where a free robot goes at this instant; its own place: it stays.
    void fix(RobotId robot, VertexId vertex);

    // Lets these robots choose in this order, and those they push; false if that does not work
    // out. The fixed robots are free again afterwards.
    bool choose(const FleetState& now, std::span<const RobotId> order);

    // The moves that were chosen last.
    std::span<const Decision> decisions() const { return decisions_; }

    // The ticks that a robot needs for its quickest edge.
    Tick pace(RobotId robot) const { return pace_[robot]; }

    // How often a robot has chosen, since the beginning.
    std::int64_t n_choices() const { return n_choices_; }

  private:
    struct Choosing;
    struct Fixed {
        RobotId robot;
        VertexId vertex;
    };
    struct Outlook {
        VertexId here = -1;
        std::int32_t stage = -1;
        std::int32_t steps = 0;   // to the target of the stage
        VertexId preferred = -1;  // the neighbour on the preferred path
    };
    struct Place {
        std::int64_t cost;
        std::uint32_t tie;
        VertexId vertex;
    };

    bool take_fixed(const FleetState& now);
    bool choose_all(const FleetState& now, std::span<const RobotId> order);
    bool choose_one(const FleetState& now, RobotId robot);
    bool has_to_wait(const FleetState& now, RobotId robot);
    bool has_partner(const FleetState& now, RobotId robot);
    bool try_places(const FleetState& now, RobotId robot, std::size_t first, RobotId partner);
    bool is_open(const FleetState& now, RobotId robot, VertexId place) const;
    bool closes_circle(const FleetState& now, RobotId robot, VertexId place) const;
    void take(RobotId robot, VertexId vertex);
    const Outlook& outlook(const FleetState& now, RobotId robot);
    const std::int32_t* steps_beside(RobotId robot) const {
        return steps_beside_.data() + static_cast<std::size_t>(robot) * most_heads_;
    }
    Place place(const FleetState& now, RobotId robot, std::size_t k) const;
    static bool ranks_before(const Place& left, const Place& right);
    void push_places(const FleetState& now, RobotId robot);
    Tick soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const;
    bool is_idle(const FleetState& now, RobotId robot) const;
    std::int32_t way(const FleetState& now, RobotId robot, VertexId vertex);
    bool settle_arrivals(const FleetState& now);
    bool settle_queue(const FleetState& now, RobotId last);
    bool settle_circle(const FleetState& now, RobotId member);
    void forget(const FleetState& now);

    const Problem& problem_;
    StepTables& tables_;
    const SpaceUtilization& paths_;
    std::vector<StepTables::TableId> stage_table_;
    std::vector<Tick> pace_;
    std::vector<Outlook> outlook_;            // of each robot, when it last chose
    std::size_t most_heads_ = 0;              // of any vertex
    std::vector<std::int32_t> steps_beside_;  // of each robot: from that many neighbours
    std::uint64_t draw_;                      // state of the random numbers for ties
    std::vector<RobotId> claim_;   // who will be at each vertex by a choice of this instant
    std::vector<VertexId> next_;   // where each robot will be by that
    std::vector<Tick> arrival_;    // of each robot, once it is settled
    std::vector<RobotId> chosen_;  // this instant
    std::vector<RobotId> queue_;
    std::vector<Place> places_;  // a stack: those of each robot that is choosing
    std::vector<Fixed> fixed_;
    std::vector<Decision> decisions_;
    std::int64_t n_choices_ = 0;
};

}  // namespace rightofway
