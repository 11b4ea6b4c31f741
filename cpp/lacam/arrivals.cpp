#include "lacam/arrivals.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr Tick unsettled = -1;
constexpr Tick in_queue = -2;

}  // namespace

Arrivals::Arrivals(const Problem& problem, const ChosenMoves& moves)
    : problem_(problem),
      moves_(moves),
      arrival_(static_cast<std::size_t>(problem.n_robots()), unsettled) {
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        turns_.push_back(problem.turns(r));
    }
}

bool Arrivals::settle(const FleetState& now, std::vector<Decision>& decisions) {
    const bool is_settled = settle_all(now, decisions);
    for (const RobotId robot : moves_.robots()) {
        arrival_[index(robot)] = unsettled;
    }
    return is_settled;
}

bool Arrivals::settle_all(const FleetState& now, std::vector<Decision>& decisions) {
    for (const RobotId robot : moves_.robots()) {
        if (!moves_.moves(now, robot)) {
            continue;
        }
        if (arrival_[index(robot)] == unsettled && !settle_queue(now, robot)) {
            return false;
        }
        decisions.push_back({robot, moves_.next(robot), arrival_[index(robot)]});
    }
    return true;
}

// Follows the queues to their fronts and computes the arrivals from there. False if a robot ahead
// stays, or if a queue is a cycle and rotations are forbidden.
bool Arrivals::settle_queue(const FleetState& now, RobotId last) {
    queue_.assign(1, last);
    arrival_[index(last)] = in_queue;
    while (!queue_.empty()) {
        const RobotId robot = queue_.back();
        const VertexId place = moves_.next(robot);
        RobotId in_rotation = nobody;
        const bool is_behind = moves_.any_ahead(now, robot, place, [&](RobotId other) {
            if (now.is_busy(other) || arrival_[index(other)] >= 0) {
                return false;
            }
            if (arrival_[index(other)] == in_queue || !moves_.moves(now, other)) {
                in_rotation = other;
                return false;
            }
            arrival_[index(other)] = in_queue;
            queue_.push_back(other);
            return true;
        });
        if (is_behind) {
            continue;
        }
        if (in_rotation != nobody &&
            (!moves_.moves(now, in_rotation) || !settle_rotation(now, robot))) {
            return false;
        }
        queue_.pop_back();
        if (arrival_[index(robot)] != in_queue) {
            continue;  // part of a rotation
        }
        const EdgeId edge = moves_.edge_to(now, robot, place);
        const Tick drive = problem_.drive(robot, edge);
        Tick left = -problem_.rules().headway;
        moves_.any_near(now, robot, place, [&](std::int32_t resource, std::int32_t, bool) {
            left = std::max(left, now.left(resource));
            return false;
        });
        moves_.any_ahead(now, robot, place, [&](RobotId other) {
            left = std::max(left, now.is_busy(other) ? now.ready(other) : arrival_[index(other)]);
            return false;
        });
        arrival_[index(robot)] =
            std::max(turned(now, robot, edge) + drive, left + problem_.gap(drive));
    }
    return true;
}

bool Arrivals::settle_rotation(const FleetState& now, RobotId member) {
    if (!problem_.may_rotate()) {
        return false;
    }
    Tick latest = 0;
    RobotId robot = member;
    do {
        const EdgeId edge = moves_.edge_to(now, robot, moves_.next(robot));
        latest = std::max(latest, turned(now, robot, edge) + problem_.drive(robot, edge));
        robot = now.here(moves_.next(robot));
    } while (robot != member);
    do {
        arrival_[index(robot)] = latest;
        robot = now.here(moves_.next(robot));
    } while (robot != member);
    return true;
}

// When a free robot can begin to drive along an edge: it turns as soon as it is free.
Tick Arrivals::turned(const FleetState& now, RobotId robot, EdgeId edge) const {
    const Tick turn = turns_[index(robot)].between(now.came_by(robot), edge);
    return turn == 0 ? now.now() : std::max(now.now(), now.ready(robot) + turn);
}

}  // namespace rightofway
