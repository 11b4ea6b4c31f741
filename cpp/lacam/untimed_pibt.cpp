#include "lacam/untimed_pibt.hpp"

#include <algorithm>
#include <iterator>

#include "lacam/swaps.hpp"

namespace rightofway {
namespace {

constexpr VertexId nowhere = -1;

bool has(std::span<const VertexId> vertices, VertexId wanted) {
    return std::find(vertices.begin(), vertices.end(), wanted) != vertices.end();
}

}  // namespace

// The fleet during a choice, as `Swaps` reads it.
struct UntimedPibt::Choosing {
    const UntimedPibt& pibt;
    const Configuration& now;

    const Graph& graph() const { return pibt.problem_.graph(); }
    VertexId at(RobotId robot) const { return now.at[index(robot)]; }
    RobotId here(VertexId vertex) const { return pibt.here_[index(vertex)]; }
    RobotId keeps_off(RobotId, VertexId vertex) const { return here(vertex); }
    VertexId target(RobotId robot) const {
        return pibt.problem_.stage_vertex(now.stage[index(robot)]);
    }
    std::int32_t way(RobotId robot, VertexId vertex) const { return pibt.way(now, robot, vertex); }
    bool is_free(RobotId) const { return true; }
    bool is_idle(RobotId robot) const { return pibt.next_[index(robot)] == nowhere; }
};

UntimedPibt::UntimedPibt(const Problem& problem, StepTables& tables, std::uint32_t seed)
    : problem_(problem),
      tables_(tables),
      draw_(seed),
      here_(static_cast<std::size_t>(problem.n_vertices()), nobody),
      comes_(static_cast<std::size_t>(problem.n_vertices()), nobody),
      next_(static_cast<std::size_t>(problem.n_robots()), nowhere),
      tie_(static_cast<std::size_t>(problem.n_vertices()), 0) {
    for (std::size_t stage = 0; stage < problem.n_stages(); ++stage) {
        const VertexId target = problem.stage_vertex(static_cast<std::int32_t>(stage));
        stage_table_.push_back(tables.table_of(target));
    }
}

std::int32_t UntimedPibt::way(const Configuration& now, RobotId robot, VertexId vertex) const {
    return tables_.steps(stage_table_[index(now.stage[index(robot)])], vertex);
}

void UntimedPibt::fix(RobotId robot, VertexId vertex) { fixed_.push_back({robot, vertex}); }

bool UntimedPibt::step(const Configuration& now, std::span<const RobotId> order) {
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        here_[index(now.at[index(r)])] = r;
        next_[index(r)] = nowhere;
    }
    const bool found = take_fixed(now) && std::all_of(order.begin(), order.end(), [&](RobotId r) {
                           return next_[index(r)] != nowhere || choose(now, r);
                       });
    const bool is_good = found && (problem_.may_rotate() || !closes_rotation(now));
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        here_[index(now.at[index(r)])] = nobody;
        if (next_[index(r)] != nowhere) {
            comes_[index(next_[index(r)])] = nobody;
        }
    }
    fixed_.clear();
    return is_good;
}

bool UntimedPibt::take_fixed(const Configuration& now) {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
        if (comes_[index(fixed.vertex)] != nobody || is_swap(now, fixed.robot, fixed.vertex)) {
            return false;
        }
        take(fixed.robot, fixed.vertex);
        return true;
    });
}

// Whether the robot at the vertex moves to this robot's vertex.
bool UntimedPibt::is_swap(const Configuration& now, RobotId robot, VertexId vertex) const {
    const RobotId other = here_[index(vertex)];
    return other != nobody && other != robot && next_[index(other)] == now.at[index(robot)];
}

void UntimedPibt::take(RobotId robot, VertexId vertex) {
    comes_[index(vertex)] = robot;
    next_[index(robot)] = vertex;
}

// A robot that is pushed chooses before the robot that pushes it. The chain of pushes is as long as
// the queue in a corridor, so it is a stack of frames and not of calls.
bool UntimedPibt::choose(const Configuration& now, RobotId robot) {
    bool found = false;  // of the robot that has chosen last
    begin(now, robot);
    while (!frames_.empty()) {
        Frame& frame = frames_.back();
        RobotId pushed = nobody;
        // Where the robot that was pushed stays, its place is occupied.
        while (!found && pushed == nobody && frame.next < frame.end) {
            const VertexId place = places_[frame.next++];
            const RobotId other = here_[index(place)];
            if (comes_[index(place)] != nobody || is_swap(now, frame.robot, place)) {
                continue;
            }
            take(frame.robot, place);
            found = other == nobody || other == frame.robot || next_[index(other)] != nowhere;
            pushed = found ? nobody : other;
        }
        if (pushed != nobody) {
            begin(now, pushed);
            continue;
        }
        if (found) {
            pull_partner(now, frame);
        } else {
            take(frame.robot, now.at[index(frame.robot)]);
        }
        places_.resize(frame.first);
        frames_.pop_back();
    }
    return found;
}

// Pushes a robot with its candidates.
void UntimedPibt::begin(const Configuration& now, RobotId robot) {
    const std::size_t first = places_.size();
    push_places_by_distance(now, robot);
    const Choosing fleet{*this, now};
    const RobotId partner = Swaps(fleet).partner(robot, places_[first]);
    if (partner != nobody) {
        std::reverse(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
    }
    frames_.push_back({robot, partner, first, places_.size(), first});
}

// Lets the partner follow a robot that took its first candidate.
void UntimedPibt::pull_partner(const Configuration& now, const Frame& frame) {
    const VertexId here = now.at[index(frame.robot)];
    const VertexId place = next_[index(frame.robot)];
    const bool pulls = frame.partner != nobody && place == places_[frame.first] && place != here;
    if (pulls && next_[index(frame.partner)] == nowhere && comes_[index(here)] == nobody &&
        has(problem_.graph().heads(now.at[index(frame.partner)]), here) &&
        problem_.may_drive(frame.partner, now.at[index(frame.partner)], here)) {
        take(frame.partner, here);
    }
}

// Pushes all candidates, nearest to the robot's stage first; ties are random.
void UntimedPibt::push_places_by_distance(const Configuration& now, RobotId robot) {
    const auto first = static_cast<std::ptrdiff_t>(places_.size());
    const auto heads = problem_.graph().heads(now.at[index(robot)]);
    std::copy_if(heads.begin(), heads.end(), std::back_inserter(places_), [&](VertexId head) {
        return problem_.may_drive(robot, now.at[index(robot)], head);
    });
    places_.push_back(now.at[index(robot)]);
    for (auto place = places_.begin() + first; place != places_.end(); ++place) {
        tie_[index(*place)] = static_cast<std::uint32_t>(draw_());
    }
    std::sort(places_.begin() + first, places_.end(), [&](VertexId left, VertexId right) {
        const auto way_left = way(now, robot, left);
        const auto way_right = way(now, robot, right);
        return way_left != way_right                     ? way_left < way_right
               : tie_[index(left)] != tie_[index(right)] ? tie_[index(left)] < tie_[index(right)]
                                                         : left < right;
    });
}

// Follows each robot to the robot that it displaces; three or more that return to the first rotate.
bool UntimedPibt::closes_rotation(const Configuration& now) const {
    std::vector<RobotId> seen(next_.size(), nobody);  // first robot of the walk
    for (RobotId first = 0; first < problem_.n_robots(); ++first) {
        RobotId robot = first;
        while (robot != nobody && seen[index(robot)] == nobody) {
            seen[index(robot)] = first;
            robot = next_[index(robot)] == now.at[index(robot)] ? nobody
                                                                : here_[index(next_[index(robot)])];
        }
        if (robot != nobody && seen[index(robot)] == first) {
            return true;
        }
    }
    return false;
}

}  // namespace rightofway
