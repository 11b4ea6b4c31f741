// Where every robot of a fleet is at an instant, where it drives to, and until when it is busy.
//
// A move is booked whole when it is decided: the robot stays where it is until it arrives. Only
// robots that are not busy decide. So the state changes by two means: robots decide, and the clock
// goes on to the next instant at which one of them has finished. Both cost what changes, not what
// there is.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// A robot is to be at a vertex from `arrival` on.
struct Decision {
    RobotId robot;
    VertexId vertex;
    Tick arrival;
};

class FleetState {
  public:
    // Everybody at home at tick 0, those without work there free to go. Borrows the problem.
    explicit FleetState(const Problem& problem);

    Tick now() const { return now_; }
    VertexId at(RobotId robot) const { return robots_[robot].at; }
    VertexId to(RobotId robot) const { return robots_[robot].to; }  // `at`, unless it moves
    std::int32_t stage(RobotId robot) const { return robots_[robot].stage; }
    VertexId target(RobotId robot) const { return problem_->stage_vertex(robots_[robot].stage); }
    Tick ready(RobotId robot) const { return robots_[robot].ready; }  // of one that is busy
    Tick on_its_way_since(RobotId robot) const { return robots_[robot].since; }
    bool is_busy(RobotId robot) const { return robots_[robot].place == busy; }
    bool has_arrived(RobotId robot) const { return robots_[robot].place == arrived; }

    RobotId here(VertexId vertex) const { return vertices_[vertex].here; }    // until it has left
    RobotId comes(VertexId vertex) const { return vertices_[vertex].comes; }  // its move is booked
    Tick left(VertexId vertex) const { return vertices_[vertex].left; }  // last, -headway: never

    // Those that are neither busy nor at the end of their problem, in no order.
    std::span<const RobotId> undecided() const { return undecided_; }
    bool is_goal() const { return n_arrived_ == problem_->n_robots(); }

    void decide(const Decision& decision);

    // Goes on to the next instant at which a robot finishes something; false if nobody is busy.
    bool advance();

    // The same for states that differ only by the time on the clock; other states hardly ever
    // have the same.
    std::uint64_t fingerprint() const;

  private:
    // `place` is the index among the undecided, or one of these.
    static constexpr std::int32_t busy = -1;
    static constexpr std::int32_t arrived = -2;
    struct Robot {
        VertexId at;
        VertexId to;
        std::int32_t stage;
        std::int32_t place;
        Tick ready;
        Tick since;
    };
    struct Vertex {
        RobotId here;
        RobotId comes;
        Tick left;
    };
    struct Event {
        Tick tick;
        RobotId robot;
        auto operator<=>(const Event&) const = default;
    };

    std::uint64_t key(RobotId robot) const;
    void set_busy(RobotId robot, Tick until);
    void set_free(RobotId robot);
    void take_off_list(RobotId robot);
    void begin_stage(RobotId robot);

    const Problem* problem_;
    Tick now_ = 0;
    std::vector<Robot> robots_;
    std::vector<Vertex> vertices_;
    std::vector<RobotId> undecided_;
    std::vector<Event> events_;  // a heap
    std::vector<RobotId> finished_;
    RobotId n_arrived_ = 0;
    std::uint64_t sum_free_ = 0;
    std::uint64_t sum_busy_ = 0;     // each key times base to the power of its ready tick
    std::uint64_t base_to_now_ = 1;  // base to the power of the time on the clock
    std::uint64_t back_to_now_ = 1;  // times that, it is 1
};

}  // namespace rightofway
