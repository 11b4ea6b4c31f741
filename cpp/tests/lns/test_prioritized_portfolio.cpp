#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "crossing.hpp"
#include "lns/prioritized_portfolio.hpp"

namespace rightofway {
namespace {

using test::Crossing;
using test::in_turn;
using test::is_sound;

TEST_CASE("planning in turn gives the same plan on one thread and on two, patient or in haste") {
    const Crossing crossing(6);
    const Problem problem(crossing.arrays(), {0, true});
    SharedDistances distances(problem);
    for (const std::int64_t n_searches : {6, 7, 1000}) {
        FleetPlan one(distances.problem());
        FleetPlan two(distances.problem());
        PrioritizedPortfolio first(distances, one, in_turn(distances));
        const bool is_found = first.run(n_searches, false, test::no_deadline, test::no_deadline);
        PrioritizedPortfolio second(distances, two, in_turn(distances));
        second.run(3, true, test::no_deadline, test::no_deadline);  // and on from there
        CHECK(second.run(n_searches, true, test::no_deadline, test::no_deadline) == is_found);
        if (is_found) {
            CHECK(is_sound(distances, second.best()));
            CHECK(first.best().cost() == second.best().cost());
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
        PrioritizedPortfolio portfolio(distances, plan, in_turn(distances));
        REQUIRE(portfolio.run(1000, true, test::no_deadline, test::no_deadline));
        CHECK(portfolio.has_ended());
        CHECK(portfolio.best().cost() == std::min(flowtime[0], flowtime[1]));
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
    PrioritizedPortfolio portfolio(distances, plan, in_turn(distances));
    CHECK(portfolio.run(1000, true, is_over, is_late));
    CHECK(was_asked);
    CHECK(is_sound(distances, portfolio.best()));
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

TEST_CASE("what a search throws on the second thread comes back to the caller") {
    // Edges of two classes take 2^30 ticks each, so no table of the four edges across fits int32.
    Crossing endless(5);
    endless.classes.front() = 1;
    endless.paces.assign(4, 1 << 30);
    endless.n_classes = 2;
    const Problem problem(endless.arrays(), {0, true});
    for (const bool has_second_thread : {false, true}) {
        SharedDistances distances(problem);
        distances.take_alone(std::vector<Tick>(endless.home.size(), Tick{1} << 32));
        FleetPlan plan(problem);
        PrioritizedPortfolio portfolio(distances, plan, in_turn(distances));
        CHECK_THROWS_AS(
            portfolio.run(1000, has_second_thread, test::no_deadline, test::no_deadline),
            std::overflow_error);
    }
}

}  // namespace
}  // namespace rightofway
