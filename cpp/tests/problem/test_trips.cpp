#include <doctest/doctest.h>

#include <stdexcept>

#include "problem/trips.hpp"
#include "trips_of.hpp"

namespace rightofway {
namespace {

void check_fleet(test::ClockedFleet fleet) { check(fleet.trips()); }

TEST_CASE("trips that fit together are accepted") {
    CHECK_NOTHROW(check_fleet({test::corridor(), {{0, {{3, 2}, {0}}}, {1, {{2}}, 5}}}));
    CHECK_NOTHROW(check_fleet({test::corridor(), {}}));
}

TEST_CASE("what does not fit is refused") {
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {}}}}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{4}}}}}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{4, {{0}}}}}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{1, -1}}}}}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{1}}, 0}}}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{1}}}, {0, {{2}}}}}),
                    std::invalid_argument);
}

TEST_CASE("robots that keep a headway or book ahead cannot rotate") {
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{1}}}}, 1}), std::invalid_argument);
    CHECK_THROWS_AS(check_fleet({test::corridor(), {{0, {{1}}}}, 0, true}), std::invalid_argument);
    CHECK_NOTHROW(check_fleet({test::corridor(), {{0, {{1}}}}, 1, true, false}));
}

}  // namespace
}  // namespace rightofway
