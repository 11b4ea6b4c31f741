// Priority inheritance with backtracking (PIBT) with times: the decisions of one instant.
//
// Free robots choose in order of priority. A robot prefers the neighbour from which it reaches its
// target earliest. If a robot drives away from that vertex, the robot follows it; if a free robot
// stands there, that robot inherits the priority and chooses next; if it finds no vertex, the first
// robot tries its second choice. Robots that drive or work cannot be pushed; a robot waits if other
// robots drive to all vertices that it prefers. After all choices, arrivals are computed from the
// front of each queue to its end; a rotation arrives at one instant, the arrival of its slowest
// robot. Turns on the spot delay arrivals, but no robot prefers a place for them.
//
// Robots with sizes: a place is blocked, or held, by the robots near to it, and near to the edge
// that leads there. A robot pushes each of them, and waits for each of them to leave. For points
// the only such place is the vertex itself.
//
// With one speed, no work and no booking ahead this is PIBT, with the swap operation:
//
// Okumura, Machida, Defago & Tamura, "Priority inheritance with backtracking for iterative
// multi-agent path finding", Artificial Intelligence 310, 2022; the swap operation: Okumura,
// "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
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

    // Fixes the next vertex of a free robot at this instant; its own vertex: the robot stays.
    void fix(RobotId robot, VertexId vertex);

    // Chooses for these robots in this order, and for the robots that they push; false if no choice
    // is possible. Removes all fixes.
    bool choose(const FleetState& now, std::span<const RobotId> order);

    // The moves of the latest choice.
    std::span<const Decision> decisions() const { return decisions_; }

    // The ticks that a robot needs for its quickest edge.
    Tick pace(RobotId robot) const { return pace_[index(robot)]; }

    // The number of choices of single robots since construction.
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
    // How far a robot has asked those that have to leave before it drives to a place.
    struct Ahead {
        VertexId place = -1;
        std::size_t n_asked = 0;  // two for each resource: the robot there, the one that crosses it
    };
    // A robot that is choosing; those above it on the stack choose before it can go on.
    struct Frame {
        RobotId robot;
        RobotId partner;
        std::size_t first;  // its candidates: places_[first] .. places_[end - 1]
        std::size_t end;
        std::size_t k;  // the candidate that it tries
        Ahead ahead{};  // of that candidate; no place: it is not taken yet
        RobotId pushed = nobody;
    };
    enum class Choice : std::uint8_t { open, found, failed };

    bool take_fixed(const FleetState& now);
    bool choose_all(const FleetState& now, std::span<const RobotId> order);
    bool choose_one(const FleetState& now, RobotId robot);
    Choice begin(const FleetState& now, RobotId robot);
    Choice try_candidates(const FleetState& now, Choice pushed);
    bool take_next_place(const FleetState& now, Frame& frame);
    Choice end(const FleetState& now, bool is_found);
    bool has_to_wait(const FleetState& now, RobotId robot);
    bool has_partner(const FleetState& now, RobotId robot);
    template <class Use>
    bool any_near(const FleetState& now, RobotId robot, VertexId place, const Use& use) const;
    template <class Use>
    bool any_ahead(const FleetState& now, RobotId robot, VertexId place, const Use& use) const;
    RobotId next_ahead(const FleetState& now, RobotId robot, Ahead& ahead) const;
    bool goes_first(const FleetState& now, RobotId other, RobotId robot) const;
    void pull(const FleetState& now, RobotId partner, VertexId place);
    bool is_open(const FleetState& now, RobotId robot, VertexId place) const;
    bool is_booked(const FleetState& now, RobotId robot, VertexId place) const;
    bool moves(const FleetState& now, RobotId robot) const;
    bool closes_rotation(const FleetState& now, RobotId robot);
    void take(const FleetState& now, RobotId robot, VertexId vertex);
    void release(const FleetState& now, RobotId robot);
    EdgeId edge_to(const FleetState& now, RobotId robot, VertexId place) const {
        return problem_.graph().edge(now.at(robot), place);
    }
    const Outlook& outlook(const FleetState& now, RobotId robot);
    const std::int32_t* steps_beside(RobotId robot) const {
        return steps_beside_.data() + index(robot) * most_heads_;
    }
    Place place(const FleetState& now, RobotId robot, std::size_t k) const;
    static bool ranks_before(const Place& left, const Place& right);
    void push_places(const FleetState& now, RobotId robot);
    Tick soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const;
    Tick turned(const FleetState& now, RobotId robot, EdgeId edge) const;
    bool is_idle(const FleetState& now, RobotId robot) const;
    std::int32_t way(const FleetState& now, RobotId robot, VertexId vertex);
    bool settle_arrivals(const FleetState& now);
    bool settle_queue(const FleetState& now, RobotId last);
    bool settle_rotation(const FleetState& now, RobotId member);
    void forget(const FleetState& now);

    const Problem& problem_;
    StepTables& tables_;
    const SpaceUtilization& paths_;
    std::vector<StepTables::TableId> stage_table_;
    std::vector<Tick> pace_;
    std::vector<Turns> turns_;                // of each robot
    std::vector<Outlook> outlook_;            // of each robot, at its latest choice
    std::size_t most_heads_ = 0;              // greatest out-degree
    std::vector<std::int32_t> steps_beside_;  // per robot: most_heads_ neighbours
    std::uint64_t draw_;                      // state of the random numbers for ties
    std::vector<RobotId> claim_;      // of each resource (FleetState): robot that chose it now
    std::vector<VertexId> next_;      // of each robot: its choice
    std::vector<Tick> arrival_;       // of each robot, once computed
    std::vector<RobotId> chosen_;     // robots with a choice
    std::vector<std::int32_t> rank_;  // of each robot with a choice: its index in chosen_
    std::vector<RobotId> queue_;
    std::vector<std::int64_t> seen_by_;  // of each robot: the latest search for a rotation
    std::int64_t n_rotation_searches_ = 0;
    std::vector<Place> places_;  // a stack: candidates of each robot that is choosing
    std::vector<Frame> frames_;  // a stack: robots that are choosing, each pushed by the last
    std::vector<Fixed> fixed_;
    std::vector<Decision> decisions_;
    std::int64_t n_choices_ = 0;
};

}  // namespace rightofway
