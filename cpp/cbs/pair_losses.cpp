#include "cbs/pair_losses.hpp"

#include <algorithm>
#include <cstdint>

#include "cbs/cbs.hpp"
#include "core/index_table.hpp"

namespace rightofway {
namespace {

// A pair is searched with few states at first, and with four times as many when it comes to that
// again: those that need many keep none from others.
constexpr std::int64_t first_states = 1000;
constexpr std::int64_t growth = 4;

}  // namespace

std::size_t PairLosses::Hash::operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::int32_t part : {key.robots[0], key.robots[1], key.sets[0], key.sets[1]}) {
        hash = mix_in(hash, part);
    }
    return static_cast<std::size_t>(hash);
}

PairLoss& PairLosses::of(const Key& key, const StopCondition& is_over) {
    const auto known = known_.find(key);
    if (known == known_.end()) {
        return known_.emplace(key, solve(key, {never, never}, is_over)).first->second;
    }
    if (!known->second.is_exact) {
        search_states(key, {never, never}, known->second, is_over);
    }
    return known->second;
}

// What two robots lose together at least if neither costs more than this.
PairLoss PairLosses::solve(const Key& key, std::array<Tick, 2> most, const StopCondition& is_over) {
    ConflictTree tree(tracks_, {key.robots.begin(), key.robots.end()}, options_, nullptr);
    tree.limit(most);
    if (!tree.start(key.sets, is_over)) {
        return {never, true};
    }
    const Tick alone = tree.bound();
    const SearchEnd end = tree.run(never, never, options_.pair_nodes, is_over);
    if (end == SearchEnd::proven_none) {
        return {never, true};
    }
    PairLoss loss{tree.bound() - alone, end == SearchEnd::found};
    if (!loss.is_exact) {
        search_states(key, most, loss, is_over);
    }
    return loss;
}

// Raises the loss of a pair by its joint states, once there are as many as it may need: twice as
// many as the same robots needed under other constraints, where a search of them ended.
void PairLosses::search_states(const Key& key, std::array<Tick, 2> most, PairLoss& loss,
                               const StopCondition& is_over) {
    const std::int64_t first = std::min(first_states, options_.joint_states);
    std::int64_t& needed = needed_.try_emplace({key.robots, {}}, first).first->second;
    if (needed == 0 || n_states_ + needed > most_states_) {
        return;
    }
    Tick alone = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const RobotId robot = key.robots[side];
        alone += tracks_.best(robot, key.sets[side], is_over)->cost;
        if (options_.latest < never) {
            most[side] = std::min(most[side], tracks_.problem().weight(robot) * options_.latest);
        }
    }
    const JointPlan plan = tracks_.together(key.robots, key.sets, most, needed, is_over);
    n_states_ += plan.n_states;
    loss.is_exact = plan.end != SearchEnd::stopped;
    needed = loss.is_exact ? std::max(first, 2 * plan.n_states) : growth * needed;
    loss.together = std::max(loss.together, plan.bound >= never ? never : plan.bound - alone);
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
        ends[side] = std::max(loss.together, solve(key, most, is_over).together);
    }
    const auto below = [&](std::size_t side) {
        return ends[side] >= never ? never : least[side] + ends[side] - 1;
    };
    if (solve(key, {below(0), below(1)}, is_over).together >= never) {
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

}  // namespace rightofway
