#include <doctest/doctest.h>

#include "distances/energy_tables.hpp"

namespace rightofway {
namespace {

using Ids = std::vector<std::int32_t>;
using Wholes = std::vector<std::int64_t>;

// 0 -> 1 -> 2 and the direct way 0 -> 2; nothing leaves 2. Edges: 0: 0->1, 1: 0->2, 2: 1->2.
struct Triangle {
    Ids indptr{0, 2, 3, 3};
    Ids heads{1, 2, 2};
    ReverseGraph reverse{Graph{indptr, heads}};
};

TEST_CASE("the quickest way counts, and the least energy of equally quick ones") {
    const Triangle roads;
    // Over 1 it takes 1 + 2 ticks, directly 3 or 4.
    CHECK(find_energies_of_quickest_ways(roads.reverse, Ids{3, 2, 0}, Ids{1, 4, 2}, Wholes{5, 1, 7},
                                         99) == Wholes{12, 7, 0});
    CHECK(find_energies_of_quickest_ways(roads.reverse, Ids{3, 2, 0}, Ids{1, 3, 2}, Wholes{5, 1, 7},
                                         99) == Wholes{1, 7, 0});
}

TEST_CASE("energies end at the most, also without a way") {
    const Triangle roads;
    CHECK(find_energies_of_quickest_ways(roads.reverse, Ids{1, 0, -1}, Ids{1, 3, 2},
                                         Wholes{5, 1, 7}, 4) == Wholes{4, 0, 4});
    CHECK(find_least_energies(roads.reverse, Ids{0}, Wholes{5, 1, 7}, 4) == Wholes{0, 4, 4});
}

TEST_CASE("the least energy leads to any target and along no barred edge") {
    const Triangle roads;
    CHECK(find_least_energies(roads.reverse, Ids{1, 2}, Wholes{5, 8, 7}, 99) == Wholes{5, 0, 0});
    CHECK(find_least_energies(roads.reverse, Ids{2}, Wholes{-1, 30, 7}, 99) == Wholes{30, 7, 0});
}

}  // namespace
}  // namespace rightofway
