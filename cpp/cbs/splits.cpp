// Which conflict of a node is resolved, and how: the two constraints, one for each child.
#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "cbs/cbs.hpp"

namespace rightofway {

// Makes the children of a node; true if it has no conflict.
bool ConflictTree::split(Node& node, Tick upper, const StopCondition& is_over) {
    std::vector<std::pair<RobotId, SetId>> changes;
    std::optional<std::pair<RobotId, SetId>> held;
    if (const std::optional<TrackConflict> chosen = choose(node, is_over)) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (const Constraint* hold = held_in(node, *chosen, 1 - side)) {
                const RobotId robot = chosen->robot[side];
                const std::int32_t row = chosen->constraint[side].row;
                changes.assign(1, {robot, tracks_.sets().with(node.sets[index(robot)],
                                                              {row, hold->start, hold->end})});
                break;
            }
            changes.emplace_back(chosen->robot[side], chosen->set[side]);
        }
        if (changes.size() > 1 && may_hold() && chosen->since < never) {
            const Constraint& away = chosen->constraint[0];
            held.emplace(chosen->robot[0],
                         tracks_.sets().with(node.sets[index(chosen->robot[0])],
                                             Constraint::hold(away.row, away.start)));
        }
    } else if (const Problem& problem = tracks_.problem();
               !problem.rules().rotations && problem.may_follow()) {
        std::vector<RobotId> places(robots_.size());
        std::iota(places.begin(), places.end(), 0);
        const Rotation rotation = find_rotation(problem, places, node.tracks);
        for (std::size_t k = 0; k < rotation.robots.size(); ++k) {
            const RobotId robot = rotation.robots[k];
            changes.emplace_back(
                robot, tracks_.sets().with(node.sets[index(robot)], rotation.constraints[k]));
        }
    }
    // A search may be stopped: no child is open before all are complete.
    std::vector<Node> children;
    for (const auto& [robot, set] : changes) {
        if (std::optional<Node> one = child(node, robot, set, upper, is_over)) {
            if (held && held->first != robot) {
                hold(*one, held->first, held->second);
            }
            children.push_back(std::move(*one));
        }
    }
    for (Node& one : children) {
        push(std::move(one), upper);
    }
    return changes.empty();
}

// Gives a robot that stays on its track another set; what its conflicts would cost is by its set.
void ConflictTree::hold(Node& node, RobotId robot, SetId set) {
    node.sets[index(robot)] = set;
    for (TrackConflict& conflict : node.conflicts) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (conflict.robot[side] == robot) {
                conflict.loss[side] = -1;
                conflict.set[side] = -1;
            }
        }
    }
}

// Disjoint splitting, for points without headway: others book by edges or by the past, too.
bool ConflictTree::may_hold() const {
    const Problem& problem = tracks_.problem();
    return options_.disjoint && !problem.has_sizes() && problem.rules().headway == 0;
}

// The constraint that holds a robot of a conflict to its row at a tick of the overlap, if any: no
// plan of the node has the other robot there.
const Constraint* ConflictTree::held_in(const Node& node, const TrackConflict& conflict,
                                        std::size_t side) const {
    if (!may_hold() || conflict.since >= never) {
        return nullptr;
    }
    const Constraint& away = conflict.constraint[side];
    for (const Constraint& one : tracks_.sets().at(node.sets[index(conflict.robot[side])])) {
        if (one.is_hold() && one.held_row() == away.row && one.start >= conflict.since &&
            one.start < away.end) {
            return &one;
        }
    }
    return nullptr;
}

// Fills in what the robots of a conflict lose by its constraints.
void ConflictTree::weigh(const Node& node, TrackConflict& conflict, const StopCondition& is_over) {
    for (std::size_t side = 0; side < 2; ++side) {
        const auto robot = index(conflict.robot[side]);
        if (conflict.set[side] < 0) {
            conflict.set[side] = tracks_.sets().with(node.sets[robot], conflict.constraint[side]);
        }
        if (conflict.loss[side] < 0 && options_.cardinal) {
            const Tick least = tracks_.best(robots_[robot], node.sets[robot], is_over)->cost;
            const ConstrainedTrack* track =
                tracks_.best(robots_[robot], conflict.set[side], is_over);
            conflict.loss[side] = track == nullptr ? never : track->cost - least;
        }
    }
}

// The conflict to resolve, if there is one. Changes tracks where that takes conflicts away.
std::optional<TrackConflict> ConflictTree::choose(Node& node, const StopCondition& is_over) {
    const auto key = [](const TrackConflict& one) {
        const auto [less, more] = std::minmax(one.loss[0], one.loss[1]);
        return std::tuple(less, more, -one.constraint[0].start);
    };
    std::optional<TrackConflict> chosen;
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        chosen.reset();
        for (TrackConflict& conflict : node.conflicts) {
            weigh(node, conflict, is_over);
            if (options_.bypass && bypass(node, conflict, is_over)) {
                has_changed = true;
                break;
            }
            if (!chosen || key(conflict) > key(*chosen)) {
                chosen = conflict;
            }
        }
    }
    if (losses_ != nullptr && options_.pairs && options_.cardinal &&
        !tracks_.problem().has_surcharges()) {
        for (const auto& [first, second] : pairs_in_conflict(node)) {
            const std::optional<TrackConflict> pair = split_pair(node, first, second, is_over);
            if (pair && key(*pair) > key(*chosen)) {
                chosen = pair;
            }
        }
    }
    return chosen;
}

// Two robots that lose to each other: one or the other completes later, whatever the conflict is.
std::optional<TrackConflict> ConflictTree::split_pair(const Node& node, RobotId first,
                                                      RobotId second,
                                                      const StopCondition& is_over) {
    const std::array<RobotId, 2> robots{robots_[index(first)], robots_[index(second)]};
    const std::array<SetId, 2> sets{node.sets[index(first)], node.sets[index(second)]};
    const Tick together = losses_->together(robots, sets, is_over);
    if (together <= 0 || together >= never) {
        return std::nullopt;
    }
    const std::array<Tick, 2> either = losses_->either(robots, sets, is_over);
    TrackConflict conflict{.robot = {first, second}, .constraint = {}};
    for (std::size_t side = 0; side < 2; ++side) {
        const Tick weight = tracks_.problem().weight(robots[side]);
        const Tick later = (either[side] + weight - 1) / weight;
        const Tick end = tracks_.best(robots[side], sets[side], is_over)->completion + later;
        conflict.constraint[side] = {Constraint::completion, end - 1, end};
    }
    weigh(node, conflict, is_over);
    return conflict;
}

// Takes another track of equal cost for a robot if it has fewer conflicts. It keeps one constraint
// more than it has to.
bool ConflictTree::bypass(Node& node, const TrackConflict& conflict, const StopCondition& is_over) {
    for (std::size_t side = 0; side < 2; ++side) {
        const RobotId robot = conflict.robot[side];
        const auto place = index(robot);
        const ConstrainedTrack* track = tracks_.best(robots_[place], conflict.set[side], is_over);
        if (track == nullptr || track->cost > node.tracks[place]->cost) {
            continue;
        }
        if (offer(node, robot, track)) {
            if (traffic_) {
                traffic_->exchange(robots_[place], track);
            }
            return true;
        }
    }
    return false;
}

}  // namespace rightofway
