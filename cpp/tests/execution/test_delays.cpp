#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "execution/delays.hpp"

namespace rightofway {
namespace {

// One robot with a visit of 100 ticks and a drive of 100.
ActionDependencyGraph long_way() {
    static const std::vector<VisitId> first{0, 2};
    static const std::vector<VertexId> vertex{0, 1};
    static const std::vector<Tick> planned{0, 200};
    static const std::vector<Tick> dwell{100, 0};
    static const std::vector<Tick> drive{0, 100};
    static const std::vector<std::int32_t> first_right{0, 0, 0};
    return ActionDependencyGraph({first, vertex, planned, dwell, drive, first_right, {}, 0, false});
}

double mean_of_dwell(const Delays& delays) {
    DelaySample out;
    double sum = 0;
    for (std::uint64_t run = 0; run < 4000; ++run) {
        delays.draw(5, run, out);
        sum += static_cast<double>(out.dwell[0]);
    }
    return sum / 4000;
}

TEST_CASE("delays have the mean that was asked for") {
    const ActionDependencyGraph plan = long_way();
    const std::vector<double> pace{1};
    const auto mean = [&](DelayKind kind, double a, double b) {
        return mean_of_dwell(Delays(plan, pace, {{kind, a, b}}, {0, 0}, {}));
    };
    CHECK(mean(DelayKind::exponential, 0.2, 0) == doctest::Approx(120).epsilon(0.02));
    CHECK(mean(DelayKind::uniform, 0, 0.5) == doctest::Approx(125).epsilon(0.02));
    CHECK(mean(DelayKind::normal, 0.1, 0.05) == doctest::Approx(110).epsilon(0.02));
    CHECK(mean(DelayKind::stops, 0.1, 50) == doctest::Approx(105).epsilon(0.02));
}

TEST_CASE("a run depends on its number and the seed alone") {
    const ActionDependencyGraph plan = long_way();
    const std::vector<double> pace{1};
    const Delays delays(plan, pace, {{DelayKind::exponential, 0.2, 0}}, {0, 0}, {});
    DelaySample one;
    DelaySample other;
    delays.draw(1, 7, one);
    delays.draw(1, 8, other);
    delays.draw(1, 7, other);
    CHECK(one.dwell == other.dwell);
    CHECK(one.drive == other.drive);
}

TEST_CASE("what befalls a robot does not depend on what others do") {
    const std::vector<VertexId> vertex{0, 1, 2, 3};
    const std::vector<Tick> planned{0, 200, 0, 200};
    const std::vector<Tick> drive{0, 100, 0, 100};
    const std::vector<std::int32_t> first_right(5, 0);
    const std::vector<double> pace{1, 1};
    const auto second = [&](const std::vector<VisitId>& first_visit) {
        const std::vector<Tick> dwell(4, 100);
        const ActionDependencyGraph plan(
            {first_visit, vertex, planned, dwell, drive, first_right, {}, 0, false});
        DelaySample out;
        Delays(plan, pace, {{DelayKind::exponential, 0.2, 0}}, {0, 0, 0}, {}).draw(1, 7, out);
        return out.dwell[index(first_visit[1])];
    };
    CHECK(second({0, 2, 4}) == second({0, 3, 4}));
    CHECK(second({0, 2, 4}) == second({0, 1, 4}));
}

TEST_CASE("parts of a tick are carried, not lost") {
    const std::vector<VisitId> first{0, 3};
    const std::vector<VertexId> vertex{0, 1, 2};
    const std::vector<Tick> planned{0, 1, 2};
    const std::vector<Tick> dwell{0, 0, 0};
    const std::vector<Tick> drive{0, 1, 1};
    const std::vector<std::int32_t> first_right(4, 0);
    const ActionDependencyGraph plan(
        {first, vertex, planned, dwell, drive, first_right, {}, 0, false});
    const std::vector<double> pace{1.5};
    const Delays delays(plan, pace, {}, {0, 0}, {});
    DelaySample out;
    for (std::uint64_t run = 0; run < 20; ++run) {
        delays.draw(0, run, out);
        CHECK(out.drive[1] + out.drive[2] == 3);
    }
}

TEST_CASE("who is done where it ends stops no more") {
    const ActionDependencyGraph plan = long_way();
    const std::vector<double> pace{1};
    const Delays delays(plan, pace, {{DelayKind::stops, 1, 50}}, {0, 0}, {});
    DelaySample out;
    delays.draw(0, 0, out);
    CHECK(out.dwell == std::vector<Tick>{150, 0});
}

TEST_CASE("stoppages that overlap are one") {
    const ActionDependencyGraph plan = long_way();
    const std::vector<double> pace{1};
    const Delays delays(plan, pace, {}, {0, 3}, {{2, 10}, {5, 20}, {40, never}});
    DelaySample out;
    delays.draw(0, 0, out);
    CHECK(out.stoppages.size() == 2);
    CHECK(out.stoppages[0].ticks == 23);
    CHECK(out.first_stoppage == std::vector<std::int32_t>{0, 2});
}

TEST_CASE("delays that are no numbers, and stoppages out of order, are refused") {
    const ActionDependencyGraph plan = long_way();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto make = [&](double pace, const Delay& delay, std::vector<Stoppage> stoppages) {
        const auto n = static_cast<std::int32_t>(stoppages.size());
        const std::vector<double> paces{pace};
        return Delays(plan, paces, {delay}, {0, n}, std::move(stoppages));
    };
    const Delay fine{DelayKind::uniform, 0, 0.5};
    CHECK_NOTHROW(make(1, fine, {{3, 2}, {3, never}}));
    CHECK_THROWS_WITH(make(nan, fine, {}), "pace[0]: nan is not in 0..1e+06");
    CHECK_THROWS_WITH(make(-1, fine, {}), "pace[0]: -1 is not in 0..1e+06");
    CHECK_THROWS_WITH(make(1, {DelayKind::stops, 0.1, -3}, {}),
                      "delay_b[0]: -3 is not in 0..1.09951e+12");
    CHECK_THROWS_WITH(make(1, {DelayKind::breaks, 1.5, 0}, {}), "delay_a[0]: 1.5 is not in 0..1");
    CHECK_THROWS_WITH(make(1, fine, {{3, 2}, {2, 2}}),
                      "stoppage_tick[1]: 2 is before the stoppage before it");
    CHECK_THROWS_WITH(make(1, fine, {{3, -1}}),
                      "stoppage_ticks[0]: -1 is not in 0..4611686018427387904");
}

TEST_CASE("lists of visits that do not rise are refused before any visit is numbered") {
    const std::vector<VisitId> first{0, 100, 2};
    const std::vector<VertexId> vertex{0, 1};
    const std::vector<Tick> ticks{0, 0};
    const std::vector<std::int32_t> first_right(3, 0);
    const AdgArrays arrays{first, vertex, ticks, ticks, ticks, first_right, {}, 0, false};
    CHECK_THROWS_WITH(ActionDependencyGraph{arrays},
                      "first_visit[2]: 2 is not at least 1 above the entry before it");
}

}  // namespace
}  // namespace rightofway
