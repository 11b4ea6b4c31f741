#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "corridors.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/lns.hpp"
#include "lns/population.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {
namespace {

// Robots that cross a grid of `size` * `size` from side to side, each from its own row or column.
struct Crossing {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;
    std::vector<std::int32_t> classes;
    std::vector<std::int32_t> paces{1, 3};
    std::vector<std::int32_t> pace_of;
    std::vector<VertexId> home;
    std::vector<std::int32_t> first_stage{0};
    std::vector<VertexId> stage;
    std::vector<Tick> nothing;
    std::int32_t n_classes = 1;

    explicit Crossing(VertexId size) {
        for (VertexId v = 0; v < size * size; ++v) {
            for (const VertexId step : {1, size, -1, -size}) {
                const bool leaves_row =
                    std::abs(step) == 1 && (v + step + size) / size != v / size + 1;
                if (v + step >= 0 && v + step < size * size && !leaves_row) {
                    heads.push_back(v + step);
                }
            }
            indptr.push_back(static_cast<EdgeId>(heads.size()));
        }
        classes.assign(heads.size(), 0);
        for (VertexId k = 1; k + 1 < size; ++k) {
            add(k * size, k * size + size - 1, 0);
            add(k * size + size - 1, k * size, 1);
            add(k, (size - 1) * size + k, 0);
        }
    }

    void add(VertexId from, VertexId to, std::int32_t pace) {
        home.push_back(from);
        stage.push_back(to);
        pace_of.push_back(pace);
        first_stage.push_back(static_cast<std::int32_t>(stage.size()));
        nothing.push_back(0);
    }

    ProblemArrays arrays() const {
        return {indptr,      heads, classes, paces,   pace_of,  home,
                first_stage, stage, nothing, nothing, n_classes};
    }
};

std::vector<Tick> alone(SharedDistances& distances) {
    std::vector<Tick> ticks;
    for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
        ticks.push_back(distances.alone(robot));
    }
    return ticks;
}

std::vector<RobotId> in_turn(SharedDistances& distances) {
    std::vector<RobotId> order(static_cast<std::size_t>(distances.problem().n_robots()));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

SearchEnd plan_all(SharedDistances& distances, FleetPlan& plan, std::int64_t n_searches) {
    Prioritized planner(distances, plan);
    planner.start(in_turn(distances));
    return planner.run(n_searches, test::no_deadline);
}

FleetPlan planned(SharedDistances& distances) {
    FleetPlan plan(distances.problem());
    REQUIRE(plan_all(distances, plan, 1000) == SearchEnd::found);
    return plan;
}

bool is_sound(SharedDistances& distances, const FleetPlan& plan) {
    bool sound = true;
    for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
        sound = sound && plan.has_track(robot) && plan.fits(robot, plan.track(robot));
    }
    return sound;
}

TEST_CASE("a robot alone needs the way there in its own ticks") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    CHECK(distances.alone(0) == 4);
    CHECK(distances.alone(1) == 12);
    CHECK(problem.drive(1, 0, 1) == 3);
    CHECK(problem.drive(1, 0, 7) == -1);
}

TEST_CASE("arrays that do not fit together are refused") {
    Crossing far(5);
    far.home.back() = 99;
    CHECK_THROWS_AS(Problem(far.arrays(), {0, false}), std::invalid_argument);
    Crossing slow(5);
    slow.paces[1] = 0;
    CHECK_THROWS_AS(Problem(slow.arrays(), {0, false}), std::invalid_argument);
    Crossing idle(5);
    idle.first_stage[1] = 0;
    CHECK_THROWS_AS(Problem(idle.arrays(), {0, false}), std::invalid_argument);
    Crossing uneven(5);
    uneven.nothing.pop_back();
    CHECK_THROWS_AS(Problem(uneven.arrays(), {0, false}), std::invalid_argument);
    Crossing shared(5);
    shared.home[1] = shared.home[0];
    CHECK_THROWS_AS(Problem(shared.arrays(), {0, false}), std::invalid_argument);
    Crossing hasty(5);
    hasty.nothing[0] = -1;
    CHECK_THROWS_AS(Problem(hasty.arrays(), {0, false}), std::invalid_argument);
    Crossing lost(5);
    lost.heads[0] = 25;
    CHECK_THROWS_AS(Problem(lost.arrays(), {0, false}), std::invalid_argument);
    const Crossing fine(5);
    CHECK_THROWS_AS(Problem(fine.arrays(), {-1, false}), std::invalid_argument);
}

TEST_CASE("robots that keep a headway or book ahead cannot rotate") {
    const Crossing crossing(5);
    CHECK(Problem(crossing.arrays(), {0, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {0, false, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {1, false}).may_rotate());
    CHECK_FALSE(Problem(crossing.arrays(), {0, true}).may_rotate());
}

TEST_CASE("a plan knows who is in the way of a track, by booking or by swap") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    TimedTrack there{{{0, 5, 0}, {1, 6, 1}, {2, 7, 1}}, 2};
    plan.exchange(0, there);
    CHECK(plan.cost() == 2);
    std::vector<RobotId> met;
    const TimedTrack into{{{0, 12, 0}, {3, 7, 3}}, 3};
    CHECK_FALSE(plan.fits(1, into));
    const TimedTrack swap{{{-9, 11, 0}, {-5, 6, 3}, {1, 5, 3}, {4, 10, 3}}, 4};
    plan.in_the_way(1, swap, met);
    CHECK(met == std::vector<RobotId>{0});
    const TimedTrack later{{{0, 11, 0}, {3, 6, 3}, {6, 5, 3}}, 6};
    CHECK(plan.fits(1, later));
    plan.hold_home(2, 7);
    CHECK(plan.bookings().at(problem.home(2)).size() == 1);
    plan.hold_home(2, 0);
    CHECK(plan.bookings().at(problem.home(2)).empty());
}

TEST_CASE("robots in turn get tracks that fit together, under every rule") {
    for (const bool books_ahead : {false, true}) {
        for (const Tick headway : {0, 2}) {
            const Crossing crossing(6);
            const Problem problem(crossing.arrays(), {headway, books_ahead});
            SharedDistances distances(problem);
            FleetPlan plan(distances.problem());
            REQUIRE(plan_all(distances, plan, 1000) == SearchEnd::found);
            CHECK(is_sound(distances, plan));
        }
    }
}

TEST_CASE("planning in turn ends after as many searches as it may make") {
    const Crossing crossing(6);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    CHECK(plan_all(distances, plan, 2) == SearchEnd::stopped);
}

TEST_CASE("planning in turn gives the same plan on one thread and on two, patient or in haste") {
    const Crossing crossing(6);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    for (const std::int64_t n_searches : {6, 7, 1000}) {
        FleetPlan one(distances.problem());
        FleetPlan two(distances.problem());
        const bool is_found = PrioritizedPortfolio(distances, one, in_turn(distances))
                                  .run(n_searches, false, test::no_deadline, test::no_deadline);
        PrioritizedPortfolio second(distances, two, in_turn(distances));
        second.run(3, true, test::no_deadline, test::no_deadline);  // and on from there
        CHECK(second.run(n_searches, true, test::no_deadline, test::no_deadline) == is_found);
        if (is_found) {
            CHECK(is_sound(distances, two));
            CHECK(one.cost() == two.cost());
        }
    }
}

TEST_CASE("planning in turn takes the better one of the patient plan and the one made in haste") {
    bool has_either_won[2] = {false, false};
    for (VertexId k = 0; k < 40; ++k) {
        const Crossing crossing(6 + k / 4);
        const Problem problem(crossing.arrays(), {k % 4, k % 2 == 1});
        SharedDistances distances(problem);
        Tick flowtime[2];
        for (const bool is_hasty : {false, true}) {
            FleetPlan alone(distances.problem());
            Prioritized planner(distances, alone, is_hasty ? hasty : patient);
            planner.start(in_turn(distances));
            REQUIRE(planner.run(1000, test::no_deadline) == SearchEnd::found);
            flowtime[is_hasty ? 1 : 0] = alone.cost();
        }
        FleetPlan plan(distances.problem());
        REQUIRE(PrioritizedPortfolio(distances, plan, in_turn(distances))
                    .run(1000, true, test::no_deadline, test::no_deadline));
        CHECK(plan.cost() == std::min(flowtime[0], flowtime[1]));
        has_either_won[0] |= flowtime[0] < flowtime[1];
        has_either_won[1] |= flowtime[1] < flowtime[0];
    }
    CHECK(has_either_won[0]);
    CHECK(has_either_won[1]);
}

TEST_CASE("with a plan made in haste as a net, it is asked whether it is late, and that is taken") {
    const Crossing crossing(12);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    bool was_asked = false;
    const auto is_over = [] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));  // haste comes first
        return false;
    };
    const auto is_late = [&was_asked] { return was_asked = true; };
    CHECK(PrioritizedPortfolio(distances, plan, in_turn(distances))
              .run(1000, true, is_over, is_late));
    CHECK(was_asked);
    CHECK(is_sound(distances, plan));
}

TEST_CASE("what the caller throws while robots are planned in turn comes back") {
    const Crossing crossing(12);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    const auto interrupt = []() -> bool { throw std::runtime_error("enough"); };
    CHECK_THROWS_AS(PrioritizedPortfolio(distances, plan, in_turn(distances))
                        .run(1000, true, interrupt, interrupt),
                    std::runtime_error);
}

TEST_CASE("a plan in which all leave home late is retimed to what it would be without that") {
    for (const bool books_ahead : {false, true}) {
        const Crossing crossing(6);
        const Problem problem(crossing.arrays(), {1, books_ahead});
        SharedDistances distances(problem);
        FleetPlan prompt = planned(distances);
        FleetPlan late(distances.problem());
        for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
            TimedTrack track = prompt.track(robot);
            for (std::size_t k = 1; k < track.visits.size(); ++k) {
                track.visits[k].enter += 7;
            }
            track.cost += 7;
            late.exchange(robot, track);
        }
        const Tick before = prompt.cost();
        prompt.retime();
        late.retime();
        CHECK(prompt.cost() <= before);
        CHECK(late.tracks().enter == prompt.tracks().enter);
        CHECK(late.cost() == prompt.cost());
        CHECK(is_sound(distances, late));
    }
}

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

TEST_CASE("a plan that is stuck gets better among others, whatever the number of threads") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    FleetPlan stuck = planned(distances);
    Lns alone_for_long(distances, stuck, bounds, 5, 1);
    alone_for_long.run(20'000, 1000, test::no_deadline, test::no_deadline);
    REQUIRE(alone_for_long.n_idle() >= 1000);
    std::vector<FleetPlan> plans(3, stuck);
    for (std::size_t k = 0; k < plans.size(); ++k) {
        Population population(distances, plans[k], bounds, 5, k + 1, 0);
        population.run(6'000, 1 << 30, test::no_deadline, test::no_deadline);
        CHECK(population.n_tasks() == 6'000);
        CHECK(is_sound(distances, plans[k]));
        CHECK(plans[k].cost() < stuck.cost());
        for (RobotId robot = 0; robot < distances.problem().n_robots(); ++robot) {
            CHECK(plans[k].track(robot).cost == plans[0].track(robot).cost);
        }
    }
}

TEST_CASE("one plan comes before a population, and both end when patience does") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    const FleetPlan first = planned(distances);
    FleetPlan in_one_go = first;
    AnytimeLns whole(distances, in_one_go, bounds, 5, 1);
    whole.run(1 << 30, 3000, test::no_deadline, test::no_deadline);
    CHECK(whole.n_idle() >= 3000);
    CHECK(whole.n_tasks() < 1 << 30);
    CHECK(is_sound(distances, in_one_go));

    FleetPlan with_pauses = first;
    AnytimeLns parts(distances, with_pauses, bounds, 5, 2);
    while (parts.n_idle() < 3000) {
        parts.run(1 << 30, 3000, test::no_deadline, [] { return true; });
    }
    CHECK(parts.n_tasks() == whole.n_tasks());
    CHECK(with_pauses.cost() == in_one_go.cost());
}

TEST_CASE("an interrupted population leaves the best plan, and says who interrupted") {
    const Crossing crossing(8);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    const auto bounds = alone(distances);
    FleetPlan plan = planned(distances);
    const Tick before = plan.cost();
    Population population(distances, plan, bounds, 5, 2, 0);
    int n_questions = 0;
    const auto interrupt = [&n_questions]() -> bool {
        return ++n_questions > 5 ? throw std::runtime_error("enough") : false;
    };
    CHECK_THROWS_AS(population.run(1 << 30, 1 << 30, interrupt, test::no_deadline),
                    std::runtime_error);
    CHECK(is_sound(distances, plan));
    CHECK(plan.cost() <= before);
    CHECK(population.n_tasks() < 1 << 30);
}

TEST_CASE("tables are shared, narrow where edges are alike, and forgotten when memory is short") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {});
    const RobotId slow = 1;
    SharedDistances distances(problem, 120);
    const auto first = distances.to(0, slow);
    CHECK(first->bytes() == 50);
    CHECK(first->view(distances.scale(slow)).from(24) == 24);
    CHECK(distances.to(0, slow) == first);
    distances.to(1, slow);
    distances.to(2, slow);
    CHECK(distances.to(0, slow) != first);
    CHECK(first->view(3).from(1) == 3);
}

TEST_CASE("where edges differ, a table is for one pace") {
    Crossing crossing(3);
    crossing.classes.front() = 1;  // from 0 to 1
    crossing.paces = {1, 9, 2, 9};
    crossing.n_classes = 2;
    const Problem problem(crossing.arrays(), {});
    SharedDistances distances(problem);
    CHECK(distances.to(1, 0)->view(distances.scale(0)).from(0) == 3);
    CHECK(distances.to(1, 1)->view(distances.scale(1)).from(0) == 6);
}

}  // namespace
}  // namespace rightofway
