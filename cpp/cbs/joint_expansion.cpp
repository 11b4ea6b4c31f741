// What several robots can do from a joint state, all in one step: the product of what each of them
// can do, without what the rules keep them from doing together.
//
// As in Standley, "Finding optimal solutions to cooperative pathfinding problems", AAAI 2010,
// robots get their moves one by one, and each move is checked against those before it. The states
// between two moves, which are nodes in his operator decomposition, are none here.
#include <algorithm>

#include "cbs/joint_search.hpp"

namespace rightofway {
namespace {

// Whether rows that are booked at one instant exclude each other.
bool exclude(const Problem& problem, std::span<const std::int32_t> left,
             std::span<const std::int32_t> right) {
    for (const std::int32_t row : left) {
        if (!problem.has_sizes()) {
            if (std::find(right.begin(), right.end(), row) != right.end()) {
                return true;
            }
            continue;
        }
        for (const std::int32_t other : problem.excluded(row)) {
            if (std::find(right.begin(), right.end(), other) != right.end()) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

void JointSearch::expand(std::int32_t node) {
    node_ = node;
    const Node& here = nodes_[index(node)];
    const Tick spare = limit_ < never ? limit_ - here.least : never;
    for (std::size_t k = 0; k < size_; ++k) {
        robots_[k].list_choices(state_of(node, k), here.now, spare, choices_[k]);
    }
    chosen_.clear();
    choose(0);
}

// Chooses for one robot after the other, and steps once all have chosen.
void JointSearch::choose(std::size_t k) {
    stop_if_over();
    if (k == size_) {
        step();
        return;
    }
    for (const Choice& choice : choices_[k]) {
        if (is_allowed(k, choice)) {
            chosen_.push_back(choice);
            choose(k + 1);
            chosen_.pop_back();
        }
    }
}

// Whether a robot can do this besides what the robots before it do.
bool JointSearch::is_allowed(std::size_t k, const Choice& choice) const {
    const Graph& roads = problem_.graph();
    const auto& rows = robots_[k].facts(choice.state).rows;
    for (std::size_t other = 0; other < k; ++other) {
        const Choice& chosen = chosen_[other];
        if (exclude(problem_, robots_[other].facts(chosen.state).rows, rows)) {
            return false;
        }
        if (!rules_.begins_drives && problem_.may_follow() && choice.edge >= 0 &&
            chosen.edge >= 0) {
            const VertexId here = robots_[k].state(state_of(node_, k)).vertex;
            const VertexId there = robots_[other].state(state_of(node_, other)).vertex;
            if (roads.indices[index(choice.edge)] == there &&
                roads.indices[index(chosen.edge)] == here) {
                return false;  // a swap
            }
        }
    }
    return true;
}

// Whether robots enter in a circle what the next one leaves at this instant: two of them always
// swap, more of them may be allowed to rotate.
bool JointSearch::is_circle_forbidden() const {
    const Graph& roads = problem_.graph();
    for (std::size_t first = 0; first < size_; ++first) {
        std::size_t at = first;
        for (std::size_t n = 1; n <= size_ && at < size_ && entered_[at] >= 0; ++n) {
            const VertexId head = roads.indices[index(entered_[at])];
            std::size_t next = 0;
            while (next < size_ && (entered_[next] < 0 ||
                                    robots_[next].state(state_of(node_, next)).vertex != head)) {
                ++next;
            }
            if (next == first && (n == 2 || !problem_.rules().rotations)) {
                return true;
            }
            at = next == first ? size_ : next;
        }
    }
    return false;
}

// Whether robots that drive without booking ahead may arrive, as the others go on: the last one
// may come to what another robot has left and books for a headway more.
bool JointSearch::is_arrival_free() const {
    for (std::size_t k = 0; k < size_; ++k) {
        for (std::size_t other = 0; other < k; ++other) {
            if ((entered_[k] >= 0 || entered_[other] >= 0) &&
                exclude(problem_, robots_[other].facts(after_[other]).rows,
                        robots_[k].facts(after_[k]).rows)) {
                return false;
            }
        }
    }
    return true;
}

// All robots have chosen: goes to the next instant at which something ends.
void JointSearch::step() {
    const Tick now = nodes_[index(node_)].now;
    Tick cost = nodes_[index(node_)].cost;
    Tick next = never;
    bool all_end = true;
    for (std::size_t k = 0; k < size_; ++k) {
        next = std::min(next, robots_[k].next_step(chosen_[k].state, now));
        all_end = all_end && robots_[k].has_ended(chosen_[k].state);
        cost += chosen_[k].cost;
    }
    if (all_end) {
        next = now;
    }
    if (next >= never) {
        return;  // nobody goes on, whatever happens
    }
    after_.clear();
    entered_.clear();
    for (std::size_t k = 0; k < size_; ++k) {
        RobotStates& robot = robots_[k];
        const std::int32_t chosen = chosen_[k].state;
        const RobotStates::State& state = robot.state(chosen);
        const bool arrives = state.left > 0 && state.left == next - now;
        entered_.push_back(!rules_.begins_drives ? chosen_[k].edge : arrives ? state.edge : none);
        if (!state.ends) {
            if (!robot.may_stay(chosen, now, next)) {
                return;
            }
            cost += robot.weight() * (next - now);
        }
        after_.push_back(all_end ? chosen : robot.after(chosen, next - now));
    }
    if (problem_.may_follow() && is_circle_forbidden()) {
        return;
    }
    if (rules_.begins_drives && !problem_.rules().books_ahead && !is_arrival_free()) {
        return;
    }
    reach(next, cost);
}

}  // namespace rightofway
