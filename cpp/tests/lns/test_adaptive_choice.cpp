#include <doctest/doctest.h>

#include <array>

#include "lns/adaptive_choice.hpp"

namespace {

using rightofway::AdaptiveChoice;
using rightofway::Random;

std::array<int, 3> drawn(const AdaptiveChoice& choice) {
    std::array<int, 3> counts{};
    Random random(1);
    for (int k = 0; k < 3000; ++k) {
        ++counts[choice.draw(random)];
    }
    return counts;
}

}  // namespace

TEST_CASE("before anything is known, all options are drawn alike") {
    for (const int count : drawn(AdaptiveChoice(3))) {
        CHECK(count > 900);
        CHECK(count < 1100);
    }
}

TEST_CASE("an option is drawn by what it brings for its effort, and none is forgotten") {
    AdaptiveChoice choice(3);
    for (int k = 0; k < 50; ++k) {
        choice.learn(0, 3, 100);
        choice.learn(1, 10, 100);
        choice.learn(2, 0, 100);
    }
    choice.settle();
    const auto counts = drawn(choice);
    CHECK(counts[1] > 2 * counts[0]);
    CHECK(counts[0] > 2 * counts[2]);
    CHECK(counts[2] > 50);
}

TEST_CASE("options that bring alike for their effort share the effort, not the draws") {
    AdaptiveChoice choice(3);
    for (int k = 0; k < 50; ++k) {
        choice.learn(0, 10, 100);
        choice.learn(1, 100, 1000);
        choice.learn(2, 100, 1000);
    }
    choice.settle();
    const auto counts = drawn(choice);
    CHECK(counts[0] > 3 * counts[1]);
    CHECK(counts[0] > 3 * counts[2]);
    CHECK(counts[1] > 100);
}

TEST_CASE("what an option brought long ago counts for little") {
    AdaptiveChoice choice(3);
    for (int k = 0; k < 200; ++k) {
        choice.learn(0, 10, 100);
        choice.learn(1, 1, 100);
    }
    for (int k = 0; k < 200; ++k) {
        choice.learn(0, 1, 100);
        choice.learn(1, 10, 100);
    }
    choice.settle();
    CHECK(drawn(choice)[1] > 2 * drawn(choice)[0]);
}

TEST_CASE("groups share the effort by what they bring for it, whatever a use needs") {
    rightofway::EffortShares shares;
    for (int k = 0; k < 500; ++k) {
        shares.learn(false, 100, 1000);
        shares.learn(true, 3, 10);
    }
    shares.settle();
    // The second group brings three times as much for its effort, so it gets three quarters of all
    // effort: 300 uses for each of the first one.
    Random random(1);
    int n_second = 0;
    for (int k = 0; k < 30100; ++k) {
        n_second += shares.draw(random) ? 1 : 0;
    }
    CHECK(n_second > 29800);
    CHECK(n_second < 30100);
}
