#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "core/whole.hpp"

namespace rightofway {
namespace {

Whole whole(std::int64_t value) {
    const auto size = static_cast<std::uint64_t>(value < 0 ? -value : value);
    const std::vector<std::uint32_t> limbs{static_cast<std::uint32_t>(size),
                                           static_cast<std::uint32_t>(size >> 32)};
    return value < 0 ? Whole() - Whole(limbs) : Whole(limbs);
}

TEST_CASE("sums, differences, products and comparisons are those of 64 bits where they fit") {
    const std::vector<std::int64_t> values{0,
                                           1,
                                           -1,
                                           7,
                                           -12,
                                           0xffffffff,
                                           -0x100000000,
                                           0x7fffffff,
                                           0x80000000,
                                           -0x123456789,
                                           3'000'000'001};
    for (const std::int64_t a : values) {
        for (const std::int64_t b : values) {
            CHECK(whole(a) + whole(b) == whole(a + b));
            CHECK(whole(a) - whole(b) == whole(a - b));
            CHECK(((whole(a) < whole(b)) == (a < b)));
            if (a < (std::int64_t{1} << 31) && b < (std::int64_t{1} << 31) &&
                -a < (std::int64_t{1} << 31) && -b < (std::int64_t{1} << 31)) {
                CHECK(whole(a) * whole(b) == whole(a * b));
            }
        }
    }
}

TEST_CASE("products of many limbs keep every bit") {
    // (2^64 - 1)^2 = 2^128 - 2 * 2^64 + 1
    const Whole most = whole(0xffffffff) * whole(0x100000001);
    const Whole two_64 = most + whole(1);
    CHECK(most * most == two_64 * two_64 - two_64 - two_64 + whole(1));
    CHECK((most * most - two_64 * two_64).sign() == -1);
    CHECK((most - most).sign() == 0);
}

}  // namespace
}  // namespace rightofway
