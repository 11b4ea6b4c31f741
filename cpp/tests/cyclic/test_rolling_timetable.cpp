#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "cyclic/rolling_timetable.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

constexpr RobotId n_robots = 6;
constexpr std::int32_t n_shown = 40;

// Robots on random laps through few vertices.
struct Problem {
    std::mt19937 draw;
    std::vector<std::int32_t> first_place{0};
    std::vector<VertexId> vertex;
    Ticks least;
    Ticks approach;
    Ticks first_least;

    explicit Problem(unsigned seed) : draw(seed) {
        for (RobotId r = 0; r < n_robots; ++r) {
            std::vector<VertexId> lap(12);
            for (VertexId v = 0; v < 12; ++v) {
                lap[index(v)] = v;
            }
            std::shuffle(lap.begin(), lap.end(), draw);
            lap.resize(3 + draw() % 6);
            for (const VertexId v : lap) {
                vertex.push_back(v);
                least.push_back(1 + draw() % 4);
                approach.push_back(draw() % 2);
            }
            first_least.push_back(1 + draw() % 4);
            first_place.push_back(static_cast<std::int32_t>(vertex.size()));
        }
    }

    LapArrays arrays() const { return {first_place, vertex, least, approach, first_least, 1}; }

    CyclicVisit visit() {
        return {static_cast<RobotId>(draw() % n_robots),
                static_cast<std::int32_t>(draw() % n_shown)};
    }
};

// Least times by brute force; empty if there are none.
std::vector<Ticks> slow_times(const CyclicRoutes& routes, const std::vector<CyclicRight>& rights) {
    std::vector<Ticks> enter(n_robots, Ticks(n_shown + 1, 0));
    for (int round = 0; round < n_robots * (n_shown + 1); ++round) {
        bool has_changed = false;
        const auto raise = [&](CyclicVisit visit, Tick tick) {
            Tick& own = enter[index(visit.robot)][index(visit.number)];
            has_changed |= own < tick;
            own = std::max(own, tick);
        };
        for (RobotId r = 0; r < n_robots; ++r) {
            for (std::int32_t k = 0; k < n_shown; ++k) {
                raise({r, k + 1}, enter[index(r)][index(k)] + routes.least({r, k}));
            }
        }
        for (const auto& [first, second] : rights) {
            raise(second,
                  enter[index(first.robot)][index(first.number + 1)] + routes.gap_before(second));
        }
        if (!has_changed) {
            return enter;
        }
    }
    return {};
}

std::vector<Ticks> times(const RollingTimetable& timetable) {
    std::vector<Ticks> enter(n_robots);
    for (RobotId r = 0; r < n_robots; ++r) {
        for (std::int32_t k = 0; k <= n_shown; ++k) {
            enter[index(r)].push_back(timetable.enter({r, k}));
        }
    }
    return enter;
}

TEST_CASE("times are the least ones, however rights of way are given, taken back, found anew") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Problem fleet(seed);
        const CyclicRoutes routes{fleet.arrays()};
        RollingTimetable timetable{routes};
        for (RobotId r = 0; r < n_robots; ++r) {
            timetable.set_end(r, n_shown);
        }
        std::vector<CyclicRight> given;
        for (int attempt = 0; attempt < 2000; ++attempt) {
            const CyclicRight right{fleet.visit(), fleet.visit()};
            if (right.first.robot == right.second.robot || right.second.number == 0 ||
                routes.vertex(right.first) != routes.vertex(right.second)) {
                continue;
            }
            const auto mark = timetable.mark();
            const auto before = times(timetable);
            given.push_back(right);
            const auto expected = slow_times(routes, given);
            REQUIRE(timetable.precede(right.first, right.second, attempt) == !expected.empty());
            if (expected.empty() || fleet.draw() % 4 == 0) {
                timetable.rollback(mark);
                given.pop_back();
                REQUIRE(times(timetable) == before);
                continue;
            }
            REQUIRE(times(timetable) == expected);
        }
        REQUIRE(given.size() > 10);
        const auto expected = times(timetable);
        std::shuffle(given.begin(), given.end(), fleet.draw);
        timetable.recompute(given);
        CHECK(times(timetable) == expected);
        timetable.remove(given.back(), -1);  // somebody else's
        timetable.recompute(given);
        CHECK(times(timetable) == expected);
    }
}

TEST_CASE("what is frozen is not delayed, and the view moves on without losing a right of way") {
    Problem fleet(1);
    const CyclicRoutes routes{fleet.arrays()};
    RollingTimetable timetable{routes};
    for (RobotId r = 0; r < n_robots; ++r) {
        timetable.set_end(r, n_shown);
        timetable.freeze(r, 20);
    }
    timetable.start_window(18, 20);
    const auto expected = times(timetable);
    for (RobotId r = 0; r < n_robots; ++r) {
        timetable.set_end(r, 2 * n_shown);
        CHECK(timetable.enter({r, timetable.start(r)}) <= 18);
        CHECK(timetable.enter({r, timetable.start(r) + 1}) > 18);
        const CyclicVisit last{r, timetable.frozen(r) - 1};
        CHECK(timetable.enter(last) <= 20);
        CHECK(timetable.enter(last.next()) > 20);
        CHECK(!timetable.precede({(r + 1) % n_robots, n_shown}, last, 0));
        CHECK(timetable.enter({r, n_shown}) == expected[index(r)].back());
    }
}

}  // namespace
}  // namespace rightofway
