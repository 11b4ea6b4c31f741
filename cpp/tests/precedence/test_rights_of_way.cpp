#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "precedence/rights_of_way.hpp"

namespace rightofway {
namespace {

using Pairs = std::vector<std::pair<VisitId, VisitId>>;

Pairs listed(const RightsOfWay& rights) {
    Pairs pairs;
    for (const RightOfWay& right : rights.list()) {
        pairs.emplace_back(right.first, right.second);
    }
    return pairs;
}

TEST_CASE("rights of way are found from either of their visits") {
    RightsOfWay rights(9);
    rights.give(1, 5);
    rights.give(1, 8);
    rights.give(4, 8);
    std::vector<VisitId> seconds;
    rights.for_each_second(1, [&](VisitId second) { seconds.push_back(second); });
    CHECK(seconds == std::vector<VisitId>{8, 5});  // the latest first
    std::vector<VisitId> firsts;
    rights.for_each_first(8, [&](VisitId first) { firsts.push_back(first); });
    CHECK(firsts == std::vector<VisitId>{4, 1});
    CHECK(rights.find(1, 8) == 1);
    CHECK(rights.find(8, 1) == none);
}

TEST_CASE("one that is taken back keeps its place in the order of giving") {
    RightsOfWay rights(9);
    const std::int32_t first = rights.give(1, 5);
    rights.give(1, 8);
    rights.take_back(first);
    CHECK(listed(rights) == Pairs{{1, 8}});
    rights.give(4, 8);
    rights.forget_latest();
    rights.restore(first);
    CHECK(listed(rights) == Pairs{{1, 5}, {1, 8}});
}

}  // namespace
}  // namespace rightofway
