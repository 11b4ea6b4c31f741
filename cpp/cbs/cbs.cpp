#include "cbs/cbs.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cbs/vertex_cover.hpp"

namespace rightofway {
std::size_t PairLosses::Hash::operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::int32_t part : {key.first, key.second, key.first_set, key.second_set}) {
        hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
}

Tick PairLosses::of(RobotId first, SetId first_set, RobotId second, SetId second_set,
                    const StopCondition& is_over) {
    const Key key{first, second, first_set, second_set};
    const auto known = known_.find(key);
    if (known != known_.end()) {
        return known->second;
    }
    ConflictTree tree(tracks_, {first, second}, options_, nullptr);
    const std::array<SetId, 2> sets{first_set, second_set};
    Tick loss = never;
    if (tree.start(sets, is_over)) {
        const Tick alone = tree.bound();
        if (tree.run(never, never, options_.pair_nodes, is_over) != SearchEnd::proven_none) {
            loss = tree.bound() - alone;
        }
    }
    known_.emplace(key, loss);
    return loss;
}

ConflictTree::ConflictTree(ConstrainedTracks& tracks, std::vector<RobotId> robots,
                           const CbsOptions& options, PairLosses* losses)
    : tracks_(tracks),
      robots_(std::move(robots)),
      options_(options),
      losses_(losses),
      finder_(tracks.problem()) {}

bool ConflictTree::start(std::span<const SetId> sets, const StopCondition& is_over) {
    Node root;
    root.sets.assign(sets.begin(), sets.end());
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        const ConstrainedTrack* track = tracks_.best(robots_[k], root.sets[k], is_over);
        if (track == nullptr) {
            bound_ = never;
            return false;
        }
        finder_.take(static_cast<RobotId>(k), *track);
        for (std::size_t other = 0; other < k; ++other) {
            finder_.meet(static_cast<RobotId>(other), *root.tracks[other], root.conflicts);
        }
        root.tracks.push_back(track);
        root.cost += track->cost;
    }
    first_ = bound_ = root.bound = root.cost;
    push(std::move(root), never);
    return true;
}

void ConflictTree::push(Node&& node, Tick upper) {
    if (node.bound >= upper) {
        cut_off_ = std::min(cut_off_, node.bound);
        return;
    }
    bytes_ += bytes_of(node);
    open_.push(OpenList::key(node.bound - first_, static_cast<Tick>(node.conflicts.size())),
               static_cast<std::int32_t>(nodes_.size()));
    nodes_.push_back(std::move(node));
}

std::size_t ConflictTree::bytes_of(const Node& node) {
    return sizeof(Node) + node.sets.size() * (sizeof(SetId) + sizeof(void*)) +
           node.conflicts.size() * sizeof(TrackConflict);
}

SearchEnd ConflictTree::run(Tick upper, Tick enough, std::int64_t most_nodes,
                            const StopCondition& is_over) {
    while (!open_.empty()) {
        const OpenList::Entry top = open_.pop();
        Node node = std::move(nodes_[index(top.node)]);
        bytes_ -= bytes_of(node);
        bound_ = std::max(bound_, std::min({node.bound, upper, cut_off_}));
        // What stops the search in the middle of a node must not lose the node.
        try {
            if (bound_ >= upper || bound_ >= enough || most_nodes-- <= 0 || is_over()) {
                push(std::move(node), never);
                return bound_ >= upper ? SearchEnd::proven_none : SearchEnd::stopped;
            }
            if (options_.clear && !node.is_clear) {
                clear(node, is_over);
                node.is_clear = true;
            }
            if (!node.is_measured) {
                const Tick before = node.bound;
                measure(node, is_over);
                node.is_measured = true;
                if (node.bound > before) {
                    push(std::move(node), upper);
                    continue;
                }
            }
            ++n_nodes_;
            if (split(node, upper, is_over)) {
                found_ = std::move(node.tracks);
                bound_ = node.cost;
                return SearchEnd::found;
            }
        } catch (...) {
            push(std::move(node), never);
            raise_bound(upper);
            throw;
        }
    }
    bound_ = std::max(bound_, std::min(cut_off_, upper));
    return SearchEnd::proven_none;
}

// Takes the least bound of the open nodes and of those left out.
void ConflictTree::raise_bound(Tick upper) {
    Tick least = std::min(upper, cut_off_);
    if (!open_.empty()) {
        const OpenList::Entry top = open_.pop();
        least = std::min(least, nodes_[index(top.node)].bound);
        open_.push(top.key, top.node);
    }
    bound_ = std::max(bound_, least);
}

// Raises the bound of a node by the losses of pairs of robots that conflict. Where it is stopped,
// the pairs solved so far count.
void ConflictTree::measure(Node& node, const StopCondition& is_over) {
    if (losses_ == nullptr) {
        return;
    }
    std::vector<std::pair<RobotId, RobotId>> pairs;
    for (const TrackConflict& conflict : node.conflicts) {
        pairs.push_back(std::minmax(conflict.robot[0], conflict.robot[1]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<WeightedPair> weighted;
    bool is_stopped = false;
    for (auto pair = pairs.begin(); pair != pairs.end() && !is_stopped; ++pair) {
        const auto [first, second] = *pair;
        try {
            const Tick loss =
                losses_->of(robots_[index(first)], node.sets[index(first)], robots_[index(second)],
                            node.sets[index(second)], is_over);
            if (loss >= never) {
                node.bound = never;
                return;
            }
            if (loss > 0) {
                weighted.push_back({index(first), index(second), loss});
            }
        } catch (const Stopped&) {
            is_stopped = true;
        }
    }
    node.bound = std::max(node.bound, node.cost + cover(robots_.size(), std::move(weighted)));
    if (is_stopped) {
        throw Stopped{};
    }
}

// Gives each robot that conflicts a track of equal cost without any conflict, if it has one.
void ConflictTree::clear(Node& node, const StopCondition& is_over) {
    std::vector<RobotId> robots;
    for (const TrackConflict& conflict : node.conflicts) {
        robots.insert(robots.end(), conflict.robot.begin(), conflict.robot.end());
    }
    std::sort(robots.begin(), robots.end());
    robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
    if (robots.empty()) {
        return;
    }
    if (!traffic_) {
        traffic_.emplace(tracks_.problem());
    }
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        traffic_->exchange(robots_[k], node.tracks[k]);
    }
    for (const RobotId robot : robots) {
        const bool conflicts = std::any_of(
            node.conflicts.begin(), node.conflicts.end(), [&](const TrackConflict& one) {
                return one.robot[0] == robot || one.robot[1] == robot;
            });
        if (!conflicts) {
            continue;
        }
        const auto place = index(robot);
        const ConstrainedTrack* track = tracks_.clear(robots_[place], node.sets[place],
                                                      node.tracks[place]->cost, *traffic_, is_over);
        if (track != nullptr) {
            replace(node, robot, track);
        }
        traffic_->exchange(robots_[place], node.tracks[place]);
    }
}

// Makes the children of a node; true if it has no conflict.
bool ConflictTree::split(Node& node, Tick upper, const StopCondition& is_over) {
    const TrackConflict* chosen = choose(node, is_over);
    if (chosen != nullptr) {
        // The children are not complete before both have their tracks, which may be stopped.
        for (const int side : {0, 1}) {
            tracks_.best(robots_[index(chosen->robot[index(side)])], chosen->set[index(side)],
                         is_over);
        }
        for (const int side : {0, 1}) {
            branch(node, chosen->robot[index(side)], chosen->set[index(side)], upper, is_over);
        }
        return false;
    }
    const Problem& problem = tracks_.problem();
    if (problem.rules().rotations || !problem.may_follow()) {
        return true;
    }
    std::vector<RobotId> places(robots_.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        places[k] = static_cast<RobotId>(k);
    }
    const Rotation rotation = find_rotation(problem, places, node.tracks);
    std::vector<SetId> sets;
    for (std::size_t k = 0; k < rotation.robots.size(); ++k) {
        const auto robot = index(rotation.robots[k]);
        sets.push_back(tracks_.sets().with(node.sets[robot], rotation.constraints[k]));
        tracks_.best(robots_[robot], sets.back(), is_over);
    }
    for (std::size_t k = 0; k < rotation.robots.size(); ++k) {
        branch(node, rotation.robots[k], sets[k], upper, is_over);
    }
    return rotation.robots.empty();
}

// Fills in what the robots of a conflict lose by its constraints.
void ConflictTree::weigh(const Node& node, TrackConflict& conflict, const StopCondition& is_over) {
    for (std::size_t side = 0; side < 2; ++side) {
        const auto robot = index(conflict.robot[side]);
        if (conflict.set[side] < 0) {
            conflict.set[side] = tracks_.sets().with(node.sets[robot], conflict.constraint[side]);
        }
        if (conflict.loss[side] < 0 && options_.cardinal) {
            const ConstrainedTrack* track =
                tracks_.best(robots_[robot], conflict.set[side], is_over);
            conflict.loss[side] = track == nullptr ? never : track->cost - node.tracks[robot]->cost;
        }
    }
}

// The conflict to resolve; null if there is none. Changes tracks where that takes conflicts away.
const TrackConflict* ConflictTree::choose(Node& node, const StopCondition& is_over) {
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        TrackConflict* chosen = nullptr;
        const auto key = [](const TrackConflict& one) {
            const auto [less, more] = std::minmax(one.loss[0], one.loss[1]);
            return std::tuple(less, more, -one.constraint[0].start);
        };
        for (TrackConflict& conflict : node.conflicts) {
            weigh(node, conflict, is_over);
            if (options_.bypass && bypass(node, conflict, is_over)) {
                has_changed = true;
                break;
            }
            if (chosen == nullptr || key(conflict) > key(*chosen)) {
                chosen = &conflict;
            }
        }
        if (!has_changed) {
            return chosen;
        }
    }
    return nullptr;
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
        finder_.take(robot, *track);
        met_.clear();
        for (std::size_t other = 0; other < robots_.size(); ++other) {
            if (other != place) {
                finder_.meet(static_cast<RobotId>(other), *node.tracks[other], met_);
            }
        }
        const auto before = std::count_if(node.conflicts.begin(), node.conflicts.end(),
                                          [&](const TrackConflict& one) {
                                              return one.robot[0] == robot || one.robot[1] == robot;
                                          });
        if (static_cast<std::ptrdiff_t>(met_.size()) < before) {
            replace(node, robot, track);
            return true;
        }
    }
    return false;
}

void ConflictTree::branch(const Node& node, RobotId robot, SetId set, Tick upper,
                          const StopCondition& is_over) {
    const ConstrainedTrack* track = tracks_.best(robots_[index(robot)], set, is_over);
    if (track == nullptr) {
        return;
    }
    Node child{node.sets, node.tracks, node.conflicts, node.cost, node.bound, false, false};
    child.sets[index(robot)] = set;
    child.cost += track->cost - node.tracks[index(robot)]->cost;
    child.bound = std::max(node.bound, child.cost);
    if (child.bound < upper) {
        replace(child, robot, track);
    }
    push(std::move(child), upper);
}

// Gives a robot another track, and the node the conflicts of that.
void ConflictTree::replace(Node& node, RobotId robot, const ConstrainedTrack* track) {
    node.tracks[index(robot)] = track;
    std::erase_if(node.conflicts, [&](const TrackConflict& one) {
        return one.robot[0] == robot || one.robot[1] == robot;
    });
    finder_.take(robot, *track);
    for (std::size_t other = 0; other < robots_.size(); ++other) {
        if (other != index(robot)) {
            finder_.meet(static_cast<RobotId>(other), *node.tracks[other], node.conflicts);
        }
    }
}

}  // namespace rightofway
