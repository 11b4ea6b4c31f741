#include <doctest/doctest.h>

#include <stdexcept>

#include "crossing.hpp"
#include "lns/lns.hpp"
#include "lns/population.hpp"

namespace rightofway {
namespace {

using test::alone;
using test::Crossing;
using test::is_sound;
using test::planned;

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

}  // namespace
}  // namespace rightofway
