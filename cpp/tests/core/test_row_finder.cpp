#include <doctest/doctest.h>

#include <vector>

#include "core/row_finder.hpp"
#include "drawn_lanes.hpp"

namespace rightofway::test {
namespace {

using Rows = std::vector<std::int32_t>;

Rows list(const RowFinder& finder, std::int32_t row) {
    const auto rows = finder.of(row);
    return {rows.begin(), rows.end()};
}

TEST_CASE("lanes that cross exclude each other, in both directions") {
    const RowFinder finder = crossing_lanes().finder();
    CHECK(finder.n_rows() == 8);
    CHECK(list(finder, 4) == Rows{6, 7});
    CHECK(list(finder, 5) == Rows{6, 7});
    CHECK(list(finder, 6) == Rows{4, 5});
    CHECK(list(finder, 0) == Rows{0});
}

TEST_CASE("a row is found when it is asked for, and once") {
    const RowFinder finder = crossing_lanes().finder();
    CHECK(finder.n_found() == 0);
    const auto first = finder.of(4);
    CHECK(finder.of(4).data() == first.data());
    CHECK(finder.n_found() == 1);
}

TEST_CASE("discs may touch") {
    const auto excluded = [](std::uint32_t apart) {  // by a vertex 10 beside the middle of a lane
        return list(DrawnLanes({{0, 10}, {40, 10}, {20, 0}}, {{0, 1}, {1, 0}}, apart).finder(), 2);
    };
    CHECK(excluded(10) == Rows{2});
    CHECK(excluded(11) == Rows{2, 3, 4});
}

TEST_CASE("a near tie is decided by the exact numbers") {
    // Doubles of 10^17 and 10^17 + 1 units of 10^-17 are one number.
    constexpr std::uint64_t unit = 100'000'000'000'000'000;
    const std::vector<EdgeId> indptr{0, 0, 0};
    const std::vector<double> x{0, 1};
    const std::vector<double> y{0, 0};
    const std::vector<double> distance{1};
    const auto excluded = [&](std::uint64_t apart) {
        const std::vector<std::uint32_t> limbs{
            0, 0, 0, 0, static_cast<std::uint32_t>(apart), static_cast<std::uint32_t>(apart >> 32),
            0, 0};
        const std::vector<std::uint32_t> needed{static_cast<std::uint32_t>(unit),
                                                static_cast<std::uint32_t>(unit >> 32)};
        return list(RowFinder({{indptr, {}}, x, y, limbs, 2, distance, needed}), 0);
    };
    CHECK(excluded(unit - 1) == Rows{0, 1});
    CHECK(excluded(unit) == Rows{0});
    CHECK(excluded(unit + 1) == Rows{0});
}

TEST_CASE("members of a zone exclude each other, points included") {
    DrawnLanes crossing = crossing_lanes();
    crossing.distance[0] = 0;
    const Rows zone_first{0, 2};
    const Rows zone_member{0, 6};
    const RowFinder finder({{crossing.indptr, crossing.heads},
                            crossing.x,
                            crossing.y,
                            crossing.limbs,
                            1,
                            crossing.distance,
                            crossing.distance_limbs,
                            1,
                            zone_first,
                            zone_member});
    CHECK(list(finder, 0) == Rows{0, 6});
    CHECK(list(finder, 6) == Rows{0});
    CHECK(list(finder, 4).empty());
    CHECK(finder.may_exclude_edges());
}

TEST_CASE("arrays that do not fit are refused with their name") {
    DrawnLanes crossing = crossing_lanes();
    crossing.x.pop_back();
    CHECK_THROWS_WITH(crossing.finder(), "x: its length is 3, but must be 4");
    crossing = crossing_lanes();
    crossing.distance_limbs.push_back(0);
    CHECK_THROWS_WITH(crossing.finder(), "distance_limbs: its length is 2, but must be 1");
}

}  // namespace
}  // namespace rightofway::test
