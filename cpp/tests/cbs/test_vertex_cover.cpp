#include <doctest/doctest.h>

#include <array>
#include <functional>

#include "cbs/vertex_cover.hpp"
#include "core/random.hpp"

namespace rightofway {
namespace {

using Pairs = std::vector<WeightedPair>;

// All numbers from 0 to the largest weight at each of four nodes.
Tick try_all(const Pairs& pairs, Tick most) {
    Tick best = 4 * most;
    std::array<Tick, 4> number{};
    const std::function<void(std::size_t, Tick)> choose = [&](std::size_t node, Tick sum) {
        if (node == number.size()) {
            bool is_cover = true;
            for (const WeightedPair& pair : pairs) {
                is_cover = is_cover && number[pair.first] + number[pair.second] >= pair.weight;
            }
            best = is_cover ? std::min(best, sum) : best;
            return;
        }
        for (number[node] = 0; number[node] <= most; ++number[node]) {
            choose(node + 1, sum + number[node]);
        }
    };
    choose(0, 0);
    return best;
}

Pairs draw_pairs(Random& random, Tick most) {
    Pairs pairs;
    for (std::size_t first = 0; first < 4; ++first) {
        for (std::size_t second = first + 1; second < 4; ++second) {
            const auto weight = static_cast<Tick>(random.below(static_cast<std::uint64_t>(most)));
            if (weight > 0) {
                pairs.push_back({first, second, weight});
            }
        }
    }
    return pairs;
}

TEST_CASE("the cover of four nodes is the least of all numbers") {
    Random random(1);
    for (int round = 0; round < 200; ++round) {
        const Pairs pairs = draw_pairs(random, 7);
        CHECK(cover(4, pairs) == try_all(pairs, 6));
    }
}

TEST_CASE("weights of any size are covered: the bound is between the heaviest pair and all pairs") {
    Random random(2);
    for (const Tick scale : {Tick{1} << 20, Tick{1} << 30, Tick{1} << 40}) {
        for (int round = 0; round < 20; ++round) {
            Pairs pairs = draw_pairs(random, 7);
            Tick heaviest = 0;
            for (WeightedPair& pair : pairs) {
                heaviest = std::max(heaviest, pair.weight);
            }
            const Tick least = try_all(pairs, 6);
            for (WeightedPair& pair : pairs) {
                pair.weight *= scale;
            }
            const Tick bound = cover(4, pairs);
            CHECK(bound >= heaviest * scale);
            CHECK(bound <= least * scale);
        }
    }
}

}  // namespace
}  // namespace rightofway
