#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "search/periodic_search.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;
using Vertices = std::vector<VertexId>;

bool no_deadline() { return false; }

// Two ways from 0 to 3: by 1, or by 2; edges of one tick, both directions.
struct Diamond {
    std::vector<EdgeId> indptr{0, 2, 4, 6, 8};
    Vertices indices{1, 2, 0, 3, 0, 3, 1, 2};
    std::vector<std::int32_t> length_class = std::vector<std::int32_t>(8, 0);
    std::vector<std::int32_t> pace{1};
    Vertices stage_vertex{3, 0};
    Ticks stage_work{2, 0};
    Ticks stage_turn{0, 1};
    std::vector<std::int32_t> to_three{2, 1, 1, 0};
    std::vector<std::int32_t> to_zero{0, 1, 1, 2};

    Roads roads() const { return {{indptr, indices}, length_class}; }
    Trip trip() const {
        return {0,          stage_vertex, stage_work,
                stage_turn, pace,         {},
                {},         {},           {{to_three.data(), 1}, {to_zero.data(), 1}}};
    }
};

TEST_CASE("alone, a robot takes a shortest way from the phase it is given") {
    const Diamond map;
    const PeriodicBookings bookings(4, 10, 0, false);
    PeriodicSearch search(map.roads(), bookings);
    PeriodicRoundTrip found;
    REQUIRE(search.run(map.trip(), 3, found, no_deadline));
    CHECK(found.vertex == Vertices{0, 1, 3, 1});
    CHECK(found.dwell == Ticks{1, 0, 2, 0});
    CHECK(found.drive == Ticks{1, 1, 1, 1});
    CHECK(found.enter == Ticks{0, 5, 6, 9});  // home again at 10; it waits there until 14
}

TEST_CASE("where one way is taken for long, it goes the other") {
    const Diamond map;
    PeriodicBookings bookings(4, 10, 0, false);
    const Vertices there{1, 3};
    const Ticks dwell{0, 0};
    const Ticks drive{1, 1};
    bookings.add(7, {there, dwell, drive},
                 Ticks{1, 0 + 10});  // in 1 from 1 to 10, in 3 from 0 to 1
    PeriodicSearch search(map.roads(), bookings);
    PeriodicRoundTrip found;
    REQUIRE(search.run(map.trip(), 0, found, no_deadline));
    CHECK(found.vertex == Vertices{0, 2, 3, 2});
    bookings.add(0, {found.vertex, found.dwell, found.drive}, found.enter);
}

TEST_CASE("a trip longer than the period has no place, and what must not be entered is not") {
    Diamond map;
    PeriodicRoundTrip found;
    const PeriodicBookings tight(4, 6, 0, false);
    CHECK_FALSE(PeriodicSearch(map.roads(), tight).run(map.trip(), 0, found, no_deadline));
    const PeriodicBookings bookings(4, 7, 0, false);
    map.to_three[1] = map.to_zero[1] = -1;
    REQUIRE(PeriodicSearch(map.roads(), bookings).run(map.trip(), 0, found, no_deadline));
    CHECK(found.vertex == Vertices{0, 2, 3, 2});
}

TEST_CASE("it stops when it is told to, and refuses another map's roads") {
    const Diamond map;
    PeriodicRoundTrip found;
    const PeriodicBookings bookings(4, 7, 0, false);
    CHECK_FALSE(
        PeriodicSearch(map.roads(), bookings).run(map.trip(), 0, found, [] { return true; }));
    const PeriodicBookings other(5, 7, 0, false);
    CHECK_THROWS_AS(PeriodicSearch(map.roads(), other), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
