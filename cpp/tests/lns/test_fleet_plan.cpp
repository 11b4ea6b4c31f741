#include <doctest/doctest.h>

#include "crossing.hpp"
#include "lns/fleet_plan.hpp"

namespace rightofway {
namespace {

using test::Crossing;
using test::is_sound;
using test::planned;

TEST_CASE("a plan knows who is in the way of a track, by booking or by swap") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    FleetPlan plan(distances.problem());
    TimedTrack there{{{0, 5, 0}, {1, 6, 1}, {2, 7, 1}}, 2};
    plan.exchange(0, there);
    CHECK(plan.cost() == 2);
    std::vector<RobotId> conflicting;
    const TimedTrack into{{{0, 12, 0}, {3, 7, 3}}, 3};
    CHECK_FALSE(plan.fits(1, into));
    const TimedTrack swap{{{-9, 11, 0}, {-5, 6, 3}, {1, 5, 3}, {4, 10, 3}}, 4};
    plan.find_conflicting(1, swap, conflicting);
    CHECK(conflicting == std::vector<RobotId>{0});
    const TimedTrack later{{{0, 11, 0}, {3, 6, 3}, {6, 5, 3}}, 6};
    CHECK(plan.fits(1, later));
    plan.hold_home(2, 7);
    CHECK(plan.bookings().at(problem.home(2)).size() == 1);
    plan.hold_home(2, 0);
    CHECK(plan.bookings().at(problem.home(2)).empty());
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

TEST_CASE("a retiming that is interrupted leaves the plan as it was") {
    const Crossing crossing(24);  // 66 robots of 24 visits each, and more where they make room
    const Problem problem(crossing.arrays(), {});
    SharedDistances distances(problem);
    FleetPlan plan = planned(distances);
    const std::vector<Tick> before = plan.tracks().enter;
    CHECK_THROWS_AS(plan.retime(test::interrupted), std::runtime_error);
    CHECK(plan.tracks().enter == before);
}

}  // namespace
}  // namespace rightofway
