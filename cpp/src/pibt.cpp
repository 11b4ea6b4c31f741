#include "rightofway/pibt.hpp"

#include <algorithm>
#include <limits>

namespace rightofway {
namespace {

constexpr RobotId nobody = -1;
constexpr VertexId nowhere = -1;

bool has(std::span<const VertexId> vertices, VertexId wanted) {
    return std::find(vertices.begin(), vertices.end(), wanted) != vertices.end();
}

}  // namespace

Pibt::Pibt(const Graph& graph, const Goals& goals, bool may_rotate, std::uint32_t seed)
    : graph_(graph),
      goals_(goals),
      may_rotate_(may_rotate),
      draw_(seed),
      here_(graph.n_vertices(), nobody),
      comes_(graph.n_vertices(), nobody),
      next_(goals.n_robots(), nowhere),
      tie_(graph.n_vertices(), 0) {}

std::int32_t Pibt::way(const Configuration& now, RobotId robot, VertexId vertex) const {
    const std::int32_t ticks = goals_.stage_table[now.stage[robot]][vertex];
    return ticks < 0 ? std::numeric_limits<std::int32_t>::max() : ticks;
}

void Pibt::fix(RobotId robot, VertexId vertex) { fixed_.push_back({robot, vertex}); }

bool Pibt::step(const Configuration& now, std::span<const RobotId> order) {
    for (RobotId r = 0; r < goals_.n_robots(); ++r) {
        here_[now.at[r]] = r;
        next_[r] = nowhere;
    }
    const bool found = take_fixed(now) && std::all_of(order.begin(), order.end(), [&](RobotId r) {
                           return next_[r] != nowhere || choose(now, r);
                       });
    const bool is_good = found && (may_rotate_ || !closes_rotation(now));
    for (RobotId r = 0; r < goals_.n_robots(); ++r) {
        here_[now.at[r]] = nobody;
        if (next_[r] != nowhere) {
            comes_[next_[r]] = nobody;
        }
    }
    fixed_.clear();
    return is_good;
}

bool Pibt::take_fixed(const Configuration& now) {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
        if (comes_[fixed.vertex] != nobody || is_swap(now, fixed.robot, fixed.vertex)) {
            return false;
        }
        take(fixed.robot, fixed.vertex);
        return true;
    });
}

// Whether the robot that is there now comes the other way.
bool Pibt::is_swap(const Configuration& now, RobotId robot, VertexId vertex) const {
    const RobotId other = here_[vertex];
    return other != nobody && other != robot && next_[other] == now.at[robot];
}

void Pibt::take(RobotId robot, VertexId vertex) {
    comes_[vertex] = robot;
    next_[robot] = vertex;
}

bool Pibt::choose(const Configuration& now, RobotId robot) {
    const VertexId here = now.at[robot];
    std::vector<VertexId> places = places_by_distance(now, robot);
    const RobotId partner = swap_partner(now, robot, places.front());
    if (partner != nobody) {
        std::reverse(places.begin(), places.end());
    }
    for (const VertexId place : places) {
        const RobotId other = here_[place];
        if (comes_[place] != nobody || is_swap(now, robot, place)) {
            continue;
        }
        take(robot, place);
        if (other != nobody && other != robot && next_[other] == nowhere && !choose(now, other)) {
            continue;  // `other` stays, so this place is taken
        }
        const bool pulls = partner != nobody && place == places.front() && place != here;
        if (pulls && next_[partner] == nowhere && comes_[here] == nobody &&
            has(graph_.heads(now.at[partner]), here)) {
            take(partner, here);
        }
        return true;
    }
    take(robot, here);
    return false;
}

// All places to go to, the nearest to the robot's stage first; ties at random.
std::vector<VertexId> Pibt::places_by_distance(const Configuration& now, RobotId robot) {
    const auto heads = graph_.heads(now.at[robot]);
    std::vector<VertexId> places(heads.begin(), heads.end());
    places.push_back(now.at[robot]);
    for (const VertexId place : places) {
        tie_[place] = static_cast<std::uint32_t>(draw_());
    }
    std::sort(places.begin(), places.end(), [&](VertexId left, VertexId right) {
        const auto way_left = way(now, robot, left);
        const auto way_right = way(now, robot, right);
        return way_left != way_right       ? way_left < way_right
               : tie_[left] != tie_[right] ? tie_[left] < tie_[right]
                                           : left < right;
    });
    return places;
}

// The robot to change places with: the one that stands where this one wants to go, or one behind
// this one that has to get past it.
RobotId Pibt::swap_partner(const Configuration& now, RobotId robot, VertexId wanted) const {
    const VertexId here = now.at[robot];
    if (wanted == here) {
        return nobody;
    }
    const RobotId ahead = here_[wanted];
    if (ahead != nobody && next_[ahead] == nowhere &&
        must_swap(now, {robot, ahead, here, wanted}) && can_swap(now, wanted, here)) {
        return ahead;
    }
    for (const VertexId place : graph_.heads(here)) {
        const RobotId behind = here_[place];
        if (behind != nobody && place != wanted && must_swap(now, {behind, robot, here, wanted}) &&
            can_swap(now, wanted, here)) {
            return behind;
        }
    }
    return nobody;
}

// The one way on for whoever is pushed back along a corridor; `more` if there are several, and
// `nowhere` if there is none.
VertexId Pibt::only_way_on(const Configuration& now, VertexId from, VertexId at) const {
    VertexId found = nowhere;
    for (const VertexId head : graph_.heads(at)) {
        const RobotId resident = here_[head];
        const bool is_blind = graph_.heads(head).size() == 1 && resident != nobody &&
                              goals_.stage_vertex[now.stage[resident]] == head;
        if (head == from || is_blind) {
            continue;
        }
        if (found != nowhere) {
            return more;
        }
        found = head;
    }
    return found;
}

// Whether the pusher, following the puller down the corridor, would only ever push it further from
// where the puller wants to go.
bool Pibt::must_swap(const Configuration& now, Pair pair) const {
    auto [pusher, puller, behind, ahead] = pair;
    while (way(now, pusher, ahead) < way(now, pusher, behind)) {
        const VertexId on = only_way_on(now, behind, ahead);
        if (on == more) {
            return false;
        }
        if (on == nowhere) {
            break;
        }
        behind = ahead;
        ahead = on;
    }
    return way(now, puller, behind) < way(now, puller, ahead) &&
           (way(now, pusher, behind) == 0 || way(now, pusher, ahead) < way(now, pusher, behind));
}

// Whether, going back along the corridor, there comes a place where the two can pass each other.
bool Pibt::can_swap(const Configuration& now, VertexId behind, VertexId ahead) const {
    const VertexId start = behind;
    while (ahead != start) {
        const VertexId on = only_way_on(now, behind, ahead);
        if (on == more) {
            return true;
        }
        if (on == nowhere) {
            return false;
        }
        behind = ahead;
        ahead = on;
    }
    return false;
}

// Follows every robot to the one it displaces; three or more that come back to the first rotate.
bool Pibt::closes_rotation(const Configuration& now) const {
    std::vector<RobotId> seen(next_.size(), nobody);  // in whose walk
    for (RobotId first = 0; first < goals_.n_robots(); ++first) {
        RobotId robot = first;
        while (robot != nobody && seen[robot] == nobody) {
            seen[robot] = first;
            robot = next_[robot] == now.at[robot] ? nobody : here_[next_[robot]];
        }
        if (robot != nobody && seen[robot] == first) {
            return true;
        }
    }
    return false;
}

}  // namespace rightofway
