#include "lacam/untimed_lacam.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rightofway {
namespace {

constexpr std::int64_t steps_between_counts = 64;
constexpr std::int64_t choices_between_questions = 4096;

std::size_t hash_of(const Configuration& now) {
    std::size_t hash = 0;
    for (const auto* numbers : {&now.at, &now.stage}) {
        for (const std::int32_t number : *numbers) {
            hash ^=
                static_cast<std::size_t>(number) + 0x9e3779b97f4a7c15U + (hash << 6) + (hash >> 2);
        }
    }
    return hash;
}

}  // namespace

UntimedLacam::UntimedLacam(const Problem& problem, StepTables& tables, std::uint32_t seed,
                           std::span<const std::uint8_t> ends_anywhere)
    : problem_(problem), ends_anywhere_(ends_anywhere), pibt_(problem, tables, seed) {}

SearchEnd UntimedLacam::run(const StopCondition& is_over, std::int64_t most_steps) {
    Configuration start;
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        start.at.push_back(problem_.home(r));
        start.stage.push_back(problem_.first_stage(r));
        advance(problem_, start, r);
    }
    add(std::move(start), none);
    // A step of a large fleet takes long.
    const std::int64_t between_questions = std::clamp<std::int64_t>(
        choices_between_questions / std::max(problem_.n_robots(), 1), 1, steps_between_counts);
    for (std::int64_t n_steps = 1; !open_.empty(); ++n_steps) {
        if ((n_steps % steps_between_counts == 0 && n_steps > most_steps) ||
            (n_steps % between_questions == 0 && is_over())) {
            return SearchEnd::stopped;
        }
        const std::int32_t top = open_.back();
        Node& node = nodes_[index(top)];
        if (is_goal(problem_, ends_anywhere_, node.now)) {
            goal_ = top;
            return SearchEnd::found;
        }
        if (node.next_constraint == node.constraints.size()) {
            open_.pop_back();  // all constraints are tried
            continue;
        }
        const auto constraint = static_cast<std::int32_t>(node.next_constraint++);
        branch(node, constraint);
        if (take_step(node, constraint)) {
            Configuration next = after_step(node.now);
            const std::int32_t known = find(next);
            if (known == none) {
                add(std::move(next), top);
            } else {
                open_.push_back(known);
            }
        }
    }
    return SearchEnd::proven_none;
}

void UntimedLacam::add(Configuration&& now, std::int32_t parent) {
    const auto node = static_cast<std::int32_t>(nodes_.size());
    std::vector<float> urgent = urgency(now, parent);
    std::vector<RobotId> order(urgent.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&urgent](RobotId left, RobotId right) {
        return urgent[index(left)] != urgent[index(right)]
                   ? urgent[index(left)] > urgent[index(right)]
                   : left < right;
    });
    known_.emplace(hash_of(now), node);
    nodes_.push_back(
        {std::move(now), parent, std::move(urgent), std::move(order), {{none, 0, none, none}}, 0});
    open_.push_back(node);
}

// The urgency of each robot: steps since its last stage, reset at each stage and at the target. The
// fraction follows the length of the first way and breaks ties.
std::vector<float> UntimedLacam::urgency(const Configuration& now, std::int32_t parent) const {
    std::vector<float> urgent(now.at.size());
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        const std::int32_t stage = now.stage[index(r)];
        if (parent == none) {
            const auto way = static_cast<float>(pibt_.way(now, r, now.at[index(r)]));
            urgent[index(r)] = way / (way + 1.0F) * 0.99F;
            continue;
        }
        const Node& before = nodes_[index(parent)];
        const bool begins_anew =
            stage != before.now.stage[index(r)] || problem_.stage_vertex(stage) == now.at[index(r)];
        urgent[index(r)] = begins_anew
                               ? before.urgency[index(r)] - std::floor(before.urgency[index(r)])
                               : before.urgency[index(r)] + 1.0F;
    }
    return urgent;
}

// Adds the children of a constraint: one more robot fixed, to each neighbour or to its own vertex.
void UntimedLacam::branch(Node& node, std::int32_t constraint) {
    const std::int32_t depth = node.constraints[index(constraint)].depth;
    if (depth == problem_.n_robots()) {
        return;
    }
    const RobotId robot = node.order[index(depth)];
    const VertexId here = node.now.at[index(robot)];
    for (const VertexId head : problem_.graph().heads(here)) {
        if (problem_.may_drive(robot, here, head)) {
            node.constraints.push_back({constraint, depth + 1, robot, head});
        }
    }
    node.constraints.push_back({constraint, depth + 1, robot, here});
}

bool UntimedLacam::take_step(Node& node, std::int32_t constraint) {
    for (std::int32_t k = constraint; node.constraints[index(k)].depth > 0;
         k = node.constraints[index(k)].parent) {
        pibt_.fix(node.constraints[index(k)].robot, node.constraints[index(k)].vertex);
    }
    return pibt_.step(node.now, node.order);
}

Configuration UntimedLacam::after_step(const Configuration& now) const {
    Configuration next = now;
    next.at.assign(pibt_.next().begin(), pibt_.next().end());
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        advance(problem_, next, r);
    }
    return next;
}

std::int32_t UntimedLacam::find(const Configuration& now) const {
    const auto [first, last] = known_.equal_range(hash_of(now));
    const auto same = std::find_if(
        first, last, [&](const auto& entry) { return nodes_[index(entry.second)].now == now; });
    return same == last ? none : same->second;
}

std::vector<VertexId> UntimedLacam::steps() const {
    std::vector<std::int32_t> path;
    for (std::int32_t node = goal_; node != none; node = nodes_[index(node)].parent) {
        path.push_back(node);
    }
    std::vector<VertexId> steps;
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
        steps.insert(steps.end(), nodes_[index(*node)].now.at.begin(),
                     nodes_[index(*node)].now.at.end());
    }
    return steps;
}

}  // namespace rightofway
