#include <doctest/doctest.h>

#include <vector>

#include "crossing.hpp"
#include "fleets.hpp"
#include "lns/lns.hpp"
#include "lns/window_search.hpp"

namespace rightofway {
namespace {

using test::Fleet;

using Ticks = std::vector<Tick>;

// A corridor 0 - 1 - 2 - 3 - 4 with a bay, 5, at 2. The first robot works at 4 and drives home to
// 0; the second one works for three ticks at 2, and drives back into the bay.
Fleet bay_fleet() {
    return {test::Roads(6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {2, 5}}),
            {{0, {{4}, {0}}}, {5, {{2, 3}, {5}}}}};
}

// The first robot stands at 1 until tick 7, and comes back through 2 after the other one.
TimedTrack late_track() {
    return {{{0, 0, 0},
             {1, 1, 1},
             {8, 2, 1},
             {9, 3, 1},
             {10, 4, 1},
             {11, 3, 1},
             {20, 2, 1},
             {21, 1, 1},
             {22, 0, 1}},
            0};
}

Ticks enters(const TimedTrack& track) {
    Ticks enter;
    for (const Visit& visit : track.visits) {
        enter.push_back(visit.enter);
    }
    return enter;
}

// The starts and ends of all bookings, vertex by vertex.
Ticks booked(const FleetPlan& plan) {
    Ticks ticks;
    for (std::int32_t row = 0; row < plan.bookings().n_rows(); ++row) {
        for (const BookedBy& one : plan.bookings().at(row)) {
            ticks.insert(ticks.end(), {row, one.time.start, one.time.end, one.robot});
        }
    }
    return ticks;
}

void give(FleetPlan& plan, RobotId robot, TimedTrack track) {
    REQUIRE(plan.measure(robot, track));
    REQUIRE(plan.fits(robot, track));
    plan.exchange(robot, track);
}

TEST_CASE("a window is found again, and the visits after it keep their gaps") {
    const Fleet fleet = bay_fleet();
    const Problem problem = fleet.problem_with_times();
    SharedDistances distances(problem);
    FleetPlan plan(problem);
    give(plan, 0, late_track());
    // At 2 from tick 12 to 16, between the two visits of the first robot.
    give(plan, 1, {{{0, 5, 0}, {12, 2, 1}, {16, 5, 1}}, 0, {}});
    const Ticks before = booked(plan);
    WindowSearch search(distances, plan);
    TrackWindow window;
    REQUIRE(search.choose(0, 2, 2, window));
    CHECK(window.first == 0);
    CHECK(window.last == 4);
    CHECK(window.end_stage == 1);
    CHECK(window.least == 4);
    CHECK(window.value == 10);
    plan.open_window(0, window.first, window.last, window.until);
    TimedTrack found;
    REQUIRE(search.find(0, window, window.value, test::no_deadline, found));
    CHECK(enters(found) == Ticks{0, 1, 2, 3, 4, 5, 16, 17, 18});
    CHECK(plan.fits(0, found));
    CHECK_FALSE(search.find(0, window, 3, test::no_deadline, found));
    plan.close_window(0);
    CHECK(booked(plan) == before);
}

TEST_CASE("an open window leaves the rest of the track booked") {
    const Fleet fleet = bay_fleet();
    const Problem problem = fleet.problem_with_times();
    FleetPlan plan(problem);
    give(plan, 0, late_track());
    plan.open_window(0, 1, 4, 1);
    // Nobody may be at 1 when the window begins, nor at 4 when it ends; 3 is free in between.
    const TimedTrack in_it{{{2, 3, 1}, {9, 2, 1}, {10, 5, 1}}, 0};
    CHECK(plan.fits(1, in_it));
    CHECK_FALSE(plan.fits(1, {{{1, 1, 1}, {3, 2, 1}, {4, 5, 1}}, 0}));
    CHECK_FALSE(plan.fits(1, {{{9, 4, 1}, {11, 3, 1}}, 0}));
    CHECK_FALSE(plan.fits(1, {{{12, 3, 1}, {13, 2, 1}}, 0}));
    const Ticks open = booked(plan);
    TimedTrack same = late_track();
    same.visits[2].enter = 3;
    plan.exchange(0, same);
    plan.exchange(0, same);
    plan.open_window(0, 1, 4, 1);
    CHECK(booked(plan) == open);
}

TEST_CASE("a robot that has served its stages has no window") {
    const Fleet fleet = bay_fleet();
    const Problem problem = fleet.problem_with_times();
    SharedDistances distances(problem);
    FleetPlan plan(problem);
    give(plan, 0, late_track());
    WindowSearch search(distances, plan);
    TrackWindow window;
    CHECK_FALSE(search.choose(0, 100, 2, window));
    REQUIRE(search.choose(0, 21, 2, window));
    CHECK(window.first == 5);
    CHECK(window.last == 8);
    CHECK(window.end_stage == 2);
}

TEST_CASE("a robot comes no later out of a window than the others and its stages allow") {
    const Fleet fleet(test::Roads(6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {2, 5}}),
                      {{0, {{3}, {4, 0, 0, 8}, {0}}}, {5, {{2, 3}, {5}}}});
    const Problem problem = fleet.problem_with_times();
    SharedDistances distances(problem);
    FleetPlan plan(problem);
    give(plan, 0,
         {{{0, 0, 0},
           {1, 1, 1},
           {2, 2, 1},
           {3, 3, 1},
           {4, 4, 1},
           {5, 3, 1},
           {20, 2, 1},
           {21, 1, 1},
           {22, 0, 1}},
          0});
    WindowSearch search(distances, plan);
    TrackWindow window;
    REQUIRE(search.choose(0, 1, 1, window));
    REQUIRE(window.last == 3);
    plan.open_window(0, window.first, window.last, window.until);
    // Vertex 2 is held until tick 6, so the robot is at 3 at 6 and at 4 at 7, where it may end
    // at 8.
    give(plan, 1, {{{0, 5, 0}, {1, 2, 1}, {6, 5, 1}}, 0, {}});
    TimedTrack found;
    REQUIRE(search.find(0, window, never, test::no_deadline, found));
    CHECK(enters(found) == Ticks{0, 1, 6, 7, 8, 9, 10, 11, 12});
    TimedTrack other = plan.track(1);
    other.visits[2].enter = 7;
    plan.exchange(1, other);
    CHECK_FALSE(search.find(0, window, never, test::no_deadline, found));
}

// Robots that fetch at random places of a grid, one after another.
Fleet grid_fleet(VertexId size, RobotId n_robots, std::size_t n_stages) {
    test::Crossing grid(size);
    test::Roads roads(0, {});
    roads.indptr = grid.indptr;
    roads.heads = grid.heads;
    Random random(3, 0, 0);
    std::vector<test::Robot> robots;
    for (RobotId robot = 0; robot < n_robots; ++robot) {
        std::vector<test::Stage> stages;
        for (std::size_t k = 0; k < n_stages; ++k) {
            stages.push_back({static_cast<VertexId>(random.below(index(size * size))), 1});
        }
        stages.push_back({robot});
        robots.push_back({robot, stages});
    }
    return {roads, robots};
}

TEST_CASE("windows never lose, and do not depend on the number of threads") {
    const Fleet fleet = grid_fleet(6, 6, 8);
    const Problem problem = fleet.problem_with_times();
    SharedDistances distances(problem);
    const auto bounds = test::alone(distances);
    const FleetPlan first = test::planned(distances);
    std::vector<FleetPlan> plans(3, first);
    for (std::size_t k = 0; k < plans.size(); ++k) {
        Lns improver(distances, plans[k], bounds, 5, k + 1);
        improver.run(2000, 2000, test::no_deadline, test::no_deadline);
        CHECK(test::is_sound(distances, plans[k]));
        CHECK(plans[k].cost() < first.cost());
        CHECK(plans[k].cost() == plans[0].cost());
        FleetPlan again(problem);
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            give(again, robot, plans[k].track(robot));
        }
        CHECK(again.cost() == plans[k].cost());
        CHECK(booked(again) == booked(plans[k]));
    }
}

TEST_CASE("an interrupt in a window leaves the plan as it was") {
    const Fleet fleet = grid_fleet(6, 6, 8);
    const Problem problem = fleet.problem_with_times();
    SharedDistances distances(problem);
    const auto bounds = test::alone(distances);
    FleetPlan plan = test::planned(distances);
    for (int most = 1; most < 40; ++most) {
        int n_questions = 0;
        Lns improver(distances, plan, bounds, static_cast<std::uint64_t>(most), 1);
        const auto interrupt = [&]() -> bool {
            if (++n_questions > most) {
                throw std::runtime_error("enough");
            }
            return false;
        };
        CHECK_THROWS(improver.run(1 << 20, 1 << 20, interrupt, test::no_deadline));
        FleetPlan again(problem);
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            give(again, robot, plan.track(robot));
        }
        REQUIRE(booked(again) == booked(plan));
    }
}

}  // namespace
}  // namespace rightofway
