#include "cbs/cbs.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "cbs/vertex_cover.hpp"

namespace rightofway {
namespace {

constexpr std::int64_t no_factor = 1'000'000;  // a factor of 1 [millionths]

// For all tracks of two robots: how much more than least they cost at most [ticks], and how many
// pairs of their phases are searched, of tracks of least cost and of others.
constexpr Tick most_slack = 16;
constexpr std::size_t most_pairs_of_best = 400'000;
constexpr std::size_t most_pairs = 100'000;

}  // namespace

std::size_t PairLosses::Hash::operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::int32_t part : {key.robots[0], key.robots[1], key.sets[0], key.sets[1]}) {
        hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
}

PairLoss& PairLosses::of(const Key& key, const StopCondition& is_over) {
    const auto known = known_.find(key);
    if (known != known_.end()) {
        return known->second;
    }
    // A tree of few nodes takes less time than all tracks, and most pairs do not need more.
    PairLoss loss;
    ConflictTree tree(tracks_, {key.robots.begin(), key.robots.end()}, options_, nullptr);
    if (!tree.start(key.sets, is_over)) {
        loss.together = never;
    } else {
        const Tick alone = tree.bound();
        const SearchEnd end = tree.run(never, never, options_.pair_nodes, is_over);
        loss.together = end == SearchEnd::proven_none ? never : tree.bound() - alone;
        if (end == SearchEnd::stopped && options_.mdds) {
            if (const auto by_all = by_mdds(key, is_over)) {
                loss.together = std::max(loss.together, by_all->together);
                loss.either = by_all->either;
            }
        }
    }
    return known_.emplace(key, loss).first->second;
}

// Searches all tracks that cost little more than the best ones; how much more, doubles until there
// are two that keep clear of each other. Then the least sum is known, and all pairs of completions
// up to there. Null if not even the best tracks can be searched, or if not enough is known.
std::optional<PairLoss> PairLosses::by_mdds(const Key& key, const StopCondition& is_over) {
    const Problem& problem = tracks_.problem();
    if (problem.rules().headway > 0 || problem.has_surcharges()) {
        return std::nullopt;
    }
    std::array<Tick, 2> least{};
    std::array<Tick, 2> weight{};
    for (std::size_t side = 0; side < 2; ++side) {
        const ConstrainedTrack* best = tracks_.best(key.robots[side], key.sets[side], is_over);
        if (best == nullptr) {
            return std::nullopt;
        }
        least[side] = best->completion;
        weight[side] = problem.weight(key.robots[side]);
    }
    const Tick step =
        std::min(problem.quickest_edge(key.robots[0]), problem.quickest_edge(key.robots[1]));
    Tick beyond = 0;  // all pairs are known in which each robot loses less
    std::vector<std::array<Tick, 2>> losses;
    for (Tick most = 0; losses.empty() && most <= most_slack; most = std::max(step, 2 * most)) {
        const TrackGraph* first = tracks_.graph(key.robots[0], key.sets[0], least[0] + most);
        const TrackGraph* second = tracks_.graph(key.robots[1], key.sets[1], least[1] + most);
        if (first == nullptr || second == nullptr) {
            break;
        }
        if (!joint_.search(problem, *first, *second, most == 0,
                           most == 0 ? most_pairs_of_best : most_pairs, is_over)) {
            break;
        }
        beyond = most + 1;
        losses = joint_.completions();
    }
    if (losses.empty() && beyond == 0) {
        return std::nullopt;
    }
    PairLoss loss{.together = beyond * std::min(weight[0], weight[1])};
    for (std::array<Tick, 2>& one : losses) {
        one = {one[0] - least[0], one[1] - least[1]};
        loss.together = std::min(loss.together, one[0] * weight[0] + one[1] * weight[1]);
    }
    // Where the first robot loses less than p, the second one loses q or more.
    losses.push_back({beyond, 0});
    for (const auto& [p, unused] : losses) {
        Tick q = beyond;
        for (const auto& [first, second] : losses) {
            q = first < p ? std::min(q, second) : q;
        }
        const std::array<Tick, 2> either{p * weight[0], q * weight[1]};
        if (p > 0 &&
            std::minmax(either[0], either[1]) > std::minmax(loss.either[0], loss.either[1])) {
            loss.either = either;
        }
    }
    return loss;
}

// What two robots lose together at least if neither costs more than this; `never` if they cannot.
Tick PairLosses::bound_within(const Key& key, std::array<Tick, 2> costs,
                              const StopCondition& is_over) {
    ConflictTree tree(tracks_, {key.robots.begin(), key.robots.end()}, options_, nullptr);
    tree.limit({costs.begin(), costs.end()});
    if (!tree.start(key.sets, is_over)) {
        return never;
    }
    const Tick alone = tree.bound();
    const SearchEnd end = tree.run(never, never, options_.pair_nodes, is_over);
    return end == SearchEnd::proven_none ? never : tree.bound() - alone;
}

Tick PairLosses::together(std::array<RobotId, 2> robots, std::array<SetId, 2> sets,
                          const StopCondition& is_over) {
    return of({robots, sets}, is_over).together;
}

// Where neither robot costs more than its least cost, the other one loses all. Between these two
// ends lie plans in which both lose; if there are none below both ends, the ends are the bounds.
std::array<Tick, 2> PairLosses::either(std::array<RobotId, 2> robots, std::array<SetId, 2> sets,
                                       const StopCondition& is_over) {
    const Key key{robots, sets};
    PairLoss& loss = of(key, is_over);
    if (loss.either[0] >= 0) {
        return loss.either;
    }
    std::array<Tick, 2> least{};
    std::array<Tick, 2> ends{};
    for (std::size_t side = 0; side < 2; ++side) {
        least[side] = tracks_.best(robots[side], sets[side], is_over)->cost;
    }
    for (std::size_t side = 0; side < 2; ++side) {
        std::array<Tick, 2> most{never, never};
        most[1 - side] = least[1 - side];
        ends[side] = std::max(loss.together, bound_within(key, most, is_over));
    }
    const auto below = [&](std::size_t side) {
        return ends[side] >= never ? never : least[side] + ends[side] - 1;
    };
    if (bound_within(key, {below(0), below(1)}, is_over) >= never) {
        loss.either = ends;
    } else {
        // Losses that add up to less than what both lose together are not possible either.
        const Tick half = (loss.together + 1) / 2;
        loss.either = {half, loss.together + 1 - half};
        for (const std::array<Tick, 2> other : {std::array<Tick, 2>{1, ends[1]}, {ends[0], 1}}) {
            if (std::minmax(other[0], other[1]) > std::minmax(loss.either[0], loss.either[1])) {
                loss.either = other;
            }
        }
    }
    return loss.either;
}

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
}

bool ConflictTree::start(std::span<const SetId> sets, const StopCondition& is_over) {
    Node root;
    root.sets.assign(sets.begin(), sets.end());
    for (std::size_t k = 0; k < robots_.size(); ++k) {
        const ConstrainedTrack* track = tracks_.best(robots_[k], root.sets[k], is_over);
        if (track == nullptr || (!most_.empty() && track->cost > most_[k])) {
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
    return tracks_.clearest(robots_[place], node.sets[place], most, *traffic_, is_over);
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

// Makes the children of a node; true if it has no conflict.
bool ConflictTree::split(Node& node, Tick upper, const StopCondition& is_over) {
    std::vector<std::pair<RobotId, SetId>> changes;
    if (const std::optional<TrackConflict> chosen = choose(node, is_over)) {
        for (std::size_t side = 0; side < 2; ++side) {
            changes.emplace_back(chosen->robot[side], chosen->set[side]);
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
            children.push_back(std::move(*one));
        }
    }
    for (Node& one : children) {
        push(std::move(one), upper);
    }
    return changes.empty();
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
    if (track == nullptr || (!most_.empty() && track->cost > most_[place])) {
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

}  // namespace rightofway
