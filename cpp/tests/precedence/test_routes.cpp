#include "example.hpp"
#include "precedence/routes.hpp"

namespace rightofway::test {
namespace {

TEST_CASE("visits are numbered robot by robot") {
    const Routes routes = Example({{7, 8, 9}, {5}, {8, 7}}).routes();
    CHECK(routes.n_robots() == 3);
    CHECK(routes.n_visits() == 6);
    CHECK(routes.first_of(2) == 4);
    CHECK(routes.last_of(2) == 5);
    CHECK(routes.robot(3) == 1);
    CHECK(routes.vertex(4) == 8);
    CHECK(routes.is_first(3));
    CHECK(routes.is_last(3));
    CHECK_FALSE(routes.is_last(1));
}

TEST_CASE("a later visit keeps headway and its own approach from the one before") {
    Example example({{0, 1, 2}});
    example.headway = 3;
    example.approach = {0, 4, 2};
    CHECK(example.routes().gap_before(1) == 7);
    CHECK(example.routes().longest_approach(0) == 4);
}

TEST_CASE("only moves without any gap may be half of a swap") {
    Example example({{0, 1, 2}});
    example.approach = {0, 0, 1};
    CHECK_FALSE(example.routes().may_swap(0));  // nobody moves into a first visit
    CHECK(example.routes().may_swap(1));
    CHECK_FALSE(example.routes().may_swap(2));
    example.headway = 1;
    CHECK_FALSE(example.routes().may_swap(1));
    example.headway = 0;
    example.swaps_conflict = false;
    CHECK_FALSE(example.routes().may_swap(1));
}

TEST_CASE("the least time of a last visit is never looked at") {
    Example example({{0, 1}});
    example.least = {1, -5};
    CHECK_NOTHROW(example.routes());
}

TEST_CASE("no robots at all are routes too") {
    const Routes routes = Example({}).routes();
    CHECK(routes.n_robots() == 0);
    CHECK(routes.n_visits() == 0);
}

TEST_CASE("robots without visits and visits without robots are refused") {
    Example example({{0, 1}, {2}});
    example.first_visit = {};
    CHECK_THROWS_WITH(example.routes(), "first_visit: its length is 0, but must be at least 1");
    example.first_visit = {1, 2, 3};
    CHECK_THROWS_WITH(example.routes(), "first_visit[0]: 1 must be 0");
    example.first_visit = {0, 3, 3};
    CHECK_THROWS_WITH(example.routes(),
                      "first_visit[2]: 3 is not above the entry before it "
                      "(every robot has a visit)");
    example.first_visit = {0, 2, 4};
    CHECK_THROWS_WITH(example.routes(), "first_visit[2]: 4 is not the number of visits, 3");
}

TEST_CASE("arrays of the wrong length are refused") {
    Example least({{0, 1}});
    least.least = {1};
    CHECK_THROWS_WITH(least.routes(), "least: its length is 1, but must be 2");
    Example approach({{0, 1}});
    approach.approach = {0, 0, 0};
    CHECK_THROWS_WITH(approach.routes(), "approach: its length is 3, but must be 2");
    Example active({{0, 1}});
    active.active = {};
    CHECK_THROWS_WITH(active.routes(), "active: its length is 0, but must be 1");
}

TEST_CASE("an entry that cannot be is refused with its index and value") {
    CHECK_THROWS_WITH(Example({{0, -4}}).routes(), "vertex[1]: -4 is negative");
    CHECK_THROWS_WITH(Example({{0}, {3, 3}}).routes(),
                      "vertex[2]: 3 is the vertex of the visit before it (make them one visit)");
    Example example({{0, 1, 2}});
    example.least = {1, 0, 1};
    CHECK_THROWS_WITH(example.routes(), "least[1]: 0 is not positive");
    example.least = {1, 1, 1};
    example.approach = {0, -1, 0};
    CHECK_THROWS_WITH(example.routes(), "approach[1]: -1 is negative");
    example.approach = {2, 0, 0};
    CHECK_THROWS_WITH(example.routes(), "approach[0]: 2 must be 0 on a first visit");
    example.approach = {0, 0, 0};
    example.headway = -1;
    CHECK_THROWS_WITH(example.routes(), "headway: -1 is not in 0..1152921504606846976");
}

TEST_CASE("durations that could overflow a time are refused") {
    Example example({{0, 1, 2}});
    example.least = {Tick{1} << 59, Tick{1} << 59, 0};
    CHECK_NOTHROW(example.routes());
    example.headway = 1;
    CHECK_THROWS_WITH(example.routes(),
                      "least[1]: 576460752303423488 and the durations before it add up beyond "
                      "2^60 (use a larger tick)");
}

}  // namespace
}  // namespace rightofway::test
