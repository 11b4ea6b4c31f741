#include <doctest/doctest.h>

#include <vector>

#include "search/seam.hpp"

namespace rightofway {
namespace {

// Home 0, a corridor 1, a stop 2, and home again; one tick each, and one to turn at the stop.
struct Trip {
    std::vector<VertexId> vertex{0, 1, 2, 1, 0};
    std::vector<Tick> dwell{0, 0, 1, 0, 0};
    std::vector<Tick> drive{1, 1, 1, 1, 1};

    Seam::Stretch stretch() const { return {vertex, dwell, drive}; }
};

// One visit of another robot.
void book(Seam& seam, RobotId robot, VertexId vertex, Tick enter, Tick leave) {
    const std::vector<VertexId> vertices{vertex};
    const std::vector<Tick> none{0};
    const std::vector<Tick> one{1};
    const std::vector<Tick> enters{enter};
    seam.add(robot, {vertices, none, one}, enters, leave);
}

TEST_CASE("where nobody is in the way a robot goes through as fast as it can") {
    Seam seam(3, 0, false);
    const Trip trip;
    std::vector<Tick> enter;
    CHECK(seam.connect(trip.stretch(), 10, 20, 22, enter));
    CHECK(enter == std::vector<Tick>{10, 11, 12, 14, 15});
}

TEST_CASE("it waits where it can until the others are gone, and gives up where it comes too late") {
    Seam seam(3, 0, false);
    const Trip trip;
    std::vector<Tick> enter;
    book(seam, 7, 1, 13, 17);
    CHECK(seam.connect(trip.stretch(), 10, 20, 22, enter));
    CHECK(enter == std::vector<Tick>{10, 11, 12, 17, 18});
    CHECK_FALSE(seam.connect(trip.stretch(), 10, 17, 22, enter));
    CHECK(seam.reached() == 2);
    CHECK(seam.users(1, 0, 100) == std::vector<RobotId>{7});
    seam.remove(7, std::vector<VertexId>{1});
    CHECK(seam.connect(trip.stretch(), 10, 17, 22, enter));
}

TEST_CASE("at the end it has to be able to stay where it is") {
    Seam seam(3, 0, false);
    const Trip trip;
    std::vector<Tick> enter;
    book(seam, 7, 0, 16, 19);
    CHECK(seam.connect(trip.stretch(), 10, 20, 22, enter));
    CHECK(enter.back() == 19);
    book(seam, 8, 0, 20, 21);
    CHECK_FALSE(seam.connect(trip.stretch(), 10, 20, 22, enter));
}

TEST_CASE("two robots do not exchange two vertices") {
    Seam seam(3, 0, false);
    const std::vector<VertexId> back{1, 0};
    const std::vector<Tick> none{0, 0};
    const std::vector<Tick> one{1, 1};
    const std::vector<Tick> enters{9, 12};
    seam.add(7, {back, none, one}, enters, 13);
    const std::vector<VertexId> there{0, 1};
    std::vector<Tick> enter;
    CHECK_FALSE(seam.connect({there, none, one}, 10, 12, 14, enter));
    CHECK_FALSE(seam.connect({there, none, one}, 10, 14, 15, enter));  // 7 comes before it is gone
}

TEST_CASE("what does not fit together is refused") {
    Seam seam(3, 0, false);
    CHECK_THROWS_WITH(book(seam, 7, 3, 1, 2), "vertex[0]: 3 is not in 0..2");
    CHECK_THROWS_WITH(book(seam, 7, 1, 2, 2), "enter[0]: 2 is not before the next");
}

}  // namespace
}  // namespace rightofway
