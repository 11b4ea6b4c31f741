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
        choice.learn(0, 10, 1000);
        choice.learn(1, 10, 100);
        choice.learn(2, 0, 100);
    }
    choice.settle();
    const auto counts = drawn(choice);
    CHECK(counts[1] > 2 * counts[0]);
    CHECK(counts[0] > counts[2]);
    CHECK(counts[2] > 200);
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
