#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "search/periodic_bookings.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

struct Trip {
    std::vector<VertexId> vertex;
    Ticks dwell;
    Ticks drive;

    explicit Trip(std::vector<VertexId> vertices)
        : vertex(std::move(vertices)), dwell(vertex.size(), 0), drive(vertex.size(), 1) {}
    Round round() const { return {vertex, dwell, drive}; }
};

bool no_deadline() { return false; }

TEST_CASE("alone, a robot makes its round at the phase it is given") {
    PeriodicBookings circle(4, 10, 0, false);
    const Trip trip({0, 1, 2, 1});
    Ticks enter;
    CHECK(circle.search(trip.round(), 3, enter, no_deadline));
    CHECK(enter == Ticks{-3, 4, 5, 6});  // home again at 7, and stays there until 13
}

TEST_CASE("a round longer than the period has no place") {
    PeriodicBookings circle(4, 3, 0, false);
    const Trip trip({0, 1, 2, 1});
    Ticks enter;
    CHECK_FALSE(circle.search(trip.round(), 0, enter, no_deadline));
}

TEST_CASE("the next one waits for the gap that lets it in and out again") {
    PeriodicBookings circle(6, 8, 0, false);
    const Trip one({0, 2, 4, 2});  // in the door 2 from 1 to 2 and from 3 to 4
    circle.add(0, one.round(), Ticks{-4, 1, 2, 3});
    Trip other({1, 2, 5, 2});
    Ticks enter;
    REQUIRE(circle.search(other.round(), 0, enter, no_deadline));
    circle.add(1, other.round(), enter);
    CHECK(enter == Ticks{-3, 2, 3, 4});
}

TEST_CASE("what is booked across the seam is booked on both sides of it") {
    PeriodicBookings circle(4, 6, 0, false);
    const Trip one({0, 2});
    circle.add(0, one.round(), Ticks{2, 5});  // in 2 from 5 to 8: over the seam until 2
    const Trip other({1, 2});
    Ticks enter;
    REQUIRE(circle.search(other.round(), 0, enter, no_deadline));
    CHECK(enter == Ticks{-3, 2});  // from 2 to 3
}

TEST_CASE("from a home that others pass, the search finds the start that meets itself") {
    PeriodicBookings circle(4, 10, 0, false);
    const Trip passes({0, 1});  // in 1 from 4 to 6
    circle.add(0, passes.round(), Ticks{-4, 4});
    Trip lives({1, 2});
    lives.dwell = {0, 6};  // away for 1 + 6 + 1: home for 2 ticks at least
    Ticks enter;
    REQUIRE(circle.search(lives.round(), 0, enter, no_deadline));
    // It is home from 6 on, leaves at 7 for 2, and comes back 7 ticks later: then it waits.
    circle.add(1, lives.round(), enter);
    lives.dwell = {0, 9};
    circle.remove(1);
    CHECK_FALSE(circle.search(lives.round(), 0, enter, no_deadline));
}

TEST_CASE("a swap is no way through") {
    PeriodicBookings circle(4, 4, 0, false);
    const Trip one({0, 1});  // in 1 for one tick in four, in 0 for the rest
    circle.add(0, one.round(), Ticks{-2, 1});
    const Trip against({1, 0});  // would have to be in 0 exactly while the other is in 1
    Ticks enter;
    CHECK_FALSE(circle.search(against.round(), 0, enter, no_deadline));
    CHECK(circle.reached() == 0);
}

TEST_CASE("headway and booking ahead keep robots apart") {
    const Trip one({0, 2});
    Trip other({1, 2});
    Ticks enter;
    PeriodicBookings headway(3, 6, 2, false);
    headway.add(0, one.round(), Ticks{-5, 0});  // in 2 from 0 to 1, booked until 3
    REQUIRE(headway.search(other.round(), 0, enter, no_deadline));
    CHECK(enter[1] == 3);  // left at 4, booked until 6: that is 1
    PeriodicBookings both(3, 4, 0, true);
    both.add(0, one.round(), Ticks{-3, 0});  // booked from -1 to 1
    REQUIRE(both.search(other.round(), 0, enter, no_deadline));
    CHECK(enter[1] == 2);
}

TEST_CASE("what overlaps, or is no round, is refused and books nothing") {
    PeriodicBookings circle(4, 6, 0, false);
    const Trip one({0, 2});
    circle.add(0, one.round(), Ticks{-3, 2});
    const Trip other({1, 2});
    CHECK_THROWS_WITH_AS(circle.add(1, other.round(), Ticks{-3, 2}),
                         "enter[1]: 2 overlaps the booking of another robot",
                         std::invalid_argument);
    CHECK_THROWS_AS(circle.add(0, one.round(), Ticks{-3, 2}), std::invalid_argument);
    CHECK_THROWS_AS(circle.add(1, other.round(), Ticks{2, 2}), std::invalid_argument);
    circle.remove(0);
    circle.remove(0);
    circle.add(1, other.round(), Ticks{-3, 2});
    CHECK_THROWS_AS(PeriodicBookings(4, 0, 0, false), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
