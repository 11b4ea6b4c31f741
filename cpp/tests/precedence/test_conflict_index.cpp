#include "example.hpp"
#include "precedence/conflict_index.hpp"

namespace rightofway::test {
namespace {

// An index that holds all visits of freely running robots, and what adding them counted.
struct Filled {
    explicit Filled(const Example& example)
        : routes(example.routes()), timetable(routes), index(routes) {
        for (VisitId x = 0; x < routes.n_visits(); ++x) {
            total += index.add(x, timetable);
        }
    }

    Routes routes;
    Timetable timetable;
    ConflictIndex index;
    Tick total = 0;
};

constexpr auto vertex_kind = ConflictKind::vertex;
constexpr auto swap_kind = ConflictKind::swap;

TEST_CASE("every pair is counted once when all visits are added, and again when removed") {
    // Three robots are at 9 during [1, 2): three pairs, one tick each.
    Filled filled(Example({{0, 9, 1}, {2, 9, 3}, {4, 9, 5}}));
    CHECK(filled.total == 3);
    CHECK(filled.index.weight(1) == 2);
    CHECK(filled.index.remove(1) == 2);
    CHECK(filled.index.remove(1) == 0);
    CHECK(filled.index.remove(4) == 1);
    CHECK(filled.index.add(4, filled.timetable) == 1);
    CHECK(filled.index.add(1, filled.timetable) == 2);
    CHECK(filled.index.add(1, filled.timetable) == 0);
}

TEST_CASE("a booking reaches from approach to headway") {
    // Vertex 9: the first robot [3, 4), the second [6, 7). With an approach of 2 the second books
    // from 4 on: no overlap. Each tick of headway of the first makes one.
    Example example({{0, 9, 1}, {2, 9, 3}});
    example.least = {3, 1, 1, 6, 1, 1};
    example.approach = {0, 0, 0, 0, 2, 0};
    CHECK(Filled(example).total == 0);
    example.headway = 1;
    Filled filled(example);
    CHECK(filled.total == 1);
    CHECK(filled.index.earliest(1) == Conflict{4, 0, 1, 1, 4, vertex_kind});
}

TEST_CASE("a robot at its last vertex is in the way for ever") {
    // The first robot stays at 9 from tick 1 on; the second passes during [2, 3).
    CHECK(Filled(Example({{0, 9}, {2, 3, 9, 4}})).total == 1);
    // If both stay there, it counts a large constant.
    CHECK(Filled(Example({{0, 9}, {2, 3, 9}})).total == conflict_cap);
}

TEST_CASE("a swap counts one and is named by the visits entered") {
    Filled filled(Example({{0, 1, 2, 5}, {3, 2, 1, 6}}));  // visits 0 1 2 3 | 4 5 6 7
    CHECK(filled.total == 1);
    CHECK(filled.index.earliest(2) == Conflict{2, 0, 1, 2, 6, swap_kind});
    CHECK(filled.index.earliest(6) == Conflict{2, 0, 1, 2, 6, swap_kind});
    CHECK_FALSE(filled.index.earliest(1).has_value());
}

TEST_CASE("a swap is not counted where swaps are no conflict") {
    Example example({{0, 1, 2, 5}, {3, 2, 1, 6}});
    example.swaps_conflict = false;
    CHECK(Filled(example).total == 0);
}

TEST_CASE("with a gap a swap is two vertex conflicts instead") {
    // Headway 1: vertex 1 is booked [1, 3) and [2, 4), and so is vertex 2.
    Example example({{0, 1, 2, 5}, {3, 2, 1, 6}});
    example.headway = 1;
    Filled filled(example);
    CHECK(filled.total == 2);
    CHECK(filled.index.earliest(2) == Conflict{2, 0, 1, 2, 5, vertex_kind});
}

TEST_CASE("inactive robots meet nobody") {
    Example example({{0, 9, 1}, {2, 9, 3}, {4, 9, 5}});
    example.active = {1, 0, 1};
    Filled filled(example);
    CHECK(filled.total == 1);
    CHECK(filled.index.weight(4) == 0);
    CHECK_FALSE(filled.index.earliest(4).has_value());
}

TEST_CASE("a mask picks the robots to count conflicts with") {
    Filled filled(Example({{0, 9, 1}, {2, 9, 3}, {4, 9, 5}}));
    const std::vector<std::uint8_t> third{0, 0, 1};
    CHECK(filled.index.weight(1, third) == 1);
    CHECK(filled.index.weight(7, third) == 0);
}

TEST_CASE("of conflicts at the same tick the one of lower robots comes first") {
    Filled filled(Example({{0, 9, 1}, {2, 9, 3}, {4, 9, 5}}));
    CHECK(filled.index.earliest(7) == Conflict{1, 0, 2, 1, 7, vertex_kind});
    CHECK(filled.index.earliest(7, 1) == Conflict{1, 1, 2, 4, 7, vertex_kind});
    CHECK(filled.index.earliest(1) == Conflict{1, 0, 1, 1, 4, vertex_kind});
}

TEST_CASE("robots come before kinds: a swap with a lower robot before a meeting with a higher") {
    // At tick 2 the third robot enters 2, which the second enters too, from 1, to which the first
    // goes from 2.
    Filled filled(Example({{3, 2, 1}, {6, 7, 2}, {5, 1, 2}}));
    CHECK(filled.index.earliest(8) == Conflict{2, 0, 2, 2, 8, swap_kind});
    CHECK(filled.index.earliest(8, 1) == Conflict{2, 1, 2, 5, 8, vertex_kind});
}

TEST_CASE("two visits that swap are taken out and put back as one conflict") {
    Filled filled(Example({{0, 1, 2, 5}, {3, 2, 1, 6}}));
    CHECK(filled.index.remove(2) == 1);
    CHECK(filled.index.remove(6) == 0);
    CHECK(filled.index.add(2, filled.timetable) == 0);
    CHECK(filled.index.add(6, filled.timetable) == 1);
}

TEST_CASE("a robot has no conflicts with itself, neither at a vertex nor going to and fro") {
    CHECK(Filled(Example({{7, 1, 7, 1}})).total == 0);
}

TEST_CASE("bookings that only touch do not overlap") {
    CHECK(Filled(Example({{9, 1}, {2, 9}})).total == 0);
}

TEST_CASE("moves in the same direction, or from elsewhere, are no swap") {
    Filled filled(Example({{1, 2, 5}, {3, 1, 6}, {2, 3, 7}}));
    CHECK_FALSE(filled.index.earliest(1).has_value());
}

}  // namespace
}  // namespace rightofway::test
