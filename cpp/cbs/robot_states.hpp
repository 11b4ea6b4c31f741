// States of one robot of a joint search, numbered, and the steps between them.
//
// A state says what the robot does and since when, counted from the instant of the state: it stays
// at a vertex, or drives along an edge, and what it has left is booked for a headway more. How long
// it has stayed counts no further than to the longest stay that it may need. So a robot has
// finitely many states, each looked at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cbs/constraint_sets.hpp"
#include "core/index_table.hpp"
#include "distances/trip.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// One of the robots that are planned together.
struct GroupMember {
    RobotId robot;
    const Trip* trip;
    std::span<const Constraint> constraints;
    Tick most = never;  // greatest completion time
};

// Which instants are steps of a joint search, and what costs count in; of all its robots.
struct StepRules {
    bool every_tick = false;     // each tick is a step
    bool begins_drives = false;  // drives begin in steps; else they end in steps
    Tick parts = 1;              // of a tick, in which costs count
    Tick horizon = 0;            // nothing closes or opens later
    bool closes_for_ever = false;

    bool counts_actions() const { return parts > 1; }
    bool closes(Tick now) const { return now < horizon || closes_for_ever; }
};

class RobotStates {
  public:
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
    // What a robot does in a step.
    struct Choice {
        EdgeId edge;         // that it drives along; -1: it goes on as it does
        std::int32_t state;  // at once
        Tick cost;  // surcharges and, where its completion is settled, the ticks until then
    };

    // Borrows all three. The table has closures only.
    RobotStates(const Problem& problem, const BookingTable& closures, const StepRules& rules)
        : problem_(problem),
          closures_(closures),
          rules_(rules),
          rests_(problem.roads(), problem.rules()) {}

    // Forgets the states of a search before. Borrows the trip.
    void prepare(const GroupMember& member);

    RobotId robot() const { return robot_; }
    const Trip& trip() const { return *trip_; }
    Tick weight() const { return weight_; }  // parts of a tick
    Tick most() const { return most_; }
    const State& state(std::int32_t number) const { return states_[index(number)]; }
    const Facts& facts(std::int32_t number) const { return facts_[index(number)]; }
    // Whether the robot is at its last vertex for ever, or nothing can keep it from being so.
    bool has_ended(std::int32_t number) const {
        const State& one = state(number);
        return one.ends && (problem_.rules().books_ahead || one.left == 0);
    }

    // What the robot can do at first, at home; nothing if it cannot stay there for an instant.
    void list_begins(std::vector<Choice>& choices);

    // What the robot can do in a state; those that go on cost less than `spare`.
    void list_choices(std::int32_t number, Tick now, Tick spare, std::vector<Choice>& choices);

    // Whether the robot may stay where it is until the next step, if it stays.
    bool may_stay(std::int32_t number, Tick now, Tick next) const;

    // The first instant after this one at which the robot can begin what it could not begin before,
    // or at which something that it books ends.
    Tick next_step(std::int32_t number, Tick now) const;

    // The state after some ticks in which the robot only goes on.
    std::int32_t after(std::int32_t number, Tick ticks);

  private:
    struct Closed {
        std::int32_t row;
        Booking time;
    };

    std::int32_t number(State&& state);
    Facts look(const State& state) const;
    void drive(const State& state, EdgeId edge, Tick now, std::vector<Choice>& choices);
    bool may_end(std::int32_t stage, Tick enter, Tick booked) const;
    Tick work_at_end(std::int32_t stage) const;
    template <class Use>
    void for_each_way(const State& state, const Use& use) const;
    template <class Use>
    void for_each_closed(std::int32_t row, const Use& use) const;
    bool is_free(std::int32_t row, Tick start, Tick end) const;
    bool drives_book_edges() const { return problem_.has_sizes() && problem_.edges_exclude(); }
    bool closes_edges() const { return closures_.n_rows() > problem_.n_vertices(); }
    std::int32_t edge_row(EdgeId edge) const {
        return problem_.first_row(robot_) + problem_.n_vertices() + edge;
    }

    const Problem& problem_;
    const BookingTable& closures_;
    const StepRules& rules_;
    SafeIntervalSearch rests_;
    RobotId robot_ = nobody;
    const Trip* trip_ = nullptr;
    Tick weight_ = 1;
    Tick most_ = never;
    Tick stays_from_ = 0;
    Tick ends_from_ = 0;
    std::vector<Closed> constraints_;  // in order of rows
    std::vector<State> states_;
    std::vector<Facts> facts_;
    IndexTable known_;
};

}  // namespace rightofway
