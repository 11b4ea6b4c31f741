#include "cbs/cbs.hpp"

#include <algorithm>
#include <utility>

#include "cbs/vertex_cover.hpp"

namespace rightofway {
namespace {

constexpr std::int64_t no_factor = 1'000'000;  // a factor of 1 [millionths]

// For how many nodes of the tree `joint_states` are searched.
constexpr std::int64_t nodes_per_states = 50;

}  // namespace

ConflictTree::ConflictTree(ConstrainedTracks& tracks, std::vector<RobotId> robots,
                           const CbsOptions& options, PairLosses* losses)
    : tracks_(tracks),
      robots_(std::move(robots)),
      options_(options),
      losses_(losses),
      finder_(tracks.problem(), options.targets) {
    if (robots_.size() == static_cast<std::size_t>(tracks.problem().n_robots())) {
        traffic_.emplace(tracks.problem());
    }
    most_.assign(robots_.size(), never);
    for (std::size_t k = 0; k < robots_.size() && options.latest < never; ++k) {
        most_[k] = tracks.problem().weight(robots_[k]) * options.latest;
    }
}

void ConflictTree::limit(std::span<const Tick> most) {
    for (std::size_t k = 0; k < most_.size(); ++k) {
        most_[k] = std::min(most_[k], most[k]);
    }
}

bool ConflictTree::start(std::span<const SetId> sets, const StopCondition& is_over) {
    Node root;
    root.sets.assign(sets.begin(), sets.end());
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        const ConstrainedTrack* track = tracks_.best(robots_[k], root.sets[k], is_over);
        if (track == nullptr || track->cost > most_[k]) {
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
    sets_ = root.sets;
    first_ = bound_ = root.bound = root.least = root.cost;
    push(std::move(root), never);
    return true;
}

void ConflictTree::push(Node&& node, Tick upper) {
    if (node.bound >= upper) {
        cut_off_ = std::min(cut_off_, node.bound);
        return;
    }
    bytes_ += bytes_of(node);
    const auto id = static_cast<std::int32_t>(nodes_.size());
    const auto n_conflicts = static_cast<Tick>(node.conflicts.size());
    open_.push(OpenList::key(node.bound - first_, n_conflicts), id);
    if (options_.factor > no_factor) {
        costly_.push(OpenList::key(node.cost - first_, n_conflicts), id);
    }
    node.is_open = true;
    nodes_.push_back(std::move(node));
}

std::size_t ConflictTree::bytes_of(const Node& node) {
    return sizeof(Node) + node.sets.size() * (sizeof(SetId) + sizeof(void*)) +
           node.conflicts.size() * sizeof(TrackConflict);
}

// The open node of least bound; `none` if no node is open.
std::int32_t ConflictTree::least_open() {
    while (!open_.empty()) {
        const OpenList::Entry top = open_.pop();
        if (nodes_[index(top.node)].is_open) {
            open_.push(top.key, top.node);
            return top.node;
        }
    }
    return none;
}

// What a plan may cost to be enough: the factor times the bound.
Tick ConflictTree::most_cost() const {
    if (options_.factor <= no_factor || bound_ > never / options_.factor) {
        return bound_;
    }
    return bound_ * options_.factor / no_factor;
}

// Focal search: in turn the open node of least bound, which raises the bound of all plans, and the
// node with the fewest conflicts of those that cost little enough, which is nearest to a plan.
std::int32_t ConflictTree::take(std::int32_t least) {
    while (!costly_.empty()) {
        const OpenList::Entry top = costly_.pop();
        const Node& node = nodes_[index(top.node)];
        if (node.is_open && node.cost > most_cost()) {
            costly_.push(top.key, top.node);
            break;
        }
        if (node.is_open) {
            focal_.push(OpenList::key(static_cast<Tick>(node.conflicts.size()), node.cost - first_),
                        top.node);
        }
    }
    takes_least_ = !takes_least_;
    while (!takes_least_ && !focal_.empty()) {
        const OpenList::Entry top = focal_.pop();
        if (nodes_[index(top.node)].is_open) {
            return top.node;
        }
    }
    return least;
}

SearchEnd ConflictTree::run(Tick upper, Tick enough, std::int64_t most_nodes,
                            const StopCondition& is_over) {
    for (std::int32_t least = least_open(); least != none; least = least_open()) {
        raise_bound(upper);
        if (bound_ >= upper) {
            return SearchEnd::proven_none;
        }
        if (bound_ >= enough || most_nodes-- <= 0 || is_over()) {
            return SearchEnd::stopped;
        }
        if (const auto end = search_joint_states(upper, is_over)) {
            return *end;
        }
        const std::int32_t id = take(least);
        Node node = std::move(nodes_[index(id)]);
        nodes_[index(id)].is_open = false;
        bytes_ -= bytes_of(node);
        // What stops the search in the middle of a node must not lose the node.
        try {
            load(node);
            if (options_.clear && !node.is_clear) {
                clear(node, is_over);
                node.is_clear = true;
            }
            if (!node.is_measured && id == least) {
                const Tick before = node.bound;
                measure(node, is_over);
                node.is_measured = true;
                if (node.bound > before) {
                    push(std::move(node), upper);
                    continue;
                }
            }
            ++n_nodes_;
            if (losses_ != nullptr) {
                losses_->allow(joint_states(nodes_per_states + n_nodes_));
            }
            if (split(node, upper, is_over)) {
                if (node.cost <= most_cost()) {
                    found_ = std::move(node.tracks);
                    return SearchEnd::found;
                }
                take_best(node, is_over);
                push(std::move(node), upper);
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
    if (const std::int32_t node = least_open(); node != none) {
        least = std::min(least, nodes_[index(node)].bound);
    }
    bound_ = std::max(bound_, least);
}

void ConflictTree::load(const Node& node) {
    if (traffic_) {
        for (std::size_t k = 0; k < robots_.size(); ++k) {
            traffic_->exchange(robots_[k], node.tracks[k]);
        }
    }
}

std::vector<std::pair<RobotId, RobotId>> ConflictTree::pairs_in_conflict(const Node& node) const {
    std::vector<std::pair<RobotId, RobotId>> pairs;
    for (const TrackConflict& conflict : node.conflicts) {
        pairs.push_back(std::minmax(conflict.robot[0], conflict.robot[1]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

// Raises the bound of a node by the losses of pairs of robots that conflict. Where it is stopped,
// the pairs solved so far count.
void ConflictTree::measure(Node& node, const StopCondition& is_over) {
    if (losses_ == nullptr) {
        return;
    }
    std::vector<WeightedPair> weighted;
    bool is_stopped = false;
    for (const auto& [first, second] : pairs_in_conflict(node)) {
        try {
            const Tick loss =
                losses_->together({robots_[index(first)], robots_[index(second)]},
                                  {node.sets[index(first)], node.sets[index(second)]}, is_over);
            if (loss >= never) {
                node.bound = never;
                return;
            }
            if (loss > 0) {
                weighted.push_back({index(first), index(second), loss});
            }
        } catch (const Stopped&) {
            is_stopped = true;
            break;
        }
    }
    node.bound = std::max(node.bound, node.least + cover(robots_.size(), std::move(weighted)));
    if (is_stopped) {
        throw Stopped{};
    }
}

// A track of a robot with few conflicts: of no higher cost or, with a factor, of a cost that leaves
// the node near enough to the bound. Null if there is none. The traffic is that of the node.
const ConstrainedTrack* ConflictTree::clearest(const Node& node, RobotId robot,
                                               const StopCondition& is_over) {
    const auto place = index(robot);
    const Tick cost = node.tracks[place]->cost;
    const Tick most =
        options_.factor > no_factor ? std::max(cost, most_cost() - (node.cost - cost)) : cost;
    return tracks_.clearest(robots_[place], node.sets[place], std::min(most, most_[place]),
                            *traffic_, is_over);
}

// Gives each robot that conflicts a track with fewer conflicts, if it has one.
void ConflictTree::clear(Node& node, const StopCondition& is_over) {
    if (!traffic_) {
        return;
    }
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        const auto robot = static_cast<RobotId>(k);
        if (count_conflicts(node, robot) > 0) {
            const ConstrainedTrack* track = clearest(node, robot, is_over);
            if (track != nullptr) {
                offer(node, robot, track);
            }
            traffic_->exchange(robots_[k], node.tracks[k]);
        }
    }
}

// Gives each robot its best track, so that the node costs no more than its bound.
void ConflictTree::take_best(Node& node, const StopCondition& is_over) {
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        const ConstrainedTrack* best = tracks_.best(robots_[k], node.sets[k], is_over);
        if (best->cost < node.tracks[k]->cost) {
            replace(node, static_cast<RobotId>(k), best);
        }
    }
}

std::ptrdiff_t ConflictTree::count_conflicts(const Node& node, RobotId robot) {
    return std::count_if(
        node.conflicts.begin(), node.conflicts.end(),
        [&](const TrackConflict& one) { return one.robot[0] == robot || one.robot[1] == robot; });
}

// Gives a robot another track if that has fewer conflicts.
bool ConflictTree::offer(Node& node, RobotId robot, const ConstrainedTrack* track) {
    met_.clear();
    meet_others(node, robot, *track, met_);
    if (static_cast<std::ptrdiff_t>(met_.size()) >= count_conflicts(node, robot)) {
        return false;
    }
    replace(node, robot, track);
    return true;
}

// Appends the conflicts of a track with the tracks of the other robots of a node. The traffic, if
// there is one, has these tracks.
void ConflictTree::meet_others(const Node& node, RobotId robot, const ConstrainedTrack& track,
                               std::vector<TrackConflict>& conflicts) {
    if (!traffic_) {
        finder_.take(robot, track);
        for (std::size_t other = 0; other < robots_.size(); ++other) {
            if (other != index(robot)) {
                finder_.meet(static_cast<RobotId>(other), *node.tracks[other], conflicts);
            }
        }
        return;
    }
    const auto& met = traffic_->robots_met(robot, track);
    if (!met.empty()) {
        finder_.take(robot, track);
    }
    for (const RobotId other : met) {
        finder_.meet(other, *node.tracks[index(other)], conflicts);
    }
}

// A child of the node whose tracks the traffic has, if its robot has a track.
std::optional<ConflictTree::Node> ConflictTree::child(const Node& node, RobotId robot, SetId set,
                                                      Tick upper, const StopCondition& is_over) {
    const auto place = index(robot);
    const ConstrainedTrack* track = tracks_.best(robots_[place], set, is_over);
    if (track == nullptr || track->cost > most_[place]) {
        return std::nullopt;
    }
    Node one{.sets = node.sets,
             .tracks = node.tracks,
             .conflicts = node.conflicts,
             .cost = node.cost,
             .least = node.least,
             .bound = node.bound};
    one.least += track->cost - tracks_.best(robots_[place], node.sets[place], is_over)->cost;
    one.sets[place] = set;
    one.bound = std::max(node.bound, one.least);
    if (one.bound >= upper) {
        return one;
    }
    replace(one, robot, track);
    if (options_.clear && traffic_ && count_conflicts(one, robot) > 0) {
        const ConstrainedTrack* other = clearest(one, robot, is_over);
        if (other != nullptr) {
            offer(one, robot, other);
        }
        traffic_->exchange(robots_[place], node.tracks[place]);
    }
    one.is_clear = true;
    return one;
}

// Gives a robot another track, and the node the conflicts of that.
void ConflictTree::replace(Node& node, RobotId robot, const ConstrainedTrack* track) {
    node.cost += track->cost - node.tracks[index(robot)]->cost;
    node.tracks[index(robot)] = track;
    std::erase_if(node.conflicts, [&](const TrackConflict& one) {
        return one.robot[0] == robot || one.robot[1] == robot;
    });
    meet_others(node, robot, *track, node.conflicts);
}

// How many joint states match some nodes of the tree.
std::int64_t ConflictTree::joint_states(std::int64_t n_nodes) const {
    const std::int64_t states = options_.joint_states;
    return states > never / n_nodes ? never : states * n_nodes / nodes_per_states;
}

// Searches the joint states of a whole fleet of few robots, with as many states as match the nodes
// of the tree: it decides where the tree does not, as it ends also where there is no plan. Null if
// it decides nothing; the bound is raised by it.
std::optional<SearchEnd> ConflictTree::search_joint_states(Tick upper,
                                                           const StopCondition& is_over) {
    if (robots_.size() > JointSearch::most_robots || options_.joint_states == 0 ||
        n_nodes_ < next_joint_search_) {
        return std::nullopt;
    }
    JointPlan plan =
        tracks_.together(robots_, sets_, most_, joint_states(next_joint_search_), is_over);
    next_joint_search_ *= 2;
    bound_ = std::max(bound_, std::min(plan.bound, upper));
    if (plan.end == SearchEnd::stopped) {
        return std::nullopt;
    }
    if (plan.bound >= upper) {
        return SearchEnd::proven_none;
    }
    found_ = std::move(plan.tracks);
    return SearchEnd::found;
}

}  // namespace rightofway
