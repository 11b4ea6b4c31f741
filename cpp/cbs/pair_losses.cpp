#include "cbs/pair_losses.hpp"

#include <algorithm>
#include <cstdint>

#include "cbs/cbs.hpp"

namespace rightofway {

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
    return known_.emplace(key, PairLoss{least_loss(key, {never, never}, is_over)}).first->second;
}

// What two robots lose together at least if neither costs more than this; `never` if they cannot.
// A tree of few nodes is enough for most pairs, and takes less time than their joint states.
Tick PairLosses::least_loss(const Key& key, std::array<Tick, 2> costs,
                            const StopCondition& is_over) {
    ConflictTree tree(tracks_, {key.robots.begin(), key.robots.end()}, options_, nullptr);
    tree.limit(costs);
    if (!tree.start(key.sets, is_over)) {
        return never;
    }
    const Tick alone = tree.bound();
    const SearchEnd end = tree.run(never, never, options_.pair_nodes, is_over);
    if (end == SearchEnd::proven_none) {
        return never;
    }
    Tick bound = tree.bound();
    for (std::size_t side = 0; side < 2 && options_.latest < never; ++side) {
        costs[side] =
            std::min(costs[side], tracks_.problem().weight(key.robots[side]) * options_.latest);
    }
    if (end == SearchEnd::stopped && options_.joint_states > 0) {
        const JointPlan joint =
            tracks_.together(key.robots, key.sets, costs, options_.joint_states, is_over);
        bound = std::max(bound, joint.bound);
    }
    return bound >= never ? never : bound - alone;
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
        ends[side] = std::max(loss.together, least_loss(key, most, is_over));
    }
    const auto below = [&](std::size_t side) {
        return ends[side] >= never ? never : least[side] + ends[side] - 1;
    };
    if (least_loss(key, {below(0), below(1)}, is_over) >= never) {
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
