#include "lacam/chosen_moves.hpp"

namespace rightofway {

ChosenMoves::ChosenMoves(const Problem& problem)
    : problem_(problem),
      claim_(static_cast<std::size_t>(problem.edges_exclude() ? problem.n_resources()
                                                              : problem.n_vertices()),
             nobody),
      next_(static_cast<std::size_t>(problem.n_robots()), nowhere),
      rank_(next_.size()),
      seen_by_(next_.size(), 0) {}

RobotId ChosenMoves::next_ahead(const FleetState& now, RobotId robot, Ahead& ahead) const {
    const std::int32_t n_resources = problem_.n_resources();
    const std::int32_t own_place = problem_.vertex_row(robot, ahead.place);
    const auto near_place = problem_.excluded(own_place);
    std::span<const std::int32_t> near_drive;
    if (problem_.edges_exclude() && ahead.place != now.at(robot)) {
        const std::int32_t own_drive = problem_.edge_row(robot, edge_to(now, robot, ahead.place));
        near_drive = problem_.excluded(own_drive);  // of the lists: only those have edges
    }
    while (ahead.n_asked < 2 * (near_place.size() + near_drive.size())) {
        const std::size_t k = ahead.n_asked / 2;
        const bool is_drive = k >= near_place.size();
        const std::int32_t row = is_drive ? near_drive[k - near_place.size()] : near_place[k];
        const std::int32_t resource = row < n_resources ? row : row % n_resources;
        const bool asks_who_crosses = ahead.n_asked++ % 2 == 1;
        if (asks_who_crosses && resource < problem_.n_vertices()) {
            continue;
        }
        const RobotId other = asks_who_crosses ? claim_[index(resource)] : now.here(resource);
        if (other != nobody && other != robot && problem_.first_row(other) == row - resource &&
            (!asks_who_crosses || !is_drive || goes_first(now, other, robot))) {
            return other;
        }
    }
    return nobody;
}

// Of two robots that chose edges near to each other: a robot whose vertex is in the way goes first,
// else the robot that chose first.
bool ChosenMoves::goes_first(const FleetState& now, RobotId other, RobotId robot) const {
    const auto is_in_the_way_of = [&](RobotId one, RobotId mover) {
        return next_[index(mover)] != nowhere &&
               any_near(now, mover, next_[index(mover)],
                        [&](std::int32_t resource, std::int32_t size, bool) {
                            return resource == now.at(one) && size == problem_.first_row(one);
                        });
    };
    return !is_in_the_way_of(robot, other) &&
           (is_in_the_way_of(other, robot) || rank_[index(other)] < rank_[index(robot)]);
}

void ChosenMoves::take(const FleetState& now, RobotId robot, VertexId vertex) {
    if (next_[index(robot)] == nowhere) {
        rank_[index(robot)] = static_cast<std::int32_t>(robots_.size());
        robots_.push_back(robot);
    } else {
        release(now, robot);
    }
    claim_[index(vertex)] = robot;
    next_[index(robot)] = vertex;
    if (problem_.edges_exclude() && moves(now, robot)) {
        claim_[index(problem_.n_vertices() + edge_to(now, robot, vertex))] = robot;
    }
}

void ChosenMoves::release(const FleetState& now, RobotId robot) {
    const VertexId place = next_[index(robot)];
    if (claim_[index(place)] == robot) {
        claim_[index(place)] = nobody;
    }
    if (problem_.edges_exclude() && moves(now, robot)) {
        claim_[index(problem_.n_vertices() + edge_to(now, robot, place))] = nobody;
    }
}

void ChosenMoves::withdraw_latest(const FleetState& now) {
    release(now, robots_.back());
    next_[index(robots_.back())] = nowhere;
    robots_.pop_back();
}

void ChosenMoves::clear(const FleetState& now) {
    for (const RobotId robot : robots_) {
        claim_[index(next_[index(robot)])] = nobody;
        claim_[index(now.at(robot))] = nobody;
        if (problem_.edges_exclude() && moves(now, robot)) {
            claim_[index(problem_.n_vertices() + edge_to(now, robot, next_[index(robot)]))] =
                nobody;
        }
        next_[index(robot)] = nowhere;
    }
    robots_.clear();
}

bool ChosenMoves::is_open(const FleetState& now, RobotId robot, VertexId place) const {
    const auto n_vertices = problem_.n_vertices();
    if (place != now.at(robot) && !problem_.may_drive(robot, now.at(robot), place)) {
        return false;
    }
    return !any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const auto is_other = [&](RobotId other) {
            return other != nobody && other != robot && problem_.first_row(other) == size;
        };
        if (resource >= n_vertices) {
            return place == now.at(robot) && is_other(claim_[index(resource)]);
        }
        if (is_other(now.comes(resource)) || is_other(claim_[index(resource)])) {
            return true;
        }
        const RobotId other = now.here(resource);
        const bool is_at_work = is_other(other) && now.is_busy(other) && now.to(other) == resource;
        return is_at_work || (is_other(other) && next_[index(other)] == now.at(robot));
    });
}

bool ChosenMoves::is_booked(const FleetState& now, RobotId robot, VertexId place) const {
    const auto n_vertices = problem_.n_vertices();
    return any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const RobotId other = resource < n_vertices ? now.comes(resource) : nobody;
        return other != nobody && problem_.first_row(other) == size;
    });
}

bool ChosenMoves::closes_rotation(const FleetState& now, RobotId robot) {
    ++n_rotation_searches_;
    queue_.assign(1, robot);
    while (!queue_.empty()) {
        const RobotId next = queue_.back();
        queue_.pop_back();
        const bool meets = any_ahead(now, next, next_[index(next)], [&](RobotId other) {
            if (other != robot && moves(now, other) &&
                seen_by_[index(other)] != n_rotation_searches_) {
                seen_by_[index(other)] = n_rotation_searches_;
                queue_.push_back(other);
            }
            return other == robot;
        });
        if (meets) {
            return true;
        }
    }
    return false;
}

}  // namespace rightofway
