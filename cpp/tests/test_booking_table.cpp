#include <doctest/doctest.h>

#include <stdexcept>

#include "rightofway/booking_table.hpp"

namespace rightofway {
namespace {

TEST_CASE("gaps lie before, between and after bookings and know their neighbours") {
    BookingTable table(2);
    table.book(1, {5, 8}, 3);
    table.book(1, {2, 4}, 7);
    REQUIRE(table.n_gaps(1) == 3);
    CHECK(table.gap(1, 0).start == -infinity);
    CHECK(table.gap(1, 0).end == 2);
    CHECK(table.gap(1, 0).before == -1);
    CHECK(table.gap(1, 1).start == 4);
    CHECK(table.gap(1, 1).end == 5);
    CHECK(table.gap(1, 1).before == 7);
    CHECK(table.gap(1, 1).after == 3);
    CHECK(table.gap(1, 2).end == infinity);
    CHECK(table.n_gaps(0) == 1);
}

TEST_CASE("the first gap after a time is the first that ends later") {
    BookingTable table(1);
    table.book(0, {2, 4}, 0);
    CHECK(table.first_gap_after(0, 1) == 0);
    CHECK(table.first_gap_after(0, 2) == 1);
    CHECK(table.first_gap_after(0, 9) == 1);
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

TEST_CASE("a robot that comes back before its booking is over books on") {
    BookingTable table(1);
    table.book(0, {0, 4}, 7);
    table.book(0, {6, 8}, 7);
    table.book(0, {3, 7}, 7);
    REQUIRE(table.at(0).size() == 1);
    CHECK(table.at(0).front().time.start == 0);
    CHECK(table.at(0).front().time.end == 8);
    table.release(7);
    CHECK(table.at(0).empty());
}

TEST_CASE("a robot gives back all it has booked and nothing else") {
    BookingTable table(2);
    table.book(0, {0, 1}, 4);
    table.book(0, {1, 2}, 5);
    table.book(1, {0, infinity}, 4);
    table.release(4);
    table.release(99);
    CHECK(table.at(1).empty());
    REQUIRE(table.at(0).size() == 1);
    CHECK(table.at(0).front().robot == 5);
}

}  // namespace
}  // namespace rightofway
