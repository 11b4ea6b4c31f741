#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "core/random.hpp"
#include "search/booking_table.hpp"

namespace rightofway {
namespace {

TEST_CASE("bookings lie in order of time and know how far those before them reach") {
    BookingTable table(2);
    table.book(1, {5, 8}, 3);
    table.book(1, {2, 4}, 7);
    REQUIRE(table.at(1).size() == 2);
    CHECK(table.at(1)[0].robot == 7);
    CHECK(table.at(1)[0].reach == 4);
    CHECK(table.at(1)[1].reach == 8);
    CHECK(table.at(0).empty());
    CHECK(BookingTable::started(table.at(1), 1) == 0);
    CHECK(BookingTable::started(table.at(1), 2) == 1);
    CHECK(BookingTable::started(table.at(1), 9) == 2);
}

TEST_CASE("bookings may touch but not overlap") {
    BookingTable table(1);
    table.book(0, {2, 4}, 0);
    table.book(0, {4, 6}, 1);
    CHECK_THROWS_AS(table.book(0, {3, 5}, 2), std::invalid_argument);
    CHECK_THROWS_AS(table.book(0, {0, 3}, 2), std::invalid_argument);
    CHECK_THROWS_AS(table.book(0, {7, 7}, 2), std::invalid_argument);
    CHECK_THROWS_AS(table.book(1, {7, 8}, 2), std::invalid_argument);
    CHECK(table.at(0).size() == 2);
}

TEST_CASE("a robot may book on before its own booking is over") {
    BookingTable table(1);
    table.book(0, {0, 4}, 7);
    table.book(0, {3, 7}, 7);
    CHECK_THROWS_AS(table.book(0, {6, 9}, 1), std::invalid_argument);
    CHECK_NOTHROW(table.book(0, {7, 9}, 1));
}

TEST_CASE("where bookings overlap, all of them are seen") {
    BookingTable table(1);
    table.insert(0, {0, never}, 4);
    table.insert(0, {2, 3}, 5);
    CHECK(table.at(0)[1].reach == never);
    CHECK_THROWS_AS(table.book(0, {8, 9}, 5), std::invalid_argument);
    CHECK_NOTHROW(table.book(0, {8, 9}, 4));
    table.erase(0, 0, 4);
    CHECK(table.at(0)[0].reach == 3);
}

TEST_CASE("a booking is taken back, and what is not there is left alone") {
    BookingTable table(2);
    table.book(0, {0, 1}, 4);
    table.book(0, {1, 2}, 5);
    table.erase(0, 0, 4);
    table.erase(0, 1, 9);
    table.erase(1, 0, 4);
    REQUIRE(table.at(0).size() == 1);
    CHECK(table.at(0).front().robot == 5);
}

TEST_CASE("many bookings and takings back leave what a plain list would hold") {
    BookingTable table(3);
    std::vector<std::vector<Tick>> plain(3);
    Random random(7);
    for (int k = 0; k < 2000; ++k) {
        const auto vertex = static_cast<VertexId>(random.below(3));
        const Tick start = 10 * static_cast<Tick>(random.below(60));
        auto& list = plain[index(vertex)];
        const auto known = std::find(list.begin(), list.end(), start);
        if (known == list.end()) {
            table.book(vertex, {start, start + 10}, static_cast<RobotId>(start));
            list.push_back(start);
        } else {
            table.erase(vertex, start, static_cast<RobotId>(start));
            list.erase(known);
        }
        std::sort(list.begin(), list.end());
        REQUIRE(table.at(vertex).size() == list.size());
        for (std::size_t j = 0; j < list.size(); ++j) {
            CHECK(table.at(vertex)[j].time.start == list[j]);
            CHECK(table.at(vertex)[j].reach == list[j] + 10);
        }
    }
}

TEST_CASE("bookings beyond the ends of time, and marks of nothing, are refused") {
    BookingTable table(2);
    CHECK_THROWS_WITH(table.mark(2, {0, 1}, 0), "row: 2 is not in 0..1");
    CHECK_THROWS_WITH(table.mark(0, {3, 3}, 0), "end: 3 is not after start, 3");
    CHECK_THROWS_WITH(table.mark(0, {0, 1}, -2), "robot: -2 is no robot, and not -1 for nobody");
    CHECK_THROWS_WITH(table.book(0, {-never - 1, 3}, 0),
                      "start: -4611686018427387905 is not in -4611686018427387904.."
                      "4611686018427387904");
    CHECK_THROWS_WITH(BookingTable(-1), "n_vertices: -1 is not in 0..67108864");
}

}  // namespace
}  // namespace rightofway
