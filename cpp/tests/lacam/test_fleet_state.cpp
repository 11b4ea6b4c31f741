#include <doctest/doctest.h>

#include "fleets.hpp"
#include "lacam/fleet_state.hpp"

namespace rightofway {
namespace {

TEST_CASE("a robot on the move holds both ends until it arrives") {
    test::Fleet fleet{test::corridor(), {{0, {{3}}, 4}}};
    const Problem problem = fleet.problem();
    FleetState state(problem);
    state.decide({0, 1, 4});
    CHECK(state.here(0) == 0);
    CHECK(state.comes(1) == 0);
    CHECK(state.undecided().empty());
    REQUIRE(state.advance());
    CHECK(state.now() == 4);
    CHECK(state.at(0) == 1);
    CHECK(state.here(0) == nobody);
    CHECK(state.left(0) == 4);
    CHECK(state.comes(1) == nobody);
    CHECK(state.undecided().size() == 1);
}

TEST_CASE("a robot works where it has to, and goes on to its next stage") {
    test::Fleet fleet{test::corridor(), {{0, {{1, 5}, {0}}}}};
    const Problem problem = fleet.problem();
    FleetState state(problem);
    state.decide({0, 1, 1});
    REQUIRE(state.advance());
    CHECK(state.is_busy(0));
    CHECK(state.undecided().empty());
    REQUIRE(state.advance());
    CHECK(state.now() == 6);  // arrived at 1, five ticks of work
    CHECK(state.target(0) == 0);
    CHECK(state.on_its_way_since(0) == 6);
    CHECK_FALSE(state.is_goal());
    state.decide({0, 0, 7});
    REQUIRE(state.advance());
    CHECK(state.is_goal());
    CHECK_FALSE(state.advance());
}

TEST_CASE("who follows at one instant finds the vertex free") {
    test::Fleet fleet{test::corridor(), {{0, {{1}}}, {1, {{2}}}}};
    const Problem problem = fleet.problem();
    FleetState state(problem);
    state.decide({0, 1, 1});
    state.decide({1, 2, 1});
    REQUIRE(state.advance());
    CHECK(state.here(0) == nobody);
    CHECK(state.here(1) == 0);
    CHECK(state.here(2) == 1);
    CHECK(state.is_goal());
}

TEST_CASE("fingerprints tell states apart, but not by the clock") {
    test::Fleet fleet{test::corridor(), {{0, {{3}}, 2}, {3, {{2}}}}};
    const Problem problem = fleet.problem();
    FleetState state(problem);
    const std::uint64_t at_home = state.fingerprint();
    state.decide({0, 1, 2});
    state.decide({1, 2, 1});
    REQUIRE(state.advance());  // robot 1 has arrived, robot 0 needs one more tick
    const std::uint64_t on_the_way = state.fingerprint();
    CHECK(on_the_way != at_home);

    FleetState later(problem);
    later.decide({1, 2, 1});
    REQUIRE(later.advance());
    later.decide({1, 3, 2});
    REQUIRE(later.advance());
    CHECK(later.fingerprint() == at_home);
    later.decide({0, 1, 4});
    later.decide({1, 2, 3});
    REQUIRE(later.advance());
    CHECK(later.now() == 3);
    CHECK(later.fingerprint() == on_the_way);

    FleetState slower(problem);
    slower.decide({0, 1, 3});
    slower.decide({1, 2, 1});
    REQUIRE(slower.advance());  // as on_the_way, but robot 0 needs two more ticks
    CHECK(slower.fingerprint() != on_the_way);
}

TEST_CASE("robots are put back where they stood, and no vertex was left later than now") {
    const test::Fleet fleet{test::corridor(), {{0, {{3}}}}};
    const Problem problem = fleet.problem();
    FleetState state(problem);
    const Standing before = state.standing(0);
    const std::uint64_t fingerprint = state.fingerprint();
    for (const VertexId vertex : {1, 2}) {
        state.decide({0, vertex, state.now() + 1});
        REQUIRE(state.advance());
    }
    CHECK(state.standing(0).waited == 2);
    state.resume(std::vector{before});
    CHECK(state.at(0) == 0);
    CHECK(state.here(0) == 0);
    CHECK(state.here(2) == nobody);
    CHECK(state.standing(0).waited == 0);
    CHECK(state.fingerprint() == fingerprint);
    CHECK(state.left(1) <= state.now());
}

}  // namespace
}  // namespace rightofway
