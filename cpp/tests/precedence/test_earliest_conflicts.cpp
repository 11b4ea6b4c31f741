#include "example.hpp"
#include "precedence/earliest_conflicts.hpp"

namespace rightofway::test {
namespace {

// Robots that run freely until a right of way is given; then the index and the memory are told.
struct System {
    explicit System(const Example& example)
        : routes(example.routes()),
          timetable(routes),
          conflicts(routes),
          earliest(routes, timetable, conflicts) {
        for (VisitId x = 0; x < routes.n_visits(); ++x) {
            conflicts.add(x, timetable);
        }
    }

    void precede(VisitId a, VisitId b) {
        REQUIRE(timetable.precede(a, b));
        tell();
    }
    void rollback(std::size_t n_rights) {
        timetable.rollback(n_rights);
        tell();
    }
    void tell() {
        for (const VisitId x : timetable.changed()) {
            conflicts.move(x - 1, timetable);
            conflicts.move(x, timetable);
            earliest.forget(routes.robot(x));
        }
    }

    Routes routes;
    Timetable timetable;
    ConflictIndex conflicts;
    EarliestConflicts earliest;
};

constexpr auto vertex_kind = ConflictKind::vertex;

// The first two meet at 9 at tick 1, the last two at 8 at tick 2. Visits 0 1 2 | 3 4 5 6 | 7 8
// 9 10.
Example two_meetings() { return Example({{0, 9, 1}, {2, 9, 8, 3}, {4, 5, 8, 6}}); }

constexpr Conflict at_nine{1, 0, 1, 1, 4, vertex_kind};
constexpr Conflict at_eight{2, 1, 2, 5, 9, vertex_kind};

TEST_CASE("the earliest conflict comes first") {
    System system(two_meetings());
    CHECK(system.earliest.next() == at_nine);
    CHECK(system.earliest.next() == at_nine);
}

TEST_CASE("a remembered conflict goes when one of its robots changes its times") {
    // The second robot waits for the first at 9 and so comes to 8 at tick 3, when 8 is free.
    System system(two_meetings());
    REQUIRE(system.earliest.next() == at_nine);
    system.precede(1, 4);
    CHECK_FALSE(system.earliest.next().has_value());
}

TEST_CASE("a conflict that stays is still found when another robot's change removes the first") {
    // The first robot waits at 9 for the second instead.
    System system(two_meetings());
    REQUIRE(system.earliest.next() == at_nine);
    system.precede(4, 1);
    CHECK(system.earliest.next() == at_eight);
}

TEST_CASE("a new conflict is found although its other robot has not changed") {
    // The third robot is at 8 during [3, 4), clear of the second until that has waited at 9.
    System system(Example({{0, 9, 1}, {2, 9, 8, 3}, {4, 5, 6, 8, 7}}));
    REQUIRE(system.earliest.next() == at_nine);
    system.precede(1, 4);
    CHECK(system.earliest.next() == Conflict{3, 1, 2, 5, 10, vertex_kind});
}

TEST_CASE("a conflict comes back when what resolved it is taken back") {
    System system(two_meetings());
    system.precede(1, 4);
    REQUIRE_FALSE(system.earliest.next().has_value());
    system.rollback(0);
    CHECK(system.earliest.next() == at_nine);
}

TEST_CASE("a long approach makes a later visit conflict earlier") {
    // The robots meet at 9 at tick 2. But the first books 8 from 3 - 3 = 0 on for its visit after
    // that, and the second is there during [0, 2).
    Example example({{0, 1, 9, 8}, {8, 9, 4}});
    example.approach = {0, 0, 0, 3, 0, 0, 0};
    example.least = {1, 1, 1, 1, 2, 1, 1};
    System system(example);
    CHECK(system.earliest.between(0, 1) == Conflict{0, 0, 1, 3, 4, vertex_kind});
    CHECK(system.earliest.next() == Conflict{0, 0, 1, 3, 4, vertex_kind});
}

TEST_CASE("two robots are asked about in either order") {
    const System system(two_meetings());
    CHECK(system.earliest.between(1, 2) == at_eight);
    CHECK(system.earliest.between(2, 1) == at_eight);
    CHECK_FALSE(system.earliest.between(0, 2).has_value());
}

}  // namespace
}  // namespace rightofway::test
