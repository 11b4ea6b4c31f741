#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "distances/congestion.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

using Path = std::vector<VertexId>;

// A ring of four: 0 1 2 3, each edge both ways, one tick each, and a robot.
struct Ring {
    test::Fleet fleet{test::Roads(4, {{0, 1}, {0, 3}, {1, 2}, {2, 3}}), {{0, {{2}}}}};
    Problem problem = fleet.problem();
    std::vector<std::int32_t> to_2{2, 1, 0, 1};

    Congestion traffic(const std::vector<std::int64_t>& station, std::int64_t shares = 16) const {
        return Congestion(problem, shares, station);
    }
};

TEST_CASE("of two ways round, the one by the first edge is taken, or the one that is clear") {
    const Ring ring;
    Congestion free = ring.traffic({0, 0, 0, 0});
    CHECK(free.path(0, 0, 2, ring.to_2) == Path{0, 1, 2});
    Congestion blocked = ring.traffic({0, 16, 0, 0});
    CHECK(blocked.path(0, 0, 2, ring.to_2) == Path{0, 3, 2});
}

TEST_CASE("who is oncoming is kept clear of, who goes the same way is not") {
    const Ring ring;
    Congestion traffic = ring.traffic({0, 0, 0, 0});
    traffic.add(Path{0, 1, 2}, 4);
    CHECK(traffic.path(0, 0, 2, ring.to_2) == Path{0, 1, 2});
    traffic.add(Path{2, 1, 0}, 4);
    CHECK(traffic.path(0, 0, 2, ring.to_2) == Path{0, 3, 2});
}

TEST_CASE("the target may be a station, and a path of one vertex is one") {
    const Ring ring;
    Congestion traffic = ring.traffic({16, 16, 16, 16});
    CHECK(traffic.path(0, 1, 2, ring.to_2) == Path{1, 2});
    CHECK(traffic.path(0, 2, 2, ring.to_2) == Path{2});
}

TEST_CASE("what does not fit together is refused") {
    const Ring ring;
    CHECK_THROWS_WITH(ring.traffic({0, 0}), "station: its length is 2, but must be 4");
    CHECK_THROWS_WITH(ring.traffic({0, -1, 0, 0}), "station[1]: -1 is negative");
    CHECK_THROWS_WITH(ring.traffic({0, 0, 0, 0}, 0), "shares: 0 is not above 0");
    Congestion traffic = ring.traffic({0, 0, 0, 0});
    CHECK_THROWS_WITH(traffic.add(Path{0, 1}, -1), "oncoming: -1 is negative");
}

TEST_CASE("a table that hides the target, and costs beyond all numbers, are refused") {
    const Ring ring;
    Congestion traffic = ring.traffic({0, 0, 0, 0});
    CHECK_THROWS_AS(traffic.path(0, 0, 2, std::vector<std::int32_t>{2, 1, -1, 1}),
                    std::invalid_argument);
    CHECK(traffic.path(0, 0, 2, ring.to_2) == Path{0, 1, 2});  // a refusal leaves no trace
    Congestion costly = ring.traffic({0, 0, 0, 0}, std::int64_t{1} << 40);
    CHECK(costly.path(0, 0, 2, ring.to_2) == Path{0, 1, 2});
    CHECK_THROWS_WITH(ring.traffic({0, 0, 0, 0}, (std::int64_t{1} << 40) + 1),
                      "shares: 1099511627777 is not in 1..1099511627776");
}

TEST_CASE("a long search can be interrupted, and the next one is not disturbed") {
    const test::Fleet fleet{test::corridor(600), {{0, {{599}}}}};
    const Problem problem = fleet.problem();
    const std::vector<std::int64_t> station(600, 0);
    std::vector<std::int32_t> to_go(600);
    for (VertexId v = 0; v < 600; ++v) {
        to_go[index(v)] = 599 - v;
    }
    Congestion traffic(problem, 16, station);
    CHECK_THROWS_AS(traffic.path(0, 0, 599, to_go, test::interrupted), std::runtime_error);
    CHECK(traffic.path(0, 0, 599, to_go).size() == 600);
}

}  // namespace
}  // namespace rightofway
