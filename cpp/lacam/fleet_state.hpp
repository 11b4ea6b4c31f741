// The state of a fleet at an instant: the position, the move and the ready tick of each robot.
//
// A decision books a move as a whole: the robot keeps its vertex until it arrives at the next one,
// and, where robots have sizes, the edge between them. A resource is a vertex or an edge, see
// Resources (problem.hpp).
// Only robots that are not busy decide. The state changes in two ways: a robot decides, or the
// clock advances to the next instant at which a robot finishes a move or its work. The time of both
// grows with the number of changed robots, not with the fleet.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// A move of a robot: it enters the vertex at `arrival`.
struct Decision {
    RobotId robot;
    VertexId vertex;
    Tick arrival;
};

// A robot between two steps of a fleet that moves in steps (Problem::moves_in_steps).
struct Standing {
    VertexId at;
    std::int32_t stage;
    std::int32_t waited;  // ticks on its way to the stage
};

class FleetState {
  public:
    // All robots at home at tick 0; robots without work there are free. Borrows the problem.
    explicit FleetState(const Problem& problem);

    Tick now() const { return now_; }
    VertexId at(RobotId robot) const { return robots_[index(robot)].at; }
    VertexId to(RobotId robot) const {
        return robots_[index(robot)].to;
    }  // `at`, unless the robot moves
    std::int32_t stage(RobotId robot) const { return robots_[index(robot)].stage; }
    VertexId target(RobotId robot) const {
        return problem_->stage_vertex(robots_[index(robot)].stage);
    }
    // When a busy robot finishes; when a free robot has finished.
    Tick ready(RobotId robot) const { return robots_[index(robot)].ready; }
    // The edge driven in, -1 before the first drive. Only where turning takes time.
    EdgeId came_by(RobotId robot) const { return robots_[index(robot)].edge; }
    Tick on_its_way_since(RobotId robot) const { return robots_[index(robot)].since; }
    bool is_busy(RobotId robot) const { return robots_[index(robot)].place == busy; }
    bool has_arrived(RobotId robot) const { return robots_[index(robot)].place == arrived; }

    // The robot at a vertex until its leave, or on an edge.
    RobotId here(std::int32_t resource) const { return resources_[index(resource)].here; }
    RobotId comes(VertexId vertex) const {
        return resources_[index(vertex)].comes;
    }  // by a booked move
    Tick left(std::int32_t resource) const {
        return resources_[index(resource)].left;
    }  // or -headway

    // The robots that are neither busy nor arrived, in no particular order.
    std::span<const RobotId> undecided() const { return undecided_; }
    bool is_goal() const { return n_arrived_ == problem_->n_robots(); }

    // A robot between two steps of a fleet that moves in steps.
    Standing standing(RobotId robot) const {
        const Robot& r = robots_[index(robot)];
        return {r.at, r.stage, static_cast<std::int32_t>(now_ - r.since)};
    }
    // Puts all robots of a fleet that moves in steps where they stood; the clock stays, so no
    // vertex was left later than now.
    void resume(std::span<const Standing> robots);

    void decide(const Decision& decision);

    // Advances the clock to the next instant at which a robot finishes; false if no robot is busy.
    bool advance();

    // A hash of the state relative to the clock: equal for states that differ only by the tick; for
    // other states equal only by chance (64 bits).
    std::uint64_t fingerprint() const;

  private:
    // Values of `place`; otherwise `place` is an index into `undecided_`.
    static constexpr std::int32_t busy = -1;
    static constexpr std::int32_t arrived = -2;
    struct Robot {
        VertexId at;
        VertexId to;
        std::int32_t stage;
        std::int32_t place;
        Tick ready;
        Tick since;
        EdgeId edge = -1;
        RobotId finishes_with = nobody;  // the next robot of the event
        std::uint64_t key = 0;           // in a sum below
    };
    struct Resource {
        RobotId here;
        RobotId comes;
        Tick left;
    };
    // Robots that finish at one instant: the first of a list. Robots that become busy one after the
    // other until one instant share an event, so a fleet that moves in steps has one at a time.
    struct Event {
        Tick tick;
        RobotId first;
        auto operator<=>(const Event&) const = default;
    };

    std::uint64_t key(RobotId robot) const;
    void set_busy(RobotId robot, Tick until);
    void set_free(RobotId robot);
    void take_off_list(RobotId robot);
    Resource& edge_of(const Robot& robot);
    void begin_stage(RobotId robot);

    const Problem* problem_;
    bool has_turns_ = false;
    Tick now_ = 0;
    std::vector<Robot> robots_;
    std::vector<Resource> resources_;  // edges only where drives exclude more than their ends do
    std::vector<RobotId> undecided_;
    std::vector<Event> events_;  // a heap
    Event latest_event_{-1, nobody};
    std::vector<RobotId> finished_;
    RobotId n_arrived_ = 0;
    std::uint64_t sum_free_ = 0;
    std::uint64_t sum_busy_ = 0;     // sum of key * base ^ ready tick
    std::uint64_t base_to_now_ = 1;  // base ^ now_
    std::uint64_t back_to_now_ = 1;  // inverse of base_to_now_
};

}  // namespace rightofway
