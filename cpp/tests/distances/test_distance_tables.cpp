#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "distances/distance_tables.hpp"

namespace rightofway {
namespace {

using Ints = std::vector<std::int32_t>;

constexpr std::int32_t int32_max = std::numeric_limits<std::int32_t>::max();

// 0 -> 1 -> 2 and the shortcut 0 -> 2; nothing leaves 2. Edges: 0: 0->1, 1: 0->2, 2: 1->2.
DistanceTables triangle() { return DistanceTables(Ints{0, 2, 3, 3}, Ints{1, 2, 2}); }

TEST_CASE("equal edges are counted and multiplied") {
    CHECK(triangle().to(2, Ints{5, 5, 5}) == Ints{5, 5, 0});
}

TEST_CASE("unequal edges are added up along the quickest way") {
    // From 0 to 2: over 1 it takes 1 + 3 = 4, directly 9.
    CHECK(triangle().to(2, Ints{1, 9, 3}) == Ints{4, 3, 0});
    // With a shortcut of 2 ticks the direct way wins.
    CHECK(triangle().to(2, Ints{1, 2, 3}) == Ints{2, 3, 0});
}

TEST_CASE("edges are one-way streets, and -1 says that no way leads to the target") {
    CHECK(triangle().to(0, Ints{1, 1, 1}) == Ints{0, -1, -1});
    CHECK(triangle().to(1, Ints{4, 1, 1}) == Ints{4, 0, -1});
}

TEST_CASE("parallel edges and loops do no harm") {
    // 0 -> 0, 0 -> 1 (7 ticks), 0 -> 1 (2 ticks)
    const DistanceTables tables(Ints{0, 3, 3}, Ints{0, 1, 1});
    CHECK(tables.to(1, Ints{1, 7, 2}) == Ints{2, 0});
}

TEST_CASE("a graph without edges has distances to itself only") {
    const DistanceTables tables(Ints{0, 0, 0}, Ints{});
    CHECK(tables.to(1, Ints{}) == Ints{-1, 0});
    CHECK(tables.n_vertices() == 2);
}

TEST_CASE("a least distance that does not fit is an error, whether or not edges are equal") {
    const DistanceTables line(Ints{0, 1, 2, 2}, Ints{1, 2});
    CHECK_THROWS_WITH_AS(line.to(2, Ints{int32_max, int32_max}),
                         "distance from 0 to 2: 4294967294 ticks do not fit int32 "
                         "(bring speeds and lengths closer together)",
                         std::overflow_error);
    CHECK_THROWS_AS(line.to(2, Ints{1, int32_max}), std::overflow_error);
    CHECK(line.to(2, Ints{1, int32_max - 1}) == Ints{int32_max, int32_max - 1, 0});
}

TEST_CASE("a detour that does not fit is no error as long as nobody takes it") {
    // Over 1 it would take 2^31 ticks, directly 5.
    CHECK(triangle().to(2, Ints{1, 5, int32_max}) == Ints{5, int32_max, 0});
}

TEST_CASE("what is no graph is refused with the entry that is wrong") {
    const auto make = [](Ints indptr, Ints indices) { return DistanceTables(indptr, indices); };
    CHECK_THROWS_WITH(make({}, {}), "indptr: its length is 0, but must be at least 1");
    CHECK_THROWS_WITH(make({1, 1}, {0}), "indptr[0]: 1 must be 0");
    CHECK_THROWS_WITH(make({0, 2, 1}, {0}), "indptr[2]: 1 is less than the entry before it");
    CHECK_THROWS_WITH(make({0, 2}, {0}), "indptr[1]: 2 is not the number of edges, 1");
    CHECK_THROWS_WITH(make({0, 1}, {1}), "indices[0]: 1 is not in 0..0");
    CHECK_THROWS_WITH(make({0, 1}, {-1}), "indices[0]: -1 is not in 0..0");
}

TEST_CASE("a bad request is refused with the entry that is wrong") {
    CHECK_THROWS_WITH(triangle().to(3, Ints{1, 1, 1}), "target: 3 is not in 0..2");
    CHECK_THROWS_WITH(triangle().to(-1, Ints{1, 1, 1}), "target: -1 is not in 0..2");
    CHECK_THROWS_WITH(triangle().to(0, Ints{1, 1}), "edge_ticks: its length is 2, but must be 3");
    CHECK_THROWS_WITH(triangle().to(0, Ints{1, 0, 1}),
                      "edge_ticks[1]: 0 is neither positive nor -1");
}

}  // namespace
}  // namespace rightofway
