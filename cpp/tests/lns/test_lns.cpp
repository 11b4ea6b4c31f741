#include <doctest/doctest.h>

#include <stdexcept>

#include "crossing.hpp"
#include "lns/lns.hpp"

namespace rightofway {
namespace {

using test::alone;
using test::Crossing;
using test::is_sound;
using test::planned;

TEST_CASE("improvement never loses, and does not depend on the number of threads") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    const FleetPlan first = planned(distances);
    std::vector<FleetPlan> plans(3, first);
    for (std::size_t k = 0; k < plans.size(); ++k) {
        Lns improver(distances, plans[k], bounds, 5, k + 1);
        improver.run(300, 1000, test::no_deadline, test::no_deadline);
        CHECK(improver.n_tasks() == 300);
        CHECK(is_sound(distances, plans[k]));
        CHECK(plans[k].cost() < first.cost());
        CHECK(plans[k].cost() == plans[0].cost());
    }
    for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
        CHECK(plans[0].track(robot).cost == plans[2].track(robot).cost);
    }
}

TEST_CASE("improvement of a makespan never loses, on any number of threads") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    const FleetPlan by_flowtime = planned(distances);
    for (const Objective objective : {Objective::makespan, Objective::both}) {
        FleetPlan first(problem, objective);
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            TimedTrack track = by_flowtime.track(robot);
            first.exchange(robot, track);
        }
        std::vector<FleetPlan> plans(2, first);
        for (std::size_t k = 0; k < plans.size(); ++k) {
            Lns improver(distances, plans[k], bounds, 5, k + 1);
            improver.run(300, 1000, test::no_deadline, test::no_deadline);
            CHECK(is_sound(distances, plans[k]));
            CHECK(plans[k].worth() < first.worth());
            CHECK(plans[k].worth() == plans[0].worth());
        }
        const Tick makespan = plans[0].makespan();
        const Tick total = problem.total_weight() * makespan + plans[0].cost();
        CHECK(plans[0].worth().value == (objective == Objective::makespan ? makespan : total));
    }
}

TEST_CASE("what the caller throws comes back when the plan is whole") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    FleetPlan plan = planned(distances);
    Lns improver(distances, plan, bounds, 5, 2);
    int n_questions = 0;
    const auto interrupt = [&n_questions]() -> bool {
        return ++n_questions > 2 ? throw std::runtime_error("enough") : false;
    };
    // Each round is shorter than questions are apart.
    CHECK_THROWS_AS(improver.run(20'000, 1 << 30, interrupt, test::no_deadline),
                    std::runtime_error);
    CHECK(is_sound(distances, plan));
}

TEST_CASE("what a task throws comes back when the plan is whole, on one thread and on two") {
    // As no table of distances fits int32, each search throws; the first plan is written by hand.
    constexpr Tick edge = 1 << 30;
    Crossing endless(5);
    endless.classes.front() = 1;
    endless.paces.assign(4, edge);
    endless.n_classes = 2;
    const Problem problem(endless.arrays(), {0, false});
    for (const std::size_t n_threads : {1U, 2U}) {
        SharedDistances distances(problem);
        const std::vector<Tick> bounds(endless.home.size(), 1);
        distances.take_alone(bounds);
        FleetPlan plan(problem);
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            // Each stays for longer than all others before it need.
            TimedTrack track{{{0, problem.home(robot), 0}}, 0};
            const VertexId target = problem.stage_vertex(robot);
            const VertexId step = std::abs(target - problem.home(robot)) < 5 ? 1 : 5;
            for (VertexId v = problem.home(robot); v != target;) {
                v += target > v ? step : -step;
                track.cost = std::max(track.cost, 10 * robot * edge) + edge;
                track.visits.push_back({track.cost, v, 1 << 30});
            }
            plan.exchange(robot, track);
        }
        const Tick cost = plan.cost();
        Lns improver(distances, plan, bounds, 5, n_threads);
        CHECK_THROWS_AS(improver.run(300, 1000, test::no_deadline, test::no_deadline),
                        std::overflow_error);
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            CHECK(plan.has_track(robot));
        }
        CHECK(plan.cost() == cost);
    }
}

}  // namespace
}  // namespace rightofway
