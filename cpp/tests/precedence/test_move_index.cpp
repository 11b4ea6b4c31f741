#include <utility>

#include "example.hpp"
#include "precedence/move_index.hpp"

namespace rightofway::test {
namespace {

using Swap = std::pair<VisitId, Tick>;

std::vector<Swap> swaps(const MoveIndex& index, VisitId visit) {
    std::vector<Swap> found;
    index.for_each_swap(visit, [&](const MoveIndex::Slot& other, Tick tick, Tick weight) {
        CHECK(weight == 1);
        found.emplace_back(other.visit, tick);
    });
    return found;
}

TEST_CASE("opposite moves at one instant are a swap, seen from both sides") {
    const Routes routes = Example({{1, 2}, {2, 1}}).routes();  // moves 1 and 3
    MoveIndex index(routes);
    index.set(1, 5);
    index.set(3, 5);
    CHECK(swaps(index, 1) == std::vector<Swap>{{3, 5}});
    CHECK(swaps(index, 3) == std::vector<Swap>{{1, 5}});
}

TEST_CASE("opposite moves at different instants are no swap") {
    const Routes routes = Example({{1, 2}, {2, 1}}).routes();
    MoveIndex index(routes);
    index.set(1, 5);
    index.set(3, 6);
    CHECK(swaps(index, 1).empty());
}

TEST_CASE("moves in the same direction or from elsewhere are no swap") {
    const Routes routes = Example({{1, 2}, {1, 2}, {3, 1}, {2, 3}}).routes();
    MoveIndex index(routes);
    for (const VisitId x : {1, 3, 5, 7}) {
        index.set(x, 5);
    }
    CHECK(swaps(index, 1).empty());
}

TEST_CASE("a move that is cleared swaps with nobody, not even with another cleared one") {
    const Routes routes = Example({{1, 2}, {2, 1}}).routes();
    MoveIndex index(routes);
    CHECK(swaps(index, 1).empty());
    index.set(1, 5);
    index.set(3, 5);
    index.clear(1);
    CHECK(swaps(index, 3).empty());
}

TEST_CASE("a robot that goes to and fro does not swap with itself") {
    const Routes routes = Example({{1, 2, 1}}).routes();
    MoveIndex index(routes);
    index.set(1, 5);
    index.set(2, 5);
    CHECK(swaps(index, 1).empty());
}

TEST_CASE("where a gap is kept there are no swaps, because there are vertex conflicts instead") {
    Example example({{1, 2}, {2, 1}});
    example.approach = {0, 1, 0, 0};
    const Routes routes = example.routes();
    MoveIndex index(routes);
    index.set(1, 5);
    index.set(3, 5);
    CHECK(swaps(index, 1).empty());
    CHECK(swaps(index, 3).empty());
}

}  // namespace
}  // namespace rightofway::test
