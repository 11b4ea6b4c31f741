#include <doctest/doctest.h>

#include <stdexcept>

#include "corridors.hpp"
#include "rightofway/safe_interval_search.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;
using Vertices = std::vector<VertexId>;

// One robot on its way from `home` past stages, among bookings.
struct Case {
    test::Roads roads;
    BookingTable table{4};
    BookingRules rules{0, false};
    VertexId home = 0;
    Vertices stages;
    Ticks dwell;

    SearchEnd run(FoundTrack& found) const {
        const auto ticks = roads.ticks();
        std::vector<std::vector<std::int32_t>> tables;
        Trip trip{home, stages, dwell, ticks, {}};
        for (const VertexId stage : stages) {
            tables.push_back(roads.table(stage));
        }
        for (const auto& one : tables) {
            trip.stage_tables.push_back(one);
        }
        SafeIntervalSearch search(roads.graph(), table, rules, trip);
        const SearchEnd end = search.run(test::never);
        found = search.track();
        return end;
    }
};

TEST_CASE("alone, a robot works at its stop and comes home") {
    FoundTrack found;
    const Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3, 0}, {2, 0}};
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.vertices == Vertices{0, 1, 2, 3, 2, 1, 0});
    // In 3 from tick 3, two ticks of work and one of driving.
    CHECK(found.enter == Ticks{0, 1, 2, 3, 6, 7, 8});
}

TEST_CASE("a robot waits until the vertex ahead is free, and the headway is over") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.book(2, {1, 6}, 9);
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 6, 7});
    one.rules.books_ahead = true;  // 2 is booked while driving there, from tick 6 on
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 7, 8});
}

TEST_CASE("a robot steps aside where it cannot stay") {
    FoundTrack found;
    Case one{test::corridor_with_bay(), BookingTable(4), {0, false}, 0, {0}, {0}};
    one.table.book(0, {3, 5}, 9);  // somebody comes through 1 to the robot's home and goes back
    one.table.book(1, {2, 3}, 9);
    one.table.book(1, {5, 6}, 9);
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.vertices.front() == 0);
    CHECK(found.vertices.back() == 0);
    CHECK(found.enter.back() >= 7);  // 1 is free again from 6 on
}

TEST_CASE("two robots do not change places") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {2}, {0}};
    // Robot 9 stands in 1 until tick 1 and in 0 from then until tick 5: it comes the other way.
    one.table.book(1, {0, 1}, 9);
    one.table.book(0, {1, 5}, 9);
    CHECK(one.run(found) == SearchEnd::proven_none);
    // Where it is somebody else who comes to 0, from elsewhere, the robot may go.
    Case other{test::corridor(), BookingTable(4), {0, false}, 0, {2}, {0}};
    other.table.book(1, {0, 1}, 9);
    other.table.book(0, {1, 5}, 8);
    CHECK(other.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 2});
}

TEST_CASE("without an end that stays free there is no track, and that is proven") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.book(3, {50, infinity}, 9);
    CHECK(one.run(found) == SearchEnd::proven_none);
    CHECK(found.vertices.empty());
}

TEST_CASE("arrays that do not fit together are refused") {
    FoundTrack found;
    const Case far{test::corridor(), BookingTable(4), {0, false}, 7, {3}, {0}};
    CHECK_THROWS_AS(far.run(found), std::invalid_argument);
    const Case uneven{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0, 0}};
    CHECK_THROWS_AS(uneven.run(found), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
