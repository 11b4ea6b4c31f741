#include <doctest/doctest.h>

#include <vector>

#include "cyclic/seen_states.hpp"

namespace rightofway {
namespace {

using State = std::vector<std::int32_t>;

TEST_CASE("a state is found again with the tick at which it was seen first") {
    SeenStates seen;
    CHECK(!seen.find_or_add(State{1, 2}, 10));
    CHECK(!seen.find_or_add(State{1, 2, 3}, 20));
    CHECK(seen.find_or_add(State{1, 2}, 30) == 10);
}

TEST_CASE("what was seen later than a tick can be forgotten") {
    SeenStates seen;
    seen.find_or_add(State{1}, 10);
    seen.find_or_add(State{2}, 20);
    seen.forget_after(10);
    CHECK(seen.n_states() == 1);
    CHECK(!seen.find_or_add(State{2}, 30));
    CHECK(seen.find_or_add(State{1}, 40) == 10);
}

TEST_CASE("with little memory a rhythm is still found, a little later") {
    SeenStates seen(16);
    for (Tick tick = 0; tick < 100; ++tick) {
        CHECK(!seen.find_or_add(State{static_cast<std::int32_t>(tick), 0}, tick));
        CHECK(seen.n_states() <= 8);
    }
    // From tick 40 on all comes again; with 8 states of 100 left, every 16th is known.
    for (Tick tick = 100;; ++tick) {
        const auto before = seen.find_or_add(State{static_cast<std::int32_t>(tick - 60), 0}, tick);
        if (before) {
            CHECK(tick - *before == 60);
            CHECK(tick < 116);
            break;
        }
    }
}

}  // namespace
}  // namespace rightofway
