#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "precedence/timed_event_graph.hpp"

namespace rightofway {
namespace {

struct Events {
    std::int32_t n_nodes;
    std::vector<std::int32_t> tail;
    std::vector<std::int32_t> head;
    std::vector<Tick> length;
    std::vector<std::int32_t> height;

    TimedEventGraph arcs() const { return {n_nodes, tail, head, length, height}; }
};

bool no_deadline() { return false; }

// Two robots of two visits each, laps of 5 and 7, and one door: 0 1 | 2 3, visits 1 and 3 there.
Events door() {
    return {4, {0, 1, 2, 3, 0, 2}, {1, 0, 3, 2, 3, 1}, {2, 3, 1, 6, 1, 1}, {0, 1, 0, 1, 1, 0}};
}

TEST_CASE("the largest ratio of length to height is the cycle time") {
    const Events events = door();
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    // The second robot alone: 1 + 6 in one period; through the other: 1 + 6 + 1 + 3 in three.
    CHECK(found->length == 7);
    CHECK(found->height == 1);
    CHECK(found->arcs.size() == 2);
}

TEST_CASE("a ratio is in lowest terms, and no rounding spoils it") {
    const Events events{2, {0, 0, 1}, {0, 1, 0}, {3, 2, 5}, {1, 1, 1}};  // 3 / 1, 7 / 2
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    CHECK(found->length == 7);
    CHECK(found->height == 2);
    CHECK(found->arcs == std::vector<std::int32_t>{1, 2});
}

TEST_CASE("a rotation, of length and height zero, is walked round no more than once") {
    const Events events{3, {0, 1, 2, 0}, {1, 2, 0, 0}, {0, 0, 0, 4}, {0, 0, 0, 1}};
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    CHECK(found->length == 4);
    CHECK(found->arcs == std::vector<std::int32_t>{3});
}

TEST_CASE("parts that do not reach each other have the larger of their cycle times") {
    const Events events{3, {0, 1, 2, 1}, {0, 1, 2, 2}, {3, 5, 4, 1}, {1, 1, 1, 0}};
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    CHECK(found->length == 5);
    CHECK(found->arcs == std::vector<std::int32_t>{1});
}

TEST_CASE("nothing that takes time: the cycle time is zero") {
    const Events events{1, {0}, {0}, {0}, {1}};
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    CHECK(found->length == 0);
    CHECK(found->arcs.empty());
}

TEST_CASE("events that wait for each other for ever are a circuit of height 0") {
    const Events events{2, {0, 1}, {1, 0}, {2, 0}, {0, 0}};
    const auto found = critical_circuit(events.arcs(), no_deadline);
    REQUIRE(found);
    CHECK(found->length == 2);
    CHECK(found->height == 0);
    CHECK(found->arcs.size() == 2);
}

TEST_CASE("a search that is told to stop has found nothing") {
    const Events events = door();
    CHECK_FALSE(critical_circuit(events.arcs(), [] { return true; }));
    CHECK_FALSE(earliest_times(events.arcs(), 7, 1, [] { return true; }));
}

TEST_CASE("times are the least that keep all arcs, at the cycle time and above") {
    const Events events = door();
    const auto times = earliest_times(events.arcs(), 7, 1, no_deadline);
    REQUIRE(times);
    CHECK(*times == std::vector<Tick>{0, 2, 0, 1});
    CHECK_FALSE(earliest_times(events.arcs(), 6, 1, no_deadline));
}

TEST_CASE("times at a fraction are whole numbers of its parts") {
    const Events events{2, {0, 0, 1}, {0, 1, 0}, {3, 2, 5}, {1, 1, 1}};  // cycle time 7 / 2
    const auto times = earliest_times(events.arcs(), 7, 2, no_deadline);
    REQUIRE(times);
    CHECK(*times == std::vector<Tick>{3, 0});  // 5 - 7/2 = 3/2 after the other
}

TEST_CASE("arcs that do not fit are refused, with the index and the value") {
    Events events = door();
    events.head[2] = 4;
    CHECK_THROWS_WITH_AS(require_event_arcs(events.arcs()), "head[2]: 4 is not in 0..3",
                         std::invalid_argument);
    events = door();
    events.length[1] = -3;
    CHECK_THROWS_WITH_AS(require_event_arcs(events.arcs()), "length[1]: -3 is negative",
                         std::invalid_argument);
    events.length[1] = Tick{1} << 60;
    CHECK_THROWS_AS(require_event_arcs(events.arcs()), std::invalid_argument);
}

TEST_CASE("earliest times without parts, or for a negative period, are refused") {
    const Events events = door();
    CHECK_THROWS_WITH(earliest_times(events.arcs(), 7, 0, no_deadline), "parts: 0 is not above 0");
    CHECK_THROWS_WITH(earliest_times(events.arcs(), -7, 1, no_deadline), "period: -7 is negative");
    const Events none{-1, {}, {}, {}, {}};
    CHECK_THROWS_WITH(require_event_arcs(none.arcs()), "n_nodes: -1 is not in 0..67108864");
}

TEST_CASE("a period below the cycle time is found without going round until times overflow") {
    // A circuit of 2^26 ticks among 2^10 events that wait in a row: each round adds 2^26 parts of
    // 2^30, that is 2^56, so 2^10 rounds would add 2^66.
    Events events{1 << 10, {0}, {0}, {Tick{1} << 26}, {1}};
    for (std::int32_t k = 1; k < events.n_nodes; ++k) {
        events.tail.push_back(k - 1);
        events.head.push_back(k);
        events.length.push_back(0);
        events.height.push_back(0);
    }
    CHECK_FALSE(earliest_times(events.arcs(), 1, Tick{1} << 30, no_deadline));
}

}  // namespace
}  // namespace rightofway
