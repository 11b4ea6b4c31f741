#include <doctest/doctest.h>

#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "corridors.hpp"
#include "drawn_lanes.hpp"
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
    Visits visits() const { return {vertex, dwell, drive}; }
};

bool no_deadline() { return false; }

TEST_CASE("alone, a robot makes its round at the phase it is given") {
    PeriodicBookings bookings(4, 10, 0, false);
    const Trip trip({0, 1, 2, 1});
    Ticks enter;
    CHECK(bookings.search(trip.visits(), 3, enter, no_deadline));
    CHECK(enter == Ticks{-3, 4, 5, 6});  // home again at 7, and stays there until 13
}

TEST_CASE("a round longer than the period has no place") {
    PeriodicBookings bookings(4, 3, 0, false);
    const Trip trip({0, 1, 2, 1});
    Ticks enter;
    CHECK_FALSE(bookings.search(trip.visits(), 0, enter, no_deadline));
}

TEST_CASE("the next one waits for the gap that lets it in and out again") {
    PeriodicBookings bookings(6, 8, 0, false);
    const Trip one({0, 2, 4, 2});  // in the door 2 from 1 to 2 and from 3 to 4
    bookings.add(0, one.visits(), Ticks{-4, 1, 2, 3});
    Trip other({1, 2, 5, 2});
    Ticks enter;
    REQUIRE(bookings.search(other.visits(), 0, enter, no_deadline));
    bookings.add(1, other.visits(), enter);
    CHECK(enter == Ticks{-3, 2, 3, 4});
}

TEST_CASE("what is booked across the seam is booked on both sides of it") {
    PeriodicBookings bookings(4, 6, 0, false);
    const Trip one({0, 2});
    bookings.add(0, one.visits(), Ticks{2, 5});  // in 2 from 5 to 8: over the seam until 2
    const Trip other({1, 2});
    Ticks enter;
    REQUIRE(bookings.search(other.visits(), 0, enter, no_deadline));
    CHECK(enter == Ticks{-3, 2});  // from 2 to 3
}

TEST_CASE("from a home that others pass, the search finds the start that meets itself") {
    PeriodicBookings bookings(4, 10, 0, false);
    const Trip passes({0, 1});  // in 1 from 4 to 6
    bookings.add(0, passes.visits(), Ticks{-4, 4});
    Trip lives({1, 2});
    lives.dwell = {0, 6};  // away for 1 + 6 + 1: home for 2 ticks at least
    Ticks enter;
    REQUIRE(bookings.search(lives.visits(), 0, enter, no_deadline));
    // It is home from 6 on, leaves at 7 for 2, and comes back 7 ticks later: then it waits.
    bookings.add(1, lives.visits(), enter);
    lives.dwell = {0, 9};
    bookings.remove(1);
    CHECK_FALSE(bookings.search(lives.visits(), 0, enter, no_deadline));
}

TEST_CASE("a swap is no way through") {
    PeriodicBookings bookings(4, 4, 0, false);
    const Trip one({0, 1});  // in 1 for one tick in four, in 0 for the rest
    bookings.add(0, one.visits(), Ticks{-2, 1});
    const Trip against({1, 0});  // would have to be in 0 exactly while the other is in 1
    Ticks enter;
    CHECK_FALSE(bookings.search(against.visits(), 0, enter, no_deadline));
    CHECK(bookings.reached() == 0);
}

TEST_CASE("headway and booking ahead keep robots apart") {
    const Trip one({0, 2});
    Trip other({1, 2});
    Ticks enter;
    PeriodicBookings headway(3, 6, 2, false);
    headway.add(0, one.visits(), Ticks{-5, 0});  // in 2 from 0 to 1, booked until 3
    REQUIRE(headway.search(other.visits(), 0, enter, no_deadline));
    CHECK(enter[1] == 3);  // left at 4, booked until 6: that is 1
    PeriodicBookings both(3, 4, 0, true);
    both.add(0, one.visits(), Ticks{-3, 0});  // booked from -1 to 1
    REQUIRE(both.search(other.visits(), 0, enter, no_deadline));
    CHECK(enter[1] == 2);
}

// Drives of robots with sizes along two lanes that cross.
struct CrossingLanes {
    RowFinder finder = test::crossing_lanes().finder();
    Ticks dwell{0, 0};
    Ticks drive{4, 4};
    std::vector<std::int32_t> a_and_b{0, 1};
    std::vector<std::int32_t> c_and_d{2, 3};
    std::vector<std::int32_t> into_a_and_b{5, 4};
    std::vector<std::int32_t> into_c_and_d{7, 6};

    PeriodicBookings bookings(Tick period) const { return {8, period, 0, true, {&finder}}; }
    Visits one() const { return {a_and_b, dwell, drive, into_a_and_b}; }
    Visits other() const { return {c_and_d, dwell, drive, into_c_and_d}; }
};

TEST_CASE("drives along lanes that cross take turns") {
    const CrossingLanes lanes;
    PeriodicBookings bookings = lanes.bookings(16);
    REQUIRE(bookings.add(0, lanes.one(), Ticks{0, 4}));  // drives from 0 to 4 and from 12 to 16
    Ticks enter;
    REQUIRE(bookings.search(lanes.other(), 0, enter, no_deadline));
    CHECK(enter == Ticks{-4, 8});  // to D from 4 to 8, to C from 8 to 12
    CHECK(bookings.add(1, lanes.other(), enter));
    PeriodicBookings shorter = lanes.bookings(15);
    REQUIRE(shorter.add(0, lanes.one(), Ticks{0, 4}));
    CHECK_FALSE(shorter.search(lanes.other(), 0, enter, no_deadline));
}

TEST_CASE("marks of two robots in one row are joined, and leave with their robots") {
    // Vertex 2 lies between 0 and 1, near to both: its row is excluded by rows 0 and 1, too.
    const RowFinder finder = test::DrawnLanes({{0, 0}, {20, 0}, {10, 0}}, {}, 11).finder();
    PeriodicBookings line(3, std::nullopt, 0, true, {&finder});
    const Ticks dwell{0};
    const Ticks drive{1};
    const std::vector<std::int32_t> zero{0};
    const std::vector<std::int32_t> one{1};
    line.add(0, {zero, dwell, drive, zero}, Ticks{3}, 20);  // row 2 from 2 to 20
    line.add(1, {one, dwell, drive, one}, Ticks{5}, 8);     // and from 4 to 8
    std::vector<Tick> starts;
    const auto note = [&starts](const PeriodicBookings::Gap& gap) {
        starts.push_back(gap.start);
        return true;
    };
    line.for_each_gap(2, 6, 100, note);
    CHECK(starts == std::vector<Tick>{20});
    line.remove(0);
    starts.clear();
    line.for_each_gap(2, 6, 100, note);
    CHECK(starts == std::vector<Tick>{8});
}

TEST_CASE("what overlaps, or is no round, is refused and books nothing") {
    PeriodicBookings bookings(4, 6, 0, false);
    const Trip one({0, 2});
    bookings.add(0, one.visits(), Ticks{-3, 2});
    const Trip other({1, 2});
    CHECK_FALSE(bookings.add(1, other.visits(), Ticks{-3, 2}));
    CHECK_THROWS_AS(bookings.add(0, one.visits(), Ticks{-3, 2}), std::invalid_argument);
    CHECK_THROWS_AS(bookings.add(1, other.visits(), Ticks{2, 2}), std::invalid_argument);
    bookings.remove(0);
    bookings.remove(0);
    CHECK(bookings.add(1, other.visits(), Ticks{-3, 2}));
    CHECK_THROWS_AS(PeriodicBookings(4, 0, 0, false), std::invalid_argument);
}

// Home 0, a corridor 1, a stop 2, and home again; one tick each, and one to turn at the stop.
struct ThereAndBack {
    std::vector<VertexId> vertex{0, 1, 2, 1, 0};
    Ticks dwell{0, 0, 1, 0, 0};
    Ticks drive{1, 1, 1, 1, 1};

    Visits visits() const { return {vertex, dwell, drive}; }
};

// One visit of another robot.
void book(PeriodicBookings& line, RobotId robot, VertexId vertex, Tick enter, Tick leave) {
    const std::vector<VertexId> vertices{vertex};
    const Ticks zero{0};
    const Ticks one{1};
    const Ticks enters{enter};
    line.add(robot, {vertices, zero, one}, enters, leave);
}

TEST_CASE("without a period and others, visits begin as early as they can") {
    PeriodicBookings line(3, std::nullopt, 0, false);
    const ThereAndBack trip;
    Ticks enter;
    CHECK(line.connect(trip.visits(), 10, 20, 22, enter));
    CHECK(enter == Ticks{10, 11, 12, 14, 15});
}

TEST_CASE("a robot waits where it can until others have left, and fails where it comes too late") {
    PeriodicBookings line(3, std::nullopt, 0, false);
    const ThereAndBack trip;
    Ticks enter;
    book(line, 7, 1, 13, 17);
    CHECK(line.connect(trip.visits(), 10, 20, 22, enter));
    CHECK(enter == Ticks{10, 11, 12, 17, 18});
    CHECK_FALSE(line.connect(trip.visits(), 10, 17, 22, enter));
    CHECK(line.reached() == 2);
    CHECK(line.users(std::vector<VertexId>{1}, 0, 100) == std::vector<RobotId>{7});
    line.remove(7);
    CHECK(line.connect(trip.visits(), 10, 17, 22, enter));
}

TEST_CASE("the last visit lasts until its leave") {
    PeriodicBookings line(3, std::nullopt, 0, false);
    const ThereAndBack trip;
    Ticks enter;
    book(line, 7, 0, 16, 19);
    CHECK(line.connect(trip.visits(), 10, 20, 22, enter));
    CHECK(enter.back() == 19);
    book(line, 8, 0, 20, 21);
    CHECK_FALSE(line.connect(trip.visits(), 10, 20, 22, enter));
}

TEST_CASE("two robots do not exchange two vertices on a line of time") {
    PeriodicBookings line(3, std::nullopt, 0, false);
    const std::vector<VertexId> back{1, 0};
    const Ticks zero{0, 0};
    const Ticks one{1, 1};
    const Ticks enters{9, 12};
    line.add(7, {back, zero, one}, enters, 13);
    const std::vector<VertexId> there{0, 1};
    Ticks enter;
    CHECK_FALSE(line.connect({there, zero, one}, 10, 12, 14, enter));
    CHECK_FALSE(line.connect({there, zero, one}, 10, 14, 15, enter));  // 7 comes before it is gone
}

TEST_CASE("a line of time refuses what does not fit together, and has no closed tracks") {
    PeriodicBookings line(3, std::nullopt, 0, false);
    CHECK_THROWS_WITH(book(line, 7, 3, 1, 2), "vertex[0]: 3 is not in 0..2");
    CHECK_THROWS_WITH(book(line, 7, 1, 2, 2),
                      "enter[0]: 2 is not before the next, or not within a period");
    Ticks enter;
    CHECK_THROWS_WITH(line.search(ThereAndBack().visits(), 0, enter, no_deadline),
                      "period: 0 is needed for visits that repeat");
}

TEST_CASE("ticks that would overflow, and robots that are nobody, are refused") {
    PeriodicBookings bookings(4, 10, 0, false);
    const Trip trip({0, 1});
    const Tick late = (Tick{1} << 60) + 1;
    Ticks enter;
    CHECK_THROWS_WITH(bookings.add(-1, trip.visits(), Ticks{0, 5}), "robot: -1 is negative");
    CHECK_THROWS_WITH(bookings.add(0, trip.visits(), Ticks{late, late + 1}),
                      "enter[0]: 1152921504606846977 is not in -1152921504606846976.."
                      "1152921504606846976");
    CHECK_THROWS_AS(bookings.search(trip.visits(), late, enter, no_deadline),
                    std::invalid_argument);
    CHECK_THROWS_WITH(bookings.connect(trip.visits(), 0, 655'371, 655'372, enter),
                      "until: 655371 is more than 65536 periods after begins, 0");
}

TEST_CASE("the lists of excluded rows have to be those of as many rows") {
    const RowFinder finder = test::crossing_lanes().finder();
    CHECK_THROWS_WITH(PeriodicBookings(7, 10, 0, true, {&finder}),
                      "lists: its length is 8, but must be 7");
}

TEST_CASE("visits between two others can be interrupted") {
    PeriodicBookings line(600, std::nullopt, 0, false);
    std::vector<VertexId> vertices(600);
    std::iota(vertices.begin(), vertices.end(), 0);
    const Ticks zeros(600, 0);
    const Ticks ones(600, 1);
    Ticks enter;
    const Visits visits{vertices, zeros, ones};
    CHECK_THROWS_AS(line.connect(visits, 0, 600, 700, enter, test::interrupted),
                    std::runtime_error);
    CHECK(line.connect(visits, 0, 600, 700, enter));
    CHECK(enter.back() == 599);
}

}  // namespace
}  // namespace rightofway
