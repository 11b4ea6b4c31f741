#include <doctest/doctest.h>

#include "fleets.hpp"
#include "lacam/lacam.hpp"

namespace rightofway {
namespace {

using Vertices = std::vector<VertexId>;
using Ticks = std::vector<Tick>;

constexpr std::int64_t patience = 1'000'000;

SearchEnd run(const test::Fleet& fleet, Tracks& tracks,
              const std::vector<std::uint8_t>& ends_anywhere = {}) {
    const Problem problem = fleet.problem();
    REQUIRE(problem.moves_in_steps());
    StepTables tables(problem.graph());
    const SpaceUtilization paths(problem, tables);
    Lacam search(problem, tables, paths, 0, ends_anywhere);
    const SearchEnd end = search.run(test::no_deadline, patience);
    tracks = search.tracks();
    return end;
}

Vertices ends(const Tracks& tracks) {
    Vertices ends;
    for (std::size_t r = 1; r < tracks.first_visit.size(); ++r) {
        ends.push_back(tracks.vertex[index(tracks.first_visit[r] - 1)]);
    }
    return ends;
}

TEST_CASE("two robots in step change places where there is a bay") {
    Tracks tracks;
    const test::Fleet fleet(test::corridor_with_bay(), {{0, {{2}}}, {2, {{0}}}});
    REQUIRE(run(fleet, tracks) == SearchEnd::found);
    CHECK(ends(tracks) == Vertices{2, 0});
}

TEST_CASE("without a bay they cannot, and that is proven") {
    Tracks tracks;
    const test::Fleet fleet(test::corridor(), {{0, {{3}}}, {3, {{0}}}});
    CHECK(run(fleet, tracks) == SearchEnd::proven_none);
    CHECK(tracks.vertex.empty());
}

TEST_CASE("a robot that may end anywhere gets out of the way, and one that needs not stays") {
    Tracks tracks;
    const test::Fleet fleet(test::corridor(), {{0, {{2}}}, {2, {{2}}}});
    REQUIRE(run(fleet, tracks, {0, 1}) == SearchEnd::found);
    CHECK(ends(tracks) == Vertices{2, 3});
    CHECK(run(fleet, tracks, {0, 0}) == SearchEnd::proven_none);
    const test::Fleet done(test::corridor(), {{0, {{0}}}, {2, {{2}}}});
    REQUIRE(run(done, tracks, {0, 1}) == SearchEnd::found);
    CHECK(tracks.vertex == Vertices{0, 2});
}

TEST_CASE("in steps, stages are passed one after the other") {
    Tracks tracks;
    const test::Fleet fleet(test::corridor(), {{1, {{3}, {0}, {1}}}});
    REQUIRE(run(fleet, tracks) == SearchEnd::found);
    CHECK(tracks.vertex == Vertices{1, 2, 3, 2, 1, 0, 1});
    CHECK(tracks.enter == Ticks{0, 1, 2, 3, 4, 5, 6});
}

TEST_CASE("a full ring turns in one step, if it may") {
    const test::Roads ring{3, {{0, 1}, {1, 2}, {2, 0}}};
    Tracks tracks;
    const std::vector<test::Robot> robots{{0, {{1}}}, {1, {{2}}}, {2, {{0}}}};
    REQUIRE(run(test::Fleet(ring, robots), tracks) == SearchEnd::found);
    CHECK(tracks.vertex == Vertices{0, 1, 1, 2, 2, 0});
    CHECK(tracks.enter == Ticks{0, 1, 0, 1, 0, 1});
    CHECK(run(test::Fleet(ring, robots, {0, false, false}), tracks) == SearchEnd::proven_none);
}

TEST_CASE("a circle of one-way lanes that never comes back has no room for a swap") {
    // 0 = 1, and one way 0 > 2 > 3 > 4 > 2: a robot that backs away from 1 goes round for ever.
    test::Roads roads(5, {});
    roads.indptr = {0, 2, 3, 4, 5, 6};
    roads.heads = {1, 2, 0, 3, 4, 2};
    Tracks tracks;
    CHECK(run(test::Fleet(roads, {{0, {{1}}}, {1, {{0}}}}), tracks) == SearchEnd::proven_none);
}

TEST_CASE("a search in steps that is told to stop proves nothing") {
    const test::Roads ring{5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    // Two robots for one place: many steps, no way.
    const test::Fleet fleet(ring, {{0, {{2}}}, {1, {{1}}}, {2, {{2}}}});
    const Problem problem = fleet.problem();
    StepTables tables(problem.graph());
    const SpaceUtilization paths(problem, tables);
    Lacam search(problem, tables, paths, 0);
    CHECK(search.run([] { return true; }, patience) == SearchEnd::stopped);
}

}  // namespace
}  // namespace rightofway
