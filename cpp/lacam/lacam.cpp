#include "lacam/lacam.hpp"

#include <algorithm>
#include <numeric>

namespace rightofway {
namespace {

constexpr std::int64_t effort_between_questions = 4096;
constexpr std::int32_t levels_between_snapshots = 32;
constexpr std::size_t most_snapshots = 16;
constexpr Tick longest_wait = Tick{1} << 31;  // that urgencies tell apart: no product overflows

}  // namespace

Lacam::Lacam(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
             std::uint64_t seed, std::span<const std::uint8_t> ends_anywhere)
    : problem_(problem),
      in_steps_(problem.moves_in_steps()),
      ends_anywhere_(ends_anywhere),
      pibt_(problem, tables, paths, seed),
      start_(problem),
      state_(start_),
      state_of_(none),
      rank_(static_cast<std::size_t>(problem.n_robots())),
      goal_(none) {
    std::vector<std::int32_t> way(static_cast<std::size_t>(problem.n_robots()));
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        way[index(r)] = tables.steps(tables.table_of(start_.target(r)), problem.home(r));
    }
    std::vector<RobotId> robots(static_cast<std::size_t>(problem.n_robots()));
    std::iota(robots.begin(), robots.end(), 0);
    std::sort(robots.begin(), robots.end(), [&way](RobotId left, RobotId right) {
        return way[index(left)] != way[index(right)] ? way[index(left)] > way[index(right)]
                                                     : left < right;
    });
    for (std::size_t k = 0; k < robots.size(); ++k) {
        rank_[index(robots[k])] = static_cast<std::int32_t>(k);
    }
}

SearchEnd Lacam::run(const StopCondition& is_over, std::int64_t most_effort) {
    add(none, 0);
    std::int64_t next_question = 0;
    for (; !open_.empty(); ++n_replayed_) {
        const std::int64_t effort = pibt_.n_choices() + n_replayed_;
        if (effort >= next_question) {
            next_question = effort + effort_between_questions;
            if (effort > most_effort || is_over()) {
                return SearchEnd::stopped;
            }
        }
        if (expand() == SearchEnd::found) {
            return SearchEnd::found;
        }
    }
    return in_steps_ ? SearchEnd::proven_none : SearchEnd::stopped;
}

// Whether every robot is on its last stage and at its vertex, or may end anywhere.
bool Lacam::is_goal() const {
    if (ends_anywhere_.empty()) {
        return state_.is_goal();
    }
    const auto may_end = [&](RobotId r) {
        return state_.has_arrived(r) || (ends_anywhere_[index(r)] != 0 && !state_.is_busy(r) &&
                                         problem_.is_last(r, state_.stage(r)));
    };
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        if (!may_end(r)) {
            return false;
        }
    }
    return true;
}

SearchEnd Lacam::expand() {
    const std::int32_t top = open_.back();
    restore(top);
    if (is_goal()) {
        goal_ = top;
        return SearchEnd::found;
    }
    if (!next_constraint(nodes_[index(top)])) {
        open_.pop_back();  // all constraints are tried
        return SearchEnd::stopped;
    }
    if (pibt_.choose(state_, by_urgency())) {
        generate_successor(top);
    }
    return SearchEnd::stopped;
}

// Fixes the robots of the node's next constraint; false if none is left. The children of a
// constraint (one more robot fixed) are added lazily.
bool Lacam::next_constraint(Node& node) {
    if (node.next_constraint > node.constraints.size()) {
        return false;  // no constraint was left before
    }
    const auto k = static_cast<std::int32_t>(node.next_constraint++);
    if (k == 0) {
        node.constraints.push_back({none, 0, none, none});
    } else {
        branch(node, k - 1);
    }
    if (node.next_constraint > node.constraints.size()) {
        return false;
    }
    for (std::int32_t c = k; node.constraints[index(c)].depth > 0;
         c = node.constraints[index(c)].parent) {
        pibt_.fix(node.constraints[index(c)].robot, node.constraints[index(c)].vertex);
    }
    return true;
}

// Adds the children of a constraint: one more robot fixed, to each neighbour or to its own vertex.
void Lacam::branch(Node& node, std::int32_t constraint) {
    if (constraint == 0) {
        const auto undecided = by_urgency();
        node.order.assign(undecided.begin(), undecided.end());
        for (RobotId r = 0; r < problem_.n_robots(); ++r) {
            if (state_.has_arrived(r)) {
                node.order.push_back(r);
            }
        }
    }
    const std::int32_t depth = node.constraints[index(constraint)].depth;
    if (depth == static_cast<std::int32_t>(node.order.size())) {
        return;
    }
    const RobotId robot = node.order[index(depth)];
    const VertexId here = state_.at(robot);
    for (const VertexId head : problem_.graph().heads(here)) {
        if (problem_.may_drive(robot, here, head)) {
            node.constraints.push_back({constraint, depth + 1, robot, head});
        }
    }
    node.constraints.push_back({constraint, depth + 1, robot, here});
}

// Undecided robots by urgency: pace times ticks since the last stage; ties by the longer way.
std::span<const RobotId> Lacam::by_urgency() {
    urgencies_.clear();
    for (const RobotId robot : state_.undecided()) {
        const Tick waited = state_.now() - state_.on_its_way_since(robot);
        const Tick urgency = pibt_.pace(robot) * std::min(waited, longest_wait);
        urgencies_.push_back({urgency, rank_[index(robot)], robot});
    }
    std::sort(urgencies_.begin(), urgencies_.end(), [](const Urgency& left, const Urgency& right) {
        return left.urgency != right.urgency ? left.urgency > right.urgency
                                             : left.rank < right.rank;
    });
    order_.clear();
    for (const Urgency& one : urgencies_) {
        order_.push_back(one.robot);
    }
    return order_;
}

// Applies the decisions and advances the clock to the next state.
void Lacam::generate_successor(std::int32_t from) {
    const std::size_t first = decisions_.size();
    for (const Decision& decision : pibt_.decisions()) {
        if (!in_steps_) {
            decisions_.push_back(decision);
        }
        state_.decide(decision);
    }
    if (!state_.advance()) {
        return;  // no robot is busy, so the state cannot change
    }
    state_of_ = none;
    if (!add(from, first)) {
        decisions_.resize(first);
        open_.push_back(known_node());
    }
}

// The node with this state; `none` if the state is new.
std::int32_t Lacam::known_node() const {
    const auto is_same = [&](const auto& entry) {
        if (!in_steps_) {
            return true;
        }
        const auto robots = standing(entry.second);
        for (RobotId r = 0; r < problem_.n_robots(); ++r) {
            if (robots[index(r)].at != state_.at(r) || robots[index(r)].stage != state_.stage(r)) {
                return false;
            }
        }
        return true;
    };
    const auto [first, last] = known_.equal_range(state_.fingerprint());
    const auto known = std::find_if(first, last, is_same);
    return known == last ? none : known->second;
}

std::span<const Standing> Lacam::standing(std::int32_t node) const {
    const auto n_robots = static_cast<std::size_t>(problem_.n_robots());
    return std::span(standing_).subspan(index(node) * n_robots, n_robots);
}

// Adds a node for the state; false if the state is known.
bool Lacam::add(std::int32_t parent, std::size_t first_decision) {
    if (known_node() != none) {
        return false;
    }
    const auto node = static_cast<std::int32_t>(nodes_.size());
    known_.emplace(state_.fingerprint(), node);
    for (RobotId r = 0; in_steps_ && r < problem_.n_robots(); ++r) {
        standing_.push_back(state_.standing(r));
    }
    state_of_ = node;
    const std::int32_t level = parent == none ? 0 : nodes_[index(parent)].level + 1;
    nodes_.push_back({parent, level, first_decision, decisions_.size(), 0, {}, {}});
    open_.push_back(node);
    return true;
}

void Lacam::restore(std::int32_t node) {
    if (state_of_ == node) {
        return;
    }
    if (in_steps_) {
        state_.resume(standing(node));
        state_of_ = node;
        n_replayed_ += problem_.n_robots();
        return;
    }
    std::vector<std::int32_t> path;
    const Snapshot* snapshot = nullptr;
    for (std::int32_t step = node; step != none && snapshot == nullptr;
         step = nodes_[index(step)].parent) {
        snapshot = snapshot_of(step);
        if (snapshot == nullptr) {
            path.push_back(step);
        }
    }
    state_ = snapshot == nullptr ? start_ : snapshot->state;
    for (auto step = path.rbegin(); step != path.rend(); ++step) {
        replay_step(*step);
        keep_snapshot(*step);
    }
    state_of_ = node;
}

void Lacam::replay_step(std::int32_t node) {
    const Node& taken = nodes_[index(node)];
    for (std::size_t k = taken.first_decision; k < taken.end_decision; ++k) {
        state_.decide(decisions_[k]);
    }
    n_replayed_ += 1 + static_cast<std::int64_t>(taken.end_decision - taken.first_decision);
    if (taken.parent != none) {
        state_.advance();
    }
}

const Lacam::Snapshot* Lacam::snapshot_of(std::int32_t node) const {
    const auto found = std::find_if(snapshots_.begin(), snapshots_.end(),
                                    [node](const Snapshot& one) { return one.node == node; });
    return found == snapshots_.end() ? nullptr : &*found;
}

void Lacam::keep_snapshot(std::int32_t node) {
    if (nodes_[index(node)].level % levels_between_snapshots != 0) {
        return;
    }
    if (snapshots_.size() < most_snapshots) {
        snapshots_.push_back({node, state_});
    } else {
        snapshots_[oldest_snapshot_] = {node, state_};
        oldest_snapshot_ = (oldest_snapshot_ + 1) % most_snapshots;
    }
}

Tracks Lacam::tracks() const {
    Tracks tracks;
    if (goal_ == none) {
        return tracks;
    }
    std::vector<std::int32_t> path;
    for (std::int32_t node = goal_; node != none; node = nodes_[index(node)].parent) {
        path.push_back(node);
    }
    std::reverse(path.begin(), path.end());
    std::vector<VisitId> next(static_cast<std::size_t>(problem_.n_robots()) + 1, 1);
    next[0] = 0;
    for (const std::int32_t node : path) {
        for_each_decision(node,
                          [&next](const Decision& decision) { ++next[index(decision.robot + 1)]; });
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    tracks.first_visit = next;
    tracks.vertex.resize(static_cast<std::size_t>(next.back()));
    tracks.enter.resize(tracks.vertex.size());
    const auto enter = [&](RobotId robot, VertexId vertex, Tick tick) {
        tracks.vertex[index(next[index(robot)])] = vertex;
        tracks.enter[index(next[index(robot)]++)] = tick;
    };
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        enter(r, problem_.home(r), 0);
    }
    for (const std::int32_t node : path) {
        for_each_decision(node, [&enter](const Decision& decision) {
            enter(decision.robot, decision.vertex, decision.arrival);
        });
    }
    return tracks;
}

// Calls `use` with each decision that led from the parent of a node to the node.
template <class Use>
void Lacam::for_each_decision(std::int32_t node, const Use& use) const {
    const Node& reached = nodes_[index(node)];
    for (std::size_t k = reached.first_decision; k < reached.end_decision; ++k) {
        use(decisions_[k]);
    }
    if (!in_steps_ || reached.parent == none) {
        return;
    }
    const auto before = standing(reached.parent);
    const auto after = standing(node);
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        if (before[index(r)].at != after[index(r)].at) {
            use(Decision{r, after[index(r)].at, reached.level});
        }
    }
}

}  // namespace rightofway
