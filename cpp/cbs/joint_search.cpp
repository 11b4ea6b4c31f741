#include "cbs/joint_search.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rightofway {
namespace {

bool is_finite(Tick tick) { return tick < never; }

}  // namespace

SearchEnd JointSearch::run(std::span<const GroupMember> members, std::int64_t most_nodes,
                           const StopCondition& is_over, const KnownPlan* known) {
    is_over_ = &is_over;
    n_states_ = n_steps_ = 0;
    prepare(members, known);
    start();
    while (!open_.empty()) {
        const std::int32_t node = open_.pop().node;
        const Node& here = nodes_[index(node)];
        if (is_known(here.first, node, here.now, here.cost)) {
            continue;
        }
        bound_ = std::max(bound_, here.least);
        bool is_goal = true;
        for (std::size_t k = 0; k < size_; ++k) {
            is_goal = is_goal && robots_[k].has_ended(state_of(node, k));
        }
        if (is_goal) {
            goal_ = node;
            return SearchEnd::found;
        }
        if (n_states_ >= most_nodes) {
            return SearchEnd::stopped;
        }
        ++n_states_;
        expand(node);
    }
    return SearchEnd::proven_none;
}

// Asked in each step of the product of choices: one state of many robots has very many successors.
void JointSearch::stop_if_over() {
    constexpr std::int64_t steps_between_questions = 1024;
    if (n_steps_++ % steps_between_questions == 0 && (*is_over_)()) {
        throw Stopped{};
    }
}

void JointSearch::prepare(std::span<const GroupMember> members, const KnownPlan* known) {
    size_ = members.size();
    const bool books_ahead = problem_.rules().books_ahead;
    rules_ = {};
    rules_.every_tick = known != nullptr || (problem_.has_sizes() && !books_ahead);
    rules_.begins_drives = books_ahead || rules_.every_tick;
    rules_.parts = known == nullptr ? 1 : most_actions + 1;
    limit_ = known == nullptr || known->cost >= never / rules_.parts
                 ? never
                 : known->cost * rules_.parts + known->actions;
    while (robots_.size() < size_) {
        robots_.emplace_back(problem_, closures_, rules_);
    }
    choices_.resize(std::max(choices_.size(), size_));
    has_latest_ = false;
    Tick last = 0;
    Tick longest = 0;
    const auto note = [&](Tick tick) {
        rules_.closes_for_ever = rules_.closes_for_ever || !is_finite(tick);
        last = is_finite(tick) ? std::max(last, tick) : last;
    };
    for (std::size_t k = 0; k < problem_.closures().row.size(); ++k) {
        note(problem_.closures().start[k]);
        note(problem_.closures().end[k]);
    }
    for (std::size_t k = 0; k < size_; ++k) {
        for (const Constraint& one : members[k].constraints) {
            note(one.start);
            note(one.end);
        }
        robots_[k].prepare(members[k]);
        has_latest_ = has_latest_ || is_finite(members[k].most);
        longest = std::max(longest, problem_.slowest_edge(members[k].robot));
    }
    rules_.horizon = last + longest + problem_.rules().headway + 1;
    nodes_.clear();
    states_.clear();
    edges_.clear();
    known_.clear();
    open_.clear();
    chosen_.clear();
    bound_ = 0;
    goal_ = none;
}

// Each robot at home, in each combination of what they can do there.
void JointSearch::start() {
    first_ = 0;
    for (std::size_t k = 0; k < size_; ++k) {
        robots_[k].list_begins(choices_[k]);
        if (choices_[k].empty()) {
            return;
        }
        Tick least = never;
        for (const Choice& choice : choices_[k]) {
            const Tick rest = std::min(robots_[k].facts(choice.state).rest, conflict_cap);
            const bool ends = robots_[k].state(choice.state).ends;
            least = std::min(least, ends ? choice.cost : robots_[k].weight() * rest);
        }
        first_ += least;
    }
    node_ = none;
    std::vector<std::size_t> taken(size_, 0);
    for (bool is_more = true; is_more;) {
        stop_if_over();
        chosen_.clear();
        Tick cost = 0;
        bool is_valid = true;
        for (std::size_t k = 0; k < size_; ++k) {
            const Choice& choice = choices_[k][taken[k]];
            is_valid = is_valid && is_allowed(k, choice);
            chosen_.push_back(choice);
            cost += choice.cost;
        }
        if (is_valid) {
            after_.clear();
            for (const Choice& choice : chosen_) {
                after_.push_back(choice.state);
            }
            reach(0, cost);
        }
        is_more = false;
        for (std::size_t k = 0; k < size_ && !is_more; ++k) {
            is_more = ++taken[k] < choices_[k].size();
            taken[k] = is_more ? taken[k] : 0;
        }
    }
}

// Whether another node of a state makes one of this instant and cost useless.
bool JointSearch::is_known(std::int32_t first, std::int32_t node, Tick now, Tick cost) const {
    for (std::int32_t other = first; other != none; other = nodes_[index(other)].next) {
        const Node& one = nodes_[index(other)];
        if (other != node && one.cost <= cost && (!has_latest_ || one.now <= now)) {
            return true;
        }
    }
    return false;
}

// Adds a node for the states `after_`, unless they are known at no greater cost.
void JointSearch::reach(Tick now, Tick cost) {
    Tick least = cost;
    Tick rest = 0;
    std::uint64_t hash = mix_in(0, std::min(now, rules_.horizon));
    for (std::size_t k = 0; k < size_; ++k) {
        const RobotStates& robot = robots_[k];
        hash = mix_in(hash, after_[k]);
        if (robot.state(after_[k]).ends) {
            continue;
        }
        const Tick to_go = robot.facts(after_[k]).rest;
        if (!is_finite(to_go) || now + to_go > robot.most()) {
            return;
        }
        rest += robot.weight() * to_go;
    }
    least += rest;
    if (least >= limit_) {
        return;
    }
    const auto fresh = static_cast<std::int32_t>(nodes_.size());
    const std::int32_t first = known_.find_or_add(hash, fresh, [&](std::int32_t other) {
        return std::min(nodes_[index(other)].now, rules_.horizon) ==
                   std::min(now, rules_.horizon) &&
               std::equal(after_.begin(), after_.end(),
                          states_.begin() + static_cast<std::ptrdiff_t>(index(other) * size_));
    });
    std::int32_t next = none;
    if (first != fresh) {
        if (is_known(first, fresh, now, cost)) {
            return;
        }
        next = std::exchange(nodes_[index(first)].next, fresh);
    }
    nodes_.push_back({now, cost, least, node_, first, next});
    states_.insert(states_.end(), after_.begin(), after_.end());
    for (const Choice& choice : chosen_) {
        edges_.push_back(choice.edge);
    }
    open_.push(OpenList::key(least - first_, rest), fresh);
}

void JointSearch::track(std::size_t member, std::vector<Visit>& visits) const {
    const RobotStates& robot = robots_[member];
    const Trip& trip = robot.trip();
    std::vector<std::pair<EdgeId, Tick>> drives;
    for (std::int32_t node = goal_; nodes_[index(node)].parent != none;
         node = nodes_[index(node)].parent) {
        const EdgeId edge = edges_[index(node) * size_ + member];
        if (edge >= 0) {
            drives.emplace_back(edge, nodes_[index(nodes_[index(node)].parent)].now);
        }
    }
    std::reverse(drives.begin(), drives.end());
    visits.clear();
    visits.push_back({0, trip.home, 0});
    EdgeId before = none;
    for (const auto& [edge, step] : drives) {
        const std::int32_t drive = problem_.drive(robot.robot(), edge);
        visits.push_back({rules_.begins_drives ? step + drive : step,
                          problem_.graph().indices[index(edge)], drive,
                          trip.turns.between(before, edge)});
        before = edge;
    }
}

}  // namespace rightofway
