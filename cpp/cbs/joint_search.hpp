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
// finite in number, and a search that runs out of states proves that there is no plan.
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

#include "cbs/constraint_sets.hpp"
#include "core/index_table.hpp"
#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "distances/trip.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// Thrown where the stop condition ends a search.
struct Stopped {};

// One of the robots that are planned together.
struct GroupMember {
    RobotId robot;
    const Trip* trip;
    std::span<const Constraint> constraints;
    Tick most = never;  // greatest completion time
};

// A plan of some robots: only plans are looked for that cost less, or have fewer actions.
struct KnownPlan {
    Tick cost = never;
    Tick actions = 0;  // drives, and waits: visits that last longer than work, turns and drive
};

// One object serves many searches.
class JointSearch {
  public:
    // Borrows the problem. The table has closures only.
    JointSearch(const Problem& problem, const BookingTable& closures)
        : problem_(problem), closures_(closures) {}

    // The largest fleet whose joint states are searched.
    static constexpr std::size_t most_robots = 4;
    // More actions are not told from a tick.
    static constexpr Tick most_actions = 65'535;

    // Found, proven none, or stopped after `most_nodes` nodes. With a known plan, the plan found
    // has the fewest actions among those of least cost. Throws Stopped.
    SearchEnd run(std::span<const GroupMember> members, std::int64_t most_nodes,
                  const StopCondition& is_over, const KnownPlan* known = nullptr);

    // No plan costs less, by the weights of the robots, surcharges included.
    Tick bound() const { return bound_ / parts_; }
    std::int64_t n_states() const { return n_states_; }
    // Of the plan found; only with a known plan.
    Tick actions() const { return nodes_[index(goal_)].cost % parts_; }
    // The track of a member in the plan found.
    void track(std::size_t member, std::vector<Visit>& visits) const;

  private:
    struct Trail {
        std::int32_t row;
        Tick left;
        bool operator==(const Trail&) const = default;
    };
    // What a robot does. It stays at the vertex, for `age` ticks so far, or drives from there.
    struct State {
        VertexId vertex;
        EdgeId edge;  // driven, or driven in if turns take time; else -1
        std::int32_t stage;
        bool ends;  // its last visit has begun, or begins after the drive
        Tick age;   // no longer than what it may have to wait for
        Tick left;  // of the drive; 0: it stays
        std::vector<Trail> trails;
        bool operator==(const State&) const = default;
    };
    struct Facts {                       // on a state, of the robot alone
        std::vector<std::int32_t> rows;  // booked
        Tick rest = 0;                   // least ticks to completion; `never` if there is no way
        Tick longest = 0;                // that it may have to stay before it can go on
    };
    struct Closed {
        std::int32_t row;
        Booking time;
    };
    struct Member {
        RobotId robot;
        const Trip* trip;
        Tick weight;  // parts of a tick
        Tick most;
        Tick stays_from;
        Tick ends_from;
        std::vector<Closed> constraints;  // in order of rows
        std::vector<State> states;
        std::vector<Facts> facts;
        IndexTable known;
    };
    // What a robot does in a step.
    struct Choice {
        EdgeId edge;         // that it drives along; -1: it goes on as it does
        std::int32_t state;  // at once
        Tick cost;  // surcharges and, where its completion is settled, the ticks until then
    };
    struct Node {
        Tick now;
        Tick cost;   // up to now; of robots that end, up to their completion
        Tick least;  // of all plans from here
        std::int32_t parent;
        std::int32_t first;  // the first node of this state
        Tick best;           // least cost of the nodes of this state; of the first node only
    };

    void prepare(std::span<const GroupMember> members, const KnownPlan* known);
    void start();
    void expand(std::int32_t node);
    void list_choices(std::size_t k, std::int32_t state, Tick now);
    void drive(std::size_t k, const State& state, EdgeId edge, Tick now);
    void choose(std::size_t k);
    void stop_if_over();
    bool is_allowed(std::size_t k, const Choice& choice) const;
    bool is_circle_forbidden() const;
    bool is_arrival_free() const;
    void step();
    void reach(Tick now, Tick cost);
    bool may_end(const Member& member, std::int32_t stage, Tick enter, Tick booked) const;
    Tick work_at_end(const Member& member, std::int32_t stage) const;
    Tick next_step(std::size_t k, std::int32_t state, Tick now) const;
    std::int32_t after(std::size_t k, std::int32_t state, Tick ticks);
    std::int32_t number(std::size_t k, State&& state);
    Facts look(std::size_t k, const State& state) const;
    template <class Use>
    void for_each_way(std::size_t k, const State& state, const Use& use) const;
    template <class Use>
    void for_each_closed(const Member& member, std::int32_t row, const Use& use) const;
    bool is_free(const Member& member, std::int32_t row, Tick start, Tick end) const;
    // Whether a robot is at its last vertex for ever, or nothing can keep it from being so.
    bool has_ended(const State& state) const {
        return state.ends && (problem_.rules().books_ahead || state.left == 0);
    }
    bool drives_book_edges() const { return problem_.has_sizes() && problem_.edges_exclude(); }
    bool closes_edges() const { return closures_.n_rows() > problem_.n_vertices(); }
    bool closes(Tick now) const { return now < horizon_ || closes_for_ever_; }
    std::int32_t edge_row(const Member& member, EdgeId edge) const {
        return problem_.first_row(member.robot) + problem_.n_vertices() + edge;
    }
    std::int32_t state_of(std::int32_t node, std::size_t k) const {
        return states_[index(node) * size_ + k];
    }

    const Problem& problem_;
    const BookingTable& closures_;
    std::deque<SafeIntervalSearch> rests_;
    std::deque<Member> members_;
    std::size_t size_ = 0;
    Tick horizon_ = 0;  // nothing closes or opens later
    bool closes_for_ever_ = false;
    bool every_tick_ = false;     // each tick is a step
    bool begins_drives_ = false;  // drives begin in steps; else they end in steps
    Tick parts_ = 1;              // of a tick, in which costs count
    Tick limit_ = never;          // nothing of this cost or more is looked for
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
