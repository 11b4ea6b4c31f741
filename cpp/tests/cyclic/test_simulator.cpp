#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cyclic/simulator.hpp"
#include "drawn_lanes.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

const auto no_deadline = [] { return false; };

// Robots that go somewhere and back, again and again: a tick for each vertex, turning one more.
struct Laps {
    std::vector<std::int32_t> first_place{0};
    std::vector<VertexId> vertex;
    Ticks least;
    Ticks first_least;

    explicit Laps(const std::vector<std::vector<VertexId>>& ways, const Ticks& speeds) {
        for (std::size_t r = 0; r < ways.size(); ++r) {
            std::vector<VertexId> way = ways[r];
            for (std::size_t k = way.size() - 1; k-- > 1;) {
                way.push_back(way[k]);
            }
            for (std::size_t k = 0; k < way.size(); ++k) {
                const bool turns = k == 0 || k == ways[r].size() - 1;
                least.push_back(turns ? 2 * speeds[r] : speeds[r]);
            }
            first_least.push_back(speeds[r]);
            vertex.insert(vertex.end(), way.begin(), way.end());
            first_place.push_back(static_cast<std::int32_t>(vertex.size()));
        }
    }

    LapArrays arrays(const Ticks& approach) const {
        return {first_place, vertex, least, approach, first_least, 0};
    }
};

Ticks times(const CyclicSimulator& run, RobotId robot, std::int32_t n_visits) {
    Ticks enters;
    for (std::int32_t k = 0; k < n_visits; ++k) {
        enters.push_back(run.visit_times().enter({robot, k}));
    }
    return enters;
}

// The paper's first two doors: homes 0 and 2, stops 6 and 8, and one vertex between, 4.
const std::vector<std::vector<VertexId>> door{{0, 1, 4, 7, 6}, {2, 1, 4, 7, 8}};

TEST_CASE("at a door one robot waits once and both repeat their laps from then on") {
    const Laps laps{door, {1, 1}};
    const Ticks approach(laps.vertex.size(), 0);
    CyclicSimulator run(laps.arrays(approach), {0, 10, 40, 80, 1, 32}, CyclicRule::first_come);
    REQUIRE(run.advance(no_deadline) == CyclicSimulator::End::repeats);
    CHECK((run.cut() - run.first_seen()) % 10 == 0);
    CHECK(times(run, 0, 9) == Ticks{0, 1, 2, 3, 4, 6, 7, 8, 9});
    CHECK(times(run, 1, 9) == Ticks{0, 2, 3, 4, 5, 7, 8, 9, 10});
}

TEST_CASE("in a fixed order a slower robot may wait at the door for ever") {
    const Laps laps{door, {2, 3}};
    const Ticks approach(laps.vertex.size(), 0);
    CyclicSimulator run(laps.arrays(approach), {0, 20, 120, 240, 1, 32}, CyclicRule::fixed_order);
    REQUIRE(run.advance(no_deadline) == CyclicSimulator::End::repeats);
    CHECK(run.visit_times().n_started(1) < 8);
    CHECK(run.visit_times().n_started(0) > 8);
}

TEST_CASE("robots that live in each other's corridor are deadlocked, whoever waits") {
    const Laps laps{{{0, 1, 2, 3}, {3, 2, 1, 0}}, {1, 1}};
    const Ticks approach(laps.vertex.size(), 0);
    CyclicSimulator run(laps.arrays(approach), {0, 8, 32, 64, 1, 32}, CyclicRule::first_come);
    REQUIRE(run.advance(no_deadline) == CyclicSimulator::End::deadlock);
    CHECK(run.deadlock().robot_a == 0);
    CHECK(run.deadlock().robot_b == 1);
}

TEST_CASE("robots with sizes take turns where their lanes cross") {
    const std::vector<std::int32_t> first_place{0, 2, 4};
    const std::vector<VertexId> vertex{0, 1, 2, 3};
    const std::vector<std::int32_t> edge_row{4, 5, 6, 7};
    const RowFinder finder = test::crossing_lanes().finder();
    const Ticks least{4, 5, 4, 4};  // the first robot works at B for a tick
    const Ticks approach{4, 4, 4, 4};
    const Ticks first_least{4, 4};
    const LapArrays laps{first_place, vertex, least,    approach, first_least,
                         0,           vertex, edge_row, {&finder}};
    CyclicSimulator run(laps, {0, 9, 36, 72, 5, 32}, CyclicRule::first_come);
    REQUIRE(run.advance(no_deadline) == CyclicSimulator::End::repeats);
    CHECK(times(run, 0, 4) == Ticks{0, 4, 12, 16});
    CHECK(times(run, 1, 3) == Ticks{0, 8, 20});
}

TEST_CASE("a simulation that was stopped advances as if it had not been") {
    const Laps laps{door, {2, 3}};
    const Ticks approach(laps.vertex.size(), 0);
    const Horizon pace{0, 20, 120, 240, 1, 32};
    CyclicSimulator whole(laps.arrays(approach), pace, CyclicRule::first_come);
    CyclicSimulator parts(laps.arrays(approach), pace, CyclicRule::first_come);
    REQUIRE(whole.advance(no_deadline) == CyclicSimulator::End::repeats);
    int asked = 0;
    const auto now_and_then = [&asked] { return ++asked % 2 == 0; };
    int stopped = 0;
    while (parts.advance(now_and_then) == CyclicSimulator::End::open) {
        ++stopped;
    }
    CHECK(stopped > 0);
    CHECK(parts.cut() == whole.cut());
    CHECK(parts.first_seen() == whole.first_seen());
}

// From one cell of a square floor to another, along the row and then along the column.
std::vector<VertexId> way_of(int from, int to, int size) {
    std::vector<VertexId> way{from};
    while (way.back() != to) {
        const int here = way.back();
        const int right = to % size - here % size;
        const int step = right != 0 ? (right > 0 ? 1 : -1) : (to > here ? size : -size);
        way.push_back(here + step);
    }
    return way;
}

TEST_CASE("on crowded floors no two robots are ever at one place, however a run ends") {
    constexpr int size = 9;
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 draw(seed);
        std::vector<int> cells(size * size);
        std::iota(cells.begin(), cells.end(), 0);
        std::shuffle(cells.begin(), cells.end(), draw);
        std::vector<std::vector<VertexId>> ways;
        Ticks speeds;
        for (int r = 0; r < 10; ++r) {
            ways.push_back(way_of(cells[index(2 * r)], cells[index(2 * r + 1)], size));
            speeds.push_back(1 + static_cast<Tick>(draw() % 3));
        }
        const Laps laps{ways, speeds};
        const Ticks approach(laps.vertex.size(), 0);
        CyclicSimulator run(laps.arrays(approach), {0, 40, 400, 800, 1, 32},
                            CyclicRule::first_come);
        int asked = 0;
        run.advance([&asked] { return ++asked > 200; });
        std::map<VertexId, std::vector<std::pair<Tick, Tick>>> at;
        for (RobotId r = 0; r < run.n_robots(); ++r) {
            for (std::int32_t k = 0; k + 1 < run.visit_times().n_started(r); ++k) {
                const auto length = laps.first_place[index(r + 1)] - laps.first_place[index(r)];
                at[laps.vertex[index(laps.first_place[index(r)] + k % length)]].emplace_back(
                    run.visit_times().enter({r, k}), run.visit_times().enter({r, k + 1}));
            }
        }
        for (auto& [vertex, visits] : at) {
            std::sort(visits.begin(), visits.end());
            for (std::size_t k = 1; k < visits.size(); ++k) {
                REQUIRE(visits[k - 1].second <= visits[k].first);
            }
        }
    }
}

TEST_CASE("laps that lead nowhere are refused") {
    const std::vector<std::int32_t> first_place{0, 1};
    const std::vector<VertexId> vertex{0};
    const Ticks ticks{1};
    const LapArrays arrays{first_place, vertex, ticks, ticks, ticks, 0};
    CHECK_THROWS_WITH(CyclicRoutes{arrays},
                      "first_place[1]: 1 is not 2 above the entry before it (a lap leads away "
                      "and back)");
}

TEST_CASE("a horizon that leads nowhere is refused") {
    const Laps laps{door, {1, 1}};
    const Ticks approach(laps.vertex.size(), 0);
    const auto with = [&](const Horizon& horizon) {
        const CyclicSimulator made(laps.arrays(approach), horizon, CyclicRule::first_come);
    };
    CHECK_NOTHROW(with({0, 10, 40, 80, 10, 1}));
    CHECK_THROWS_WITH(with({2, 10, 40, 80, 10, 1}), "pacemaker: 2 is not in 0..1");
    CHECK_THROWS_AS(with({0, 0, 40, 80, 10, 1}), std::invalid_argument);
    CHECK_THROWS_AS(with({0, 10, -1, 80, 10, 1}), std::invalid_argument);
    CHECK_THROWS_AS(with({0, 10, 40, -1, 10, 1}), std::invalid_argument);
    CHECK_THROWS_AS(with({0, 10, 40, 80, -1, 1}), std::invalid_argument);
    CHECK_THROWS_WITH(with({0, 10, 40, 80, 10, 0}), "memory: 0 is not above 0");
}

TEST_CASE("a lag of more visits than a window can hold is refused, not tried") {
    const Laps laps{door, {1, 1}};  // ten ticks and eight visits a lap
    const Ticks approach(laps.vertex.size(), 0);
    CyclicSimulator run(laps.arrays(approach), {0, Tick{1} << 40, Tick{1} << 40, 80, 10, 1},
                        CyclicRule::first_come);
    CHECK_THROWS_AS(run.advance(no_deadline), std::overflow_error);
}

TEST_CASE("ids of vertices may be as large as they like") {
    Laps near{door, {1, 1}};
    Laps far = near;
    for (VertexId& vertex : far.vertex) {
        vertex += std::numeric_limits<VertexId>::max() - 8;
    }
    const Ticks approach(near.vertex.size(), 0);
    const Horizon horizon{0, 10, 40, 80, 10, 8};
    CyclicSimulator one(near.arrays(approach), horizon, CyclicRule::first_come);
    CyclicSimulator other(far.arrays(approach), horizon, CyclicRule::first_come);
    CHECK(one.advance(no_deadline) == other.advance(no_deadline));
    CHECK(times(one, 1, 9) == times(other, 1, 9));
}

}  // namespace
}  // namespace rightofway
