#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "problem/overlaps.hpp"

namespace rightofway {
namespace {

using Ints = std::vector<std::int32_t>;
using Ticks = std::vector<Tick>;

constexpr std::size_t many = 100;

Overlaps find(const Ints& vertex, const Ticks& start, const Ticks& end, const Ints& robot,
              std::size_t most = many) {
    return find_overlaps({vertex, start, end, robot}, most, {});
}

TEST_CASE("bookings of two robots at one vertex overlap unless one ends when the other starts") {
    // At vertex 3: 0-5 of robot 0, 2-4 of robot 1, 4-never of robot 2, 5-6 of robot 1; at 4: 5-6.
    const Overlaps found =
        find({3, 3, 3, 3, 4}, {0, 2, 4, 5, 5}, {5, 4, never, 6, 6}, {0, 1, 2, 1, 0});
    CHECK(found.end == SearchEnd::found);
    CHECK(found.earlier == Ints{0, 0, 2});
    CHECK(found.later == Ints{1, 2, 3});
}

TEST_CASE("a robot does not overlap itself, and at most as many pairs are found as are asked for") {
    CHECK(find({0, 0}, {0, 1}, {5, 5}, {7, 7}).later.empty());
    const Overlaps some = find({0, 0, 0}, {0, 1, 1}, {5, 5, 5}, {1, 2, 3}, 2);
    CHECK(some.end == SearchEnd::stopped);
    CHECK(some.later == Ints{1});
}

TEST_CASE("columns of other lengths and in another order are refused") {
    CHECK_THROWS_AS(find({0, 0}, {1, 0}, {5, 5}, {1, 2}), std::invalid_argument);
    CHECK_THROWS_AS(find({0, 0}, {0}, {5, 5}, {1, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway
