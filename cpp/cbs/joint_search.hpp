// The plan of least cost of a few robots, alone on the roads: A* over their joint states.
//
// A plan of least cost can be taken in which each robot leaves each vertex as soon as its work, its
// constraints and the orders of the robots at all places allow it. So a robot that waits goes on at
// the instant at which something ends: its own work or turn, a drive or the headway of another
// robot, a closure. These instants are the steps of the search, however short a tick is. In a step
// each robot goes on, or waits for the next one; whatever several robots do at one instant, they do
// together, so that rotations need no rule of their own.
//
// A state is what each robot does and since when, counted from the instant of the state. Where
// nothing closes or opens any more, the instant itself is no part of the state. So the states are
// finite in number, and a search that runs out of states proves that there is no plan. Where robots
// may not complete after some tick, a state at less cost is no better if it comes later.
//
// Where robots book ahead, a drive begins in a step. Else a robot is at one vertex until it is at
// the next one, and it enters a vertex in a step, after the ticks of the drive.
//
// Of the plans of least cost, which one has the fewest waits and drives? A robot may wait once for
// long, and not at each place for a bit, so that it begins drives later than it could. Then each
// tick is a step, every drive begins in a step, costs count in parts of a tick, and a wait or a
// drive is one part: were drives not counted, robots would drive to and fro rather than wait. Steps
// at each tick are also right for points that book edges which exclude each other and do not book
// ahead: they enter in time for what opens. No scenario has both.
//
// Standley, "Finding optimal solutions to cooperative pathfinding problems", AAAI 2010. Sharon,
// Stern, Felner & Sturtevant, "Meta-agent conflict-based search for optimal multi-agent path
// finding", SoCS 2012 (where groups of robots are planned by it).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "cbs/robot_states.hpp"
#include "core/index_table.hpp"
#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

// Thrown where the stop condition ends a search.
struct Stopped {};

// A plan of some robots: only plans are looked for that cost less, or have fewer actions.
struct KnownPlan {
    Tick cost = never;
    Tick actions = 0;  // drives, and waits: visits that last longer than work, turns and drive
};

// One object serves many searches.
class JointSearch {
  public:
    // Borrows both. The table has closures only.
    JointSearch(const Problem& problem, const BookingTable& closures)
        : problem_(problem), closures_(closures) {}
    JointSearch(const JointSearch&) = delete;  // its robots borrow its rules

    // The largest fleet whose joint states are searched.
    static constexpr std::size_t most_robots = 4;
    // More actions are not told from a tick.
    static constexpr Tick most_actions = 65'535;

    // Found, proven none, or stopped after `most_nodes` nodes. With a known plan, the plan found
    // has the fewest actions among those of least cost. Throws Stopped.
    SearchEnd run(std::span<const GroupMember> members, std::int64_t most_nodes,
                  const StopCondition& is_over, const KnownPlan* known = nullptr);

    // No plan costs less, by the weights of the robots, surcharges included.
    Tick bound() const { return bound_ / rules_.parts; }
    std::int64_t n_states() const { return n_states_; }
    // Of the plan found; only with a known plan.
    Tick actions() const { return nodes_[index(goal_)].cost % rules_.parts; }
    // The track of a member in the plan found.
    void track(std::size_t member, std::vector<Visit>& visits) const;

  private:
    using Choice = RobotStates::Choice;

    struct Node {
        Tick now;
        Tick cost;   // up to now; of robots that end, up to their completion
        Tick least;  // of all plans from here
        std::int32_t parent;
        std::int32_t first;  // the first node of this state
        std::int32_t next;   // another node of this state
    };

    void prepare(std::span<const GroupMember> members, const KnownPlan* known);
    void start();
    void expand(std::int32_t node);
    void choose(std::size_t k);
    void stop_if_over();
    bool is_allowed(std::size_t k, const Choice& choice) const;
    bool is_circle_forbidden() const;
    bool is_arrival_free() const;
    void step();
    void reach(Tick now, Tick cost);
    bool is_known(std::int32_t first, std::int32_t node, Tick now, Tick cost) const;
    std::int32_t state_of(std::int32_t node, std::size_t k) const {
        return states_[index(node) * size_ + k];
    }

    const Problem& problem_;
    const BookingTable& closures_;
    StepRules rules_;
    std::deque<RobotStates> robots_;
    std::size_t size_ = 0;
    Tick limit_ = never;       // nothing of this cost or more is looked for
    bool has_latest_ = false;  // robots may not complete after some tick
    std::vector<Node> nodes_;
    std::vector<std::int32_t> states_;  // of all members, node after node
    std::vector<EdgeId> edges_;         // chosen in the step before the node
    IndexTable known_;
    OpenList open_;
    Tick first_ = 0;
    Tick bound_ = 0;
    std::int32_t goal_ = none;
    const StopCondition* is_over_ = nullptr;
    std::int64_t n_states_ = 0;
    std::int64_t n_steps_ = 0;
    // Of the node at hand.
    std::int32_t node_ = none;
    std::vector<std::vector<Choice>> choices_;
    std::vector<Choice> chosen_;
    std::vector<std::int32_t> after_;
    std::vector<EdgeId> entered_;  // by which each robot arrives at the end of the step
};

}  // namespace rightofway
