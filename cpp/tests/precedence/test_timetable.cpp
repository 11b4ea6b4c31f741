#include "example.hpp"
#include "precedence/timetable.hpp"

namespace rightofway::test {
namespace {

Ticks enters(const Timetable& timetable) { return listed(timetable.enters()); }
Visits cycle(const Timetable& timetable) { return listed(timetable.cycle()); }

TEST_CASE("without rights of way every robot runs freely from tick 0") {
    Example example({{0, 1, 2}, {5, 6}});
    example.least = {2, 3, 1, 7, 1};
    const Routes routes = example.routes();
    const Timetable timetable(routes);
    CHECK(enters(timetable) == Ticks{0, 2, 5, 0, 7});
    CHECK(timetable.leave(1) == 5);
    CHECK(timetable.leave(2) == never);
}

TEST_CASE("at a crossing the second robot enters when the first leaves") {
    // Both are at 9 during [1, 2). Visits: 0 9 1 | 2 9 3 are 0 1 2 | 3 4 5.
    const Routes routes = Example({{0, 9, 1}, {2, 9, 3}}).routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(1, 4));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 2, 3});
    CHECK(listed(timetable.changed()) == Visits{4, 5});
}

TEST_CASE("headway and approach come on top of the leave") {
    Example example({{0, 9, 1}, {2, 9, 3}});
    example.headway = 10;
    example.approach = {0, 0, 0, 0, 4, 0};
    const Routes routes = example.routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(1, 4));
    CHECK(timetable.enter(4) == 2 + 10 + 4);
}

TEST_CASE("a robot may follow another at once when its bookings allow it") {
    // The second robot stands where the first goes next, and both go the same way.
    const Routes routes = Example({{0, 1, 2}, {1, 2, 3}}).routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(3, 1));  // vertex 1: left at 1, entered at 1
    CHECK(timetable.precede(4, 2));  // vertex 2: left at 2, entered at 2
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 1, 2});
}

TEST_CASE("a robot that books before it moves follows one step behind") {
    const Routes routes = Example({{0, 1, 2}, {1, 2, 3}}).book_both().routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(3, 1));  // leave 1, approach 1: enter at 2
    CHECK(timetable.precede(4, 2));  // leave 2, approach 1: enter at 3, as it would anyway
    CHECK(enters(timetable) == Ticks{0, 2, 3, 0, 1, 2});
}

TEST_CASE("a raise is absorbed by slack on its way") {
    // The first robot holds 9 until tick 6. The second goes through 9 and then 8, and the third
    // comes to 8 two ticks after the second would have left it. Visits 0 1 2 | 3 4 5 6 | 7 8 9.
    Example example({{0, 9, 1}, {2, 9, 8, 3}, {4, 8, 5}});
    example.least = {1, 5, 1, 2, 1, 1, 1, 6, 1, 1};
    const Routes routes = example.routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(5, 8));  // left at 4, entered at 6: two ticks of slack
    CHECK(enters(timetable) == Ticks{0, 1, 6, 0, 2, 3, 4, 0, 6, 7});
    CHECK(timetable.precede(1, 4));  // entered at 6 instead of 2: 4 ticks later, 2 arrive at 8
    CHECK(enters(timetable) == Ticks{0, 1, 6, 0, 6, 7, 8, 0, 8, 9});
}

TEST_CASE(
    "head-on in a corridor, both first at their far end is a deadlock that its cycle explains") {
    // Through 1 2 3 in opposite directions. Visits 0 1 2 3 4 | 5 6 7 8 9.
    const Routes routes = Example({{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}}).routes();
    Timetable timetable(routes);
    REQUIRE(timetable.precede(3, 6));  // vertex 3: the first robot first, so 6 follows 4
    const Ticks before = enters(timetable);
    // Vertex 1: the second robot first, so 1 would follow 9, which comes long after 6.
    CHECK_FALSE(timetable.precede(8, 1));
    CHECK(cycle(timetable) == Visits{1, 2, 3, 4, 6, 7, 8, 9});
    CHECK(enters(timetable) == before);
    CHECK(timetable.changed().empty());
    CHECK(timetable.rights_of_way().size() == 1);
    // The first robot first at vertex 1 as well: the second goes after it through all of it.
    CHECK(timetable.precede(1, 8));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 3, 4, 0, 4, 5, 6, 7});
}

TEST_CASE("two robots that exchange their vertices are refused as a swap") {
    // 1 and 2 in opposite directions; each is to enter when the other leaves. Visits 0 1 2 | 3 4 5.
    const Routes routes = Example({{0, 1, 2}, {3, 2, 1}}).routes();
    Timetable timetable(routes);
    REQUIRE(timetable.precede(1, 5));      // vertex 1: 5 no earlier than 2
    CHECK_FALSE(timetable.precede(4, 2));  // vertex 2: 2 no earlier than 5
    CHECK(cycle(timetable) == Visits{2, 5});
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 1, 2});
}

TEST_CASE("a swap is possible where swaps are no conflict") {
    Example example({{0, 1, 2}, {3, 2, 1}});
    example.swaps_conflict = false;
    const Routes routes = example.routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(1, 5));
    CHECK(timetable.precede(4, 2));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 1, 2});
}

TEST_CASE("a swap with a gap is a deadlock whatever the rules") {
    Example example({{0, 1, 2}, {3, 2, 1}});
    example.swaps_conflict = false;
    example.headway = 1;
    const Routes routes = example.routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(1, 5));
    CHECK_FALSE(timetable.precede(4, 2));
    CHECK(cycle(timetable) == Visits{2, 5});
}

// Three robots on a ring: 0 -> 1 -> 2 -> 0, each after a first vertex of its own.
Example ring() { return Example({{10, 0, 1}, {11, 1, 2}, {12, 2, 0}}); }

TEST_CASE("three robots may rotate, and a delay of one goes once round the ring") {
    Example example = ring();
    const Routes routes = example.routes();  // visits 0 1 2 | 3 4 5 | 6 7 8
    Timetable timetable(routes);
    CHECK(timetable.precede(4, 2));  // vertex 1: 2 no earlier than 5
    CHECK(timetable.precede(7, 5));  // vertex 2: 5 no earlier than 8
    CHECK(timetable.precede(1, 8));  // vertex 0: 8 no earlier than 2
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2});

    // A fourth robot holds vertex 2 until tick 7: the third enters it at 7, all go on at 8.
    Example late({{10, 0, 1}, {11, 1, 2}, {12, 2, 0}, {2, 13}});
    late.least = {1, 1, 1, 1, 1, 1, 1, 1, 1, 7, 1};
    const Routes late_routes = late.routes();
    Timetable delayed(late_routes);
    CHECK(delayed.precede(4, 2));
    CHECK(delayed.precede(7, 5));
    CHECK(delayed.precede(1, 8));
    CHECK(delayed.precede(9, 7));
    CHECK(enters(delayed) == Ticks{0, 1, 8, 0, 1, 8, 0, 7, 8, 0, 7});
}

TEST_CASE("a rotation of robots that book before they move is a deadlock") {
    const Routes routes = ring().book_both().routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(4, 2));
    CHECK(timetable.precede(7, 5));
    CHECK_FALSE(timetable.precede(1, 8));
    CHECK(cycle(timetable) == Visits{8, 5, 2});
}

TEST_CASE("nobody can follow a robot that never leaves, or come before one that is there already") {
    const Routes routes = Example({{0, 1}, {2, 1, 0}}).routes();  // visits 0 1 | 2 3 4
    Timetable timetable(routes);
    CHECK_FALSE(timetable.precede(1, 3));  // 1 is a last visit
    CHECK(cycle(timetable).empty());
    CHECK_FALSE(timetable.precede(4, 0));  // 4 is a last, 0 a first visit
    CHECK(timetable.rights_of_way().empty());
}

TEST_CASE("a refusal without a cycle forgets the cycle before, a success does not") {
    const Routes routes = Example({{0, 1, 2, 5}, {3, 2, 1, 5}}).routes();  // 0 1 2 3 | 4 5 6 7
    Timetable timetable(routes);
    REQUIRE(timetable.precede(1, 6));
    REQUIRE_FALSE(timetable.precede(5, 2));
    REQUIRE(timetable.precede(2, 5));
    CHECK(cycle(timetable) == Visits{2, 6});
    REQUIRE_FALSE(timetable.precede(3, 7));
    CHECK(cycle(timetable).empty());
}

TEST_CASE("a right of way that is there already is not added again") {
    const Routes routes = Example({{0, 9, 1}, {2, 9, 3}}).routes();
    Timetable timetable(routes);
    CHECK(timetable.precede(1, 4));
    CHECK(timetable.precede(1, 4));
    CHECK(timetable.changed().empty());
    CHECK(timetable.rights_of_way().size() == 1);
}

TEST_CASE("rollback restores times and rights of way, step by step or at once") {
    const Routes routes = Example({{0, 9, 8, 1}, {2, 9, 8, 3}, {4, 9, 8, 5}}).routes();
    Timetable timetable(routes);  // visits 0 1 2 3 | 4 5 6 7 | 8 9 10 11
    const Ticks free = enters(timetable);
    REQUIRE(timetable.precede(1, 5));
    const Ticks first = enters(timetable);
    REQUIRE(timetable.precede(5, 9));
    REQUIRE(timetable.precede(1, 9));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 3, 0, 2, 3, 4, 0, 3, 4, 5});
    timetable.rollback(1);
    CHECK(enters(timetable) == first);
    CHECK(listed(timetable.changed()).size() == 3);
    timetable.rollback(0);
    CHECK(enters(timetable) == free);
    // What was taken back no longer binds: the other order is possible now.
    CHECK(timetable.precede(9, 1));
    CHECK(timetable.precede(5, 9));
    CHECK(enters(timetable) == Ticks{0, 3, 4, 5, 0, 1, 2, 3, 0, 2, 3, 4});
    timetable.rollback(0);
    CHECK(enters(timetable) == free);
}

TEST_CASE("what is taken back holds nobody any more, whatever else was given since") {
    const Routes routes = Example({{0, 9, 8, 1}, {2, 9, 8, 3}, {4, 9, 8, 5}}).routes();
    Timetable timetable(routes);  // visits 0 1 2 3 | 4 5 6 7 | 8 9 10 11
    REQUIRE(timetable.precede(1, 5));
    REQUIRE(timetable.precede(5, 9));
    REQUIRE(timetable.precede(1, 9));
    REQUIRE(timetable.take_back(1, 5));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 3, 0, 1, 2, 3, 0, 2, 3, 4});
    CHECK(timetable.rights_of_way().size() == 2);
    CHECK_FALSE(timetable.take_back(1, 5));
    timetable.rollback(3);
    CHECK(enters(timetable) == Ticks{0, 1, 2, 3, 0, 2, 3, 4, 0, 3, 4, 5});
}

TEST_CASE("robots that rotate fall together when what held one of them is taken back") {
    Example late({{10, 0, 1}, {11, 1, 2}, {12, 2, 0}, {2, 13}});
    late.least = {1, 1, 1, 1, 1, 1, 1, 1, 1, 7, 1};
    const Routes routes = late.routes();
    Timetable timetable(routes);
    REQUIRE(timetable.precede(4, 2));
    REQUIRE(timetable.precede(7, 5));
    REQUIRE(timetable.precede(1, 8));
    REQUIRE(timetable.precede(9, 7));
    REQUIRE(timetable.enter(2) == 8);
    CHECK(timetable.take_back(9, 7));
    CHECK(enters(timetable) == Ticks{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 7});
}

TEST_CASE("a late visit is due to the rights of way on a longest path to it") {
    // The first holds 9 until 6, the second waits for it, and the third for the second in 8.
    Example example({{0, 9, 1}, {2, 9, 8, 3}, {4, 8, 5}});
    example.least = {1, 5, 1, 2, 1, 1, 1, 6, 1, 1};
    const Routes routes = example.routes();
    Timetable timetable(routes);
    REQUIRE(timetable.precede(1, 4));
    REQUIRE(timetable.precede(5, 8));
    const auto rights = timetable.critical_rights(9);
    REQUIRE(rights.size() == 2);
    CHECK(rights[0].first == 5);
    CHECK(rights[1].first == 1);
    CHECK(timetable.critical_rights(2).empty());
}

}  // namespace
}  // namespace rightofway::test
