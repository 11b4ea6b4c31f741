#include <numeric>
#include <stdexcept>

#include "corridors.hpp"
#include "example.hpp"
#include "precedence/precedence_graph.hpp"

namespace rightofway::test {
namespace {

// The first two meet at 9 at tick 1, the last two at 8 at tick 2. Visits 0 1 2 | 3 4 5 6 | 7 8
// 9 10.
Example two_meetings() { return Example({{0, 9, 1}, {2, 9, 8, 3}, {4, 5, 8, 6}}); }

TEST_CASE("conflicts are resolved one by one until none is left") {
    PrecedenceGraph graph(two_meetings().arrays());
    CHECK(graph.conflicts() == 2);
    CHECK(graph.next_conflict()->visit_b == 4);
    REQUIRE(graph.precede(4, 1));
    CHECK(graph.conflicts() == 1);
    CHECK(graph.next_conflict()->visit_b == 9);
    REQUIRE(graph.precede(5, 9));
    CHECK(graph.conflicts() == 0);
    CHECK_FALSE(graph.next_conflict().has_value());
    // Each of the two that waited is one tick late.
    CHECK(graph.completion(0) == 3);
    CHECK(graph.completion(1) == 3);
    CHECK(graph.completion(2) == 4);
}

TEST_CASE("a wait books the vertex waited in for longer, and that counts") {
    // The second robot waits for the first one's leave from 9 at tick 5, in vertex 2, which the
    // third passes during [2, 3).
    Example example({{0, 9, 1}, {2, 9, 3}, {4, 5, 2, 6}});
    example.least = {1, 4, 1, 1, 1, 1, 1, 1, 1, 1};
    PrecedenceGraph graph(example.arrays());
    CHECK(graph.conflicts() == 1);  // 9: [1, 5) and [1, 2)
    REQUIRE(graph.precede(1, 4));
    CHECK(graph.conflicts() == 1);  // 2: [0, 5) and [2, 3)
    CHECK(graph.next_conflict() == Conflict{2, 1, 2, 3, 8, ConflictKind::vertex});
}

TEST_CASE("conflicts of one robot with some others") {
    PrecedenceGraph graph(two_meetings().arrays());
    CHECK(graph.conflicts_of(1, std::vector<std::uint8_t>{1, 1, 1}) == 2);
    CHECK(graph.conflicts_of(1, std::vector<std::uint8_t>{1, 0, 0}) == 1);
    CHECK(graph.conflicts_of(1, std::vector<std::uint8_t>{0, 1, 0}) == 0);
    CHECK(graph.next_conflict_between(2, 1)->tick == 2);
}

TEST_CASE("an order of all visits is kept at once, and is the start of what can be undone") {
    PrecedenceGraph graph(two_meetings().arrays());
    REQUIRE(graph.keep_order(Ticks{0, 2, 3, 0, 1, 2, 3, 0, 1, 3, 4}));
    CHECK(graph.conflicts() == 0);
    CHECK_FALSE(graph.next_conflict().has_value());
    CHECK(graph.completion(0) == 3);
    CHECK(graph.completion(2) == 4);
    const std::int64_t mark = graph.checkpoint();
    CHECK(mark == 2);
    REQUIRE(graph.take_back(4, 1));
    CHECK(graph.conflicts() == 1);
    graph.rollback(mark);
    CHECK(graph.conflicts() == 0);
    CHECK_THROWS_AS(graph.rollback(mark - 1), std::invalid_argument);
}

TEST_CASE("robots that change places round a circle keep the order of one instant") {
    PrecedenceGraph graph(Example({{0, 1, 5}, {1, 2, 6}, {2, 0, 7}}).arrays());
    REQUIRE(graph.keep_order(Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2}));
    CHECK(listed(graph.enters()) == Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2});
    CHECK(graph.conflicts() == 0);
}

TEST_CASE("an order that cannot be kept changes nothing") {
    Example turning({{0, 1, 5}, {1, 2, 6}, {2, 0, 7}});
    PrecedenceGraph graph(turning.book_both().arrays());  // each would wait for the next
    CHECK_FALSE(graph.keep_order(Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2}));
    CHECK(graph.checkpoint() == 0);
    CHECK(graph.rights_of_way().empty());
    CHECK(listed(graph.enters()) == Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2});
    CHECK_THROWS_AS(graph.keep_order(Ticks{0, 1, 2}), std::invalid_argument);
    CHECK_THROWS_AS(graph.keep_order(Ticks{0, 1, 1, 0, 1, 2, 0, 1, 2}), std::invalid_argument);
    PrecedenceGraph swapping(Example({{0, 1}, {1, 0}}).arrays());
    CHECK_FALSE(swapping.keep_order(Ticks{0, 1, 0, 1}));
}

TEST_CASE("a refusal changes nothing") {
    PrecedenceGraph graph(two_meetings().arrays());
    REQUIRE(graph.precede(1, 4));
    const Ticks before = listed(graph.enters());
    CHECK_FALSE(graph.precede(4, 1));
    CHECK(listed(graph.cycle()) == Visits{1, 2, 4, 5});
    CHECK(listed(graph.enters()) == before);
    CHECK(graph.conflicts() == 0);
    CHECK(graph.checkpoint() == 1);
}

TEST_CASE("rollback restores times, conflicts and rights of way; marks nest and stay good") {
    PrecedenceGraph graph(two_meetings().arrays());
    const std::int64_t outer = graph.checkpoint();
    const Ticks free = listed(graph.enters());
    REQUIRE(graph.precede(4, 1));
    const std::int64_t inner = graph.checkpoint();
    const Ticks one = listed(graph.enters());
    for (const auto& [a, b] : {std::pair{5, 9}, std::pair{9, 5}}) {
        REQUIRE(graph.precede(a, b));
        CHECK(graph.conflicts() == 0);
        graph.rollback(inner);
        CHECK(listed(graph.enters()) == one);
        CHECK(graph.conflicts() == 1);
        CHECK(graph.next_conflict()->tick == 2);
    }
    graph.rollback(outer);
    CHECK(listed(graph.enters()) == free);
    CHECK(graph.conflicts() == 2);
    CHECK(graph.rights_of_way().empty());
    CHECK(graph.next_conflict()->tick == 1);
}

TEST_CASE("a right of way given twice is taken back once") {
    PrecedenceGraph graph(two_meetings().arrays());
    REQUIRE(graph.precede(4, 1));
    REQUIRE(graph.precede(4, 1));
    CHECK(graph.checkpoint() == 1);
    graph.rollback(0);
    CHECK(graph.conflicts() == 2);
}

TEST_CASE("a pair that no right of way can be between is refused with the reason") {
    Example example = two_meetings();
    example.active = {1, 1, 0};
    PrecedenceGraph graph(example.arrays());
    CHECK_THROWS_WITH(graph.precede(-1, 4), "a: -1 is not in 0..10");
    CHECK_THROWS_WITH(graph.precede(1, 11), "b: 11 is not in 0..10");
    CHECK_THROWS_WITH(graph.precede(1, 2), "b: 2 is a visit of the same robot as a, 1");
    CHECK_THROWS_WITH(graph.precede(1, 5), "b: 5 is at vertex 8, but a, 1, is at vertex 9");
    CHECK_THROWS_WITH(graph.precede(5, 9), "b: 9 is a visit of robot 2, which is not active");
}

TEST_CASE("unknown robots, wrong masks and marks from the future are refused") {
    PrecedenceGraph graph(two_meetings().arrays());
    const std::vector<std::uint8_t> mask{1, 1, 1};
    CHECK_THROWS_WITH(graph.completion(3), "robot: 3 is not in 0..2");
    CHECK_THROWS_WITH(graph.conflicts_of(-1, mask), "robot: -1 is not in 0..2");
    CHECK_THROWS_WITH(graph.conflicts_of(0, std::span(mask).first(2)),
                      "others: its length is 2, but must be 3");
    CHECK_THROWS_WITH(graph.next_conflict_between(0, 3), "j: 3 is not in 0..2");
    CHECK_THROWS_WITH(graph.next_conflict_between(1, 1), "j: 1 is the same robot as i");
    CHECK_THROWS_WITH(graph.rollback(1),
                      "mark: 1 is not in 0..0 (what was taken back cannot be gone back to)");
}

TEST_CASE("so many visits to one vertex that their conflicts might overflow are refused") {
    // 46342 * 46341 / 2 is just above 2^30.
    Example example({});
    const std::size_t n = 46342;
    example.vertex.assign(n, 7);
    example.least.assign(n, 1);
    example.approach.assign(n, 0);
    example.active.assign(n, 1);
    for (std::size_t r = 1; r <= n; ++r) {
        example.first_visit.push_back(static_cast<VisitId>(r));
    }
    CHECK_THROWS_WITH(PrecedenceGraph(example.arrays()),
                      "robots: 1073767311 pairs of their visits share a vertex, more than "
                      "1073741824 cannot be counted (plan fewer laps or fewer robots at once)");
}

TEST_CASE("an order of many visits can be interrupted, and changes nothing then") {
    // The second robot goes along the way of the first one, two ticks behind it.
    std::vector<VertexId> way(600);
    std::iota(way.begin(), way.end(), 0);
    std::vector<VertexId> behind{600};
    behind.insert(behind.end(), way.begin(), way.end());
    way.push_back(601);
    Ticks when;
    for (Tick tick = 0; tick < 601; ++tick) {
        when.push_back(tick);
    }
    for (Tick tick = 0; tick < 601; ++tick) {
        when.push_back(tick + (tick > 0 ? 2 : 0));
    }
    PrecedenceGraph graph(Example({way, behind}).arrays());
    const Ticks before = listed(graph.enters());
    const Tick conflicts = graph.conflicts();
    CHECK_THROWS_AS(graph.keep_order(when, interrupted), std::runtime_error);
    CHECK(graph.checkpoint() == 0);
    CHECK(graph.rights_of_way().empty());
    CHECK(listed(graph.enters()) == before);
    CHECK(graph.conflicts() == conflicts);
    CHECK(graph.keep_order(when));
    CHECK(graph.checkpoint() == 600);
}

}  // namespace
}  // namespace rightofway::test
