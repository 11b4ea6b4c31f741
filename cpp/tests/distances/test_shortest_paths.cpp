#include <doctest/doctest.h>

#include <stdexcept>

#include "distances/shortest_paths.hpp"

namespace rightofway {
namespace {

using Ints = std::vector<std::int32_t>;

constexpr int n_rounds = 12;  // the first paths go down tables, later ones are searched

// 0 -> 1 -> 3 and 0 -> 2 -> 3, edges in this order: 0 -> 1, 0 -> 2, 1 -> 3, 2 -> 3.
ShortestPaths diamond(const Ints& ticks) {
    return ShortestPaths(Ints{0, 2, 3, 4, 4}, Ints{1, 2, 3, 3}, ticks);
}

TEST_CASE("of equally long paths the first edge counts, with landmarks and without") {
    ShortestPaths equal = diamond({1, 1, 1, 1});
    ShortestPaths later = diamond({1, 2, 4, 2});
    for (int round = 0; round < n_rounds; ++round) {
        CHECK(equal.find(0, 3) == Ints{0, 1, 3});
        CHECK(later.find(0, 3) == Ints{0, 2, 3});
    }
}

TEST_CASE("an edge that is barred is on no path, and no path is an empty one") {
    ShortestPaths paths = diamond({1, 9, barred, 9});
    for (int round = 0; round < n_rounds; ++round) {
        CHECK(paths.find(0, 3) == Ints{0, 2, 3});
        CHECK(paths.find(3, 0).empty());
        CHECK(paths.find(1, 3).empty());
        CHECK(paths.find(2, 2) == Ints{2});
    }
}

TEST_CASE("unknown vertices and numbers of ticks that do not fit are refused") {
    ShortestPaths paths = diamond({1, 1, 1, 1});
    CHECK_THROWS_AS(paths.find(4, 0), std::invalid_argument);
    CHECK_THROWS_AS(paths.find(0, -1), std::invalid_argument);
    CHECK_THROWS_AS(diamond({1, 1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(diamond({1, 0, 1, 1}).find(0, 3), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
