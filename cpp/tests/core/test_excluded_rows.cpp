#include <doctest/doctest.h>

#include <vector>

#include "core/excluded_rows.hpp"

namespace rightofway {
namespace {

using Rows = std::vector<std::int32_t>;

void check(const Rows& first, const Rows& excluded) { require_excluded_rows({first, excluded}); }

TEST_CASE("lists that rise, of rows that exist, are let in") {
    CHECK_NOTHROW(check({0}, {}));
    CHECK_NOTHROW(check({0, 2, 2, 3}, {0, 2, 1}));
}

TEST_CASE("lists of excluded rows are refused with index and value") {
    CHECK_THROWS_WITH(check({}, {}), "first: its length is 0, but must be at least 1");
    CHECK_THROWS_WITH(check({1, 2}, {0, 0}), "first[0]: 1 must be 0");
    CHECK_THROWS_WITH(check({0, 2, 1}, {0}), "first[2]: 1 is less than the entry before it");
    CHECK_THROWS_WITH(check({0, 2}, {0}), "first[1]: 2 is not the number of entries, 1");
    CHECK_THROWS_WITH(check({0, 1, 2}, {0, 2}), "excluded[1]: 2 is not in 0..1");
    CHECK_THROWS_WITH(check({0, 1, 2}, {0, -1}), "excluded[1]: -1 is not in 0..1");
    CHECK_THROWS_WITH(check({0, 2, 2}, {1, 0}),
                      "excluded[1]: 0 is not above the entry before it (rows of a list rise)");
}

}  // namespace
}  // namespace rightofway
