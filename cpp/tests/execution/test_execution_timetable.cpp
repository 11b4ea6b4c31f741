#include <doctest/doctest.h>

#include "corridors.hpp"
#include "execution/executed_conflicts.hpp"
#include "execution/execution_timetable.hpp"
#include "execution/runs.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

// Visits of all robots, one robot behind the other, with what they meet.
struct Late {
    std::vector<VisitId> first_visit;
    std::vector<VertexId> vertex;
    Ticks planned;
    Ticks dwell;
    Ticks drive;
    std::vector<VisitId> before;
    Tick headway = 0;
    bool books_ahead = false;
    Ticks since = {};

    ActionDependencyGraph plan() const {
        std::vector<std::int32_t> first_right{0};
        std::vector<VisitId> rights;
        for (const VisitId visit : before) {
            rights.insert(rights.end(), visit != none, visit);
            first_right.push_back(static_cast<std::int32_t>(rights.size()));
        }
        return ActionDependencyGraph({first_visit, vertex, planned, dwell, drive, first_right,
                                      rights, headway, books_ahead, since});
    }
    DelaySample sample() const {
        return {dwell, drive, std::vector<std::int32_t>(first_visit.size(), 0), {}};
    }
};

// Robot 0 drives 0 1 2, robot 1 follows it from 3 over 1 to 4, as soon as it may.
Late following() {
    return {{0, 3, 6},          {0, 1, 2, 3, 1, 4}, {0, 1, 2, 0, 2, 3},
            {0, 0, 0, 0, 0, 0}, {0, 1, 1, 0, 1, 1}, {-1, -1, -1, -1, 1, -1}};
}

// Three robots move round a triangle at tick 1.
Late ring() {
    return {{0, 2, 4, 6},       {0, 1, 1, 2, 2, 0}, {0, 1, 0, 1, 0, 1},
            {0, 0, 0, 0, 0, 0}, {0, 1, 0, 1, 0, 1}, {-1, 2, -1, 4, -1, 0}};
}

ActualTimes in_order(const Late& late, const DelaySample& sample) {
    const ActionDependencyGraph plan = late.plan();
    ActualTimes times;
    ExecutionTimetable(plan).by_right_of_way(sample, times);
    return times;
}

TEST_CASE("without delays everything happens as planned") {
    const Late late = following();
    CHECK(in_order(late, late.sample()).enter == late.planned);
}

TEST_CASE("a visit begins no sooner than its right of way was given") {
    Late late = following();
    late.since = {0, 0, 9, 0, 0, 0};
    CHECK(in_order(late, late.sample()).enter == Ticks{0, 1, 9, 0, 9, 10});
    Late round = ring();
    round.since = {0, 0, 0, 4, 0, 0};
    CHECK(in_order(round, round.sample()).enter == Ticks{0, 4, 0, 4, 0, 4});
}

TEST_CASE("who is late makes others wait, and by the clock it is run into") {
    const Late late = following();
    DelaySample sample = late.sample();
    sample.drive[2] = 5;
    const ActualTimes times = in_order(late, sample);
    CHECK(times.enter == Ticks{0, 1, 6, 0, 6, 7});
    const ActionDependencyGraph plan = late.plan();
    ExecutedConflicts conflicts(plan);
    CHECK(conflicts.count(times).vertex == 0);
    ActualTimes clocked;
    by_clock(plan, sample, clocked);
    CHECK(clocked.enter == Ticks{0, 1, 6, 0, 2, 3});
    CHECK(conflicts.count(clocked).vertex == 1);
    CHECK(conflicts.count(clocked).first == 2);
}

TEST_CASE("who waits starts to drive when the vertex is free, where vertices are booked ahead") {
    Late late = following();
    late.headway = 2;
    late.books_ahead = true;
    const ActualTimes times = in_order(late, late.sample());
    CHECK(times.start[4] == 4);  // robot 0 left at 2
    CHECK(times.enter[4] == 5);
}

TEST_CASE("the robots of a rotation go together when the last of them is ready") {
    const Late late = ring();
    DelaySample sample = late.sample();
    sample.dwell[2] = 3;
    CHECK(in_order(late, sample).enter == Ticks{0, 4, 0, 4, 0, 4});
    const ActionDependencyGraph plan = late.plan();
    CHECK(ExecutionTimetable(plan).deadlocked().empty());
}

TEST_CASE("robots round a circle with a headway are deadlocked") {
    Late late = ring();
    late.headway = 1;
    const ActionDependencyGraph plan = late.plan();
    const ExecutionTimetable timetable(plan);
    CHECK(timetable.deadlocked().size() == 3);
    CHECK(in_order(late, late.sample()).completion == Ticks{never, never, never});
}

TEST_CASE("who stands still for ever strands those that wait for it") {
    const Late late = following();
    DelaySample sample = late.sample();
    sample.first_stoppage = {0, 1, 1};
    sample.stoppages = {{1, never}};
    const ActualTimes times = in_order(late, sample);
    CHECK(times.enter == Ticks{0, 1, never, 0, never, never});
    CHECK(times.is_broken == std::vector<std::uint8_t>{1, 0});
}

TEST_CASE("a robot that waits anyway may stand still meanwhile") {
    const Late late = following();
    DelaySample sample = late.sample();
    sample.drive[2] = 5;
    sample.first_stoppage = {0, 0, 1};
    sample.stoppages = {{2, 3}};
    CHECK(in_order(late, sample).enter == Ticks{0, 1, 6, 0, 6, 7});
    sample.stoppages = {{2, 6}};
    CHECK(in_order(late, sample).enter == Ticks{0, 1, 6, 0, 8, 9});
}

TEST_CASE("lateness is put down to the visit that it began with") {
    const Late late = following();
    DelaySample sample = late.sample();
    sample.drive[2] = 5;
    sample.drive[5] = 3;
    const ActionDependencyGraph plan = late.plan();
    LatenessSources sources(plan);
    sources.add(in_order(late, sample));
    CHECK(sources.own() == Ticks{0, 4, 0, 0, 2, 0});
    CHECK(sources.of_others() == Ticks{0, 4, 0, 0, 0, 0});
    CHECK(sources.between().at(2) == 4);
}

TEST_CASE("an exchange of two vertices is a swap") {
    const Late late{{0, 2, 4},    {0, 1, 1, 0}, {0, 1, 0, 1},
                    {0, 0, 0, 0}, {0, 1, 0, 1}, {-1, 2, -1, 0}};
    const ActionDependencyGraph plan = late.plan();
    ExecutedConflicts conflicts(plan);
    CHECK(conflicts.count(in_order(late, late.sample())).swap == 1);
}

TEST_CASE("an execution of many visits can be interrupted") {
    Late alone;
    alone.first_visit = {0, 600};
    for (VertexId v = 0; v < 600; ++v) {
        alone.vertex.push_back(v);
        alone.planned.push_back(v);
        alone.dwell.push_back(0);
        alone.drive.push_back(v > 0 ? 1 : 0);
        alone.before.push_back(none);
    }
    const ActionDependencyGraph plan = alone.plan();
    ActualTimes times;
    CHECK_THROWS_AS(
        ExecutionTimetable(plan).by_right_of_way(alone.sample(), times, test::interrupted),
        std::runtime_error);
}

}  // namespace
}  // namespace rightofway
