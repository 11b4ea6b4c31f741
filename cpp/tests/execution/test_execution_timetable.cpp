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
    VisitWorkArrays works = {};

    ActionDependencyGraph plan() const {
        std::vector<std::int32_t> first_right{0};
        std::vector<VisitId> rights;
        for (const VisitId visit : before) {
            rights.insert(rights.end(), visit != none, visit);
            first_right.push_back(static_cast<std::int32_t>(rights.size()));
        }
        return ActionDependencyGraph({first_visit,
                                      vertex,
                                      planned,
                                      dwell,
                                      drive,
                                      first_right,
                                      rights,
                                      headway,
                                      books_ahead,
                                      since,
                                      {},
                                      {},
                                      works});
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

// The works of `following`: robot 0 works for 2 ticks at 1, robot 1 for 1 tick at 4, its last
// vertex, from tick 9 on; `before` says what they wait for.
struct Works {
    std::vector<std::int32_t> first_work{0, 0, 1, 1, 1, 1, 2};
    Ticks ticks{2, 1};
    Ticks earliest{0, 9};
    Ticks planned{1, 9};
    std::vector<std::int32_t> first_before{0, 0, 1};
    std::vector<WorkId> before{0};
    std::vector<std::int32_t> ends{0, 0};

    VisitWorkArrays arrays() const {
        return {first_work, ticks, earliest, planned, first_before, before, ends};
    }
};

Late working(const Works& works) {
    Late late = following();
    late.dwell = {0, 2, 0, 0, 0, 3};  // robot 1 turns for 2 ticks after its work
    late.planned = {0, 1, 4, 0, 4, 5};
    late.works = works.arrays();
    return late;
}

TEST_CASE("works begin no sooner than their time, and after works of others have ended") {
    Works works;
    const Late late = working(works);
    DelaySample sample = late.sample();
    ActualTimes times = in_order(late, sample);
    CHECK(times.begin == Ticks{1, 9});
    CHECK(times.end == Ticks{3, 10});
    CHECK(times.completion == Ticks{4, 12});
    sample.dwell[1] = 12;  // the first work ends at 13, and robot 1 may go on at 14
    times = in_order(late, sample);
    CHECK(times.begin == Ticks{1, 15});
    sample = late.sample();
    sample.drive[2] = 1;
    works.before = {0};
    works.first_before = {0, 0, 1};
    works.earliest = {20, 0};  // robot 0 waits at 1 for its time
    times = in_order(working(works), sample);
    CHECK(times.begin == Ticks{20, 24});
    CHECK(times.enter == Ticks{0, 1, 23, 0, 23, 24});
}

TEST_CASE("a visit that takes longer lengthens its works and its turn alike") {
    const Works works;
    const Late late = working(works);
    DelaySample sample = late.sample();
    sample.dwell[5] = 6;
    const ActualTimes times = in_order(late, sample);
    CHECK(times.end[1] - times.begin[1] == 2);
    CHECK(times.completion[1] == 15);
}

TEST_CASE("robots whose works wait for each other deadlock, and no others") {
    Works works;
    works.first_before = {0, 1, 2};
    works.before = {1, 0};
    const ActionDependencyGraph plan = working(works).plan();
    const ExecutionTimetable timetable(plan);
    // The second robot waits for the first to leave vertex 1, which works there for ever.
    CHECK(std::vector<RobotId>(timetable.deadlocked().begin(), timetable.deadlocked().end()) ==
          std::vector<RobotId>{0, 1});
    works.before = {1};
    works.first_before = {0, 1, 1};  // the work at the end alone is before the first one
    const ActionDependencyGraph other = working(works).plan();
    CHECK(ExecutionTimetable(other).deadlocked().size() == 2);
}

TEST_CASE("a robot may complete with its last work, and others are late because of it") {
    Works works;
    works.ends = {0, 1};
    const Late late = working(works);
    const ActionDependencyGraph plan = late.plan();
    CHECK(plan.planned_completion(0) == 4);
    CHECK(plan.planned_completion(1) == 10);
    DelaySample sample = late.sample();
    sample.dwell[1] = 12;
    ActualTimes times;
    ExecutionTimetable(plan).by_right_of_way(sample, times);
    CHECK(times.completion == Ticks{14, 16});
    LatenessSources sources(plan);
    sources.add(times);
    CHECK(sources.own() == Ticks{0, 10, 0, 0, 0, 0});
    CHECK(sources.of_others() == Ticks{0, 6, 0, 0, 0, 0});
}

TEST_CASE("works that do not fit their visits are refused") {
    Works works;
    works.ticks = {3, 1};
    CHECK_THROWS_WITH(working(works).plan(), "ticks[0]: 3 is more than is left of its visit");
    works = {};
    works.before = {2};
    CHECK_THROWS_AS(working(works).plan(), std::invalid_argument);
}

TEST_CASE("by the clock works begin when planned or later") {
    const Works works;
    const Late late = working(works);
    const ActionDependencyGraph plan = late.plan();
    DelaySample sample = late.sample();
    sample.dwell[1] = 12;
    ActualTimes times;
    by_clock(plan, sample, times);
    CHECK(times.begin == Ticks{1, 9});
    CHECK(times.end == Ticks{13, 10});
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
