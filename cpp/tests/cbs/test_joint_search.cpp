#include <doctest/doctest.h>

#include <array>

#include "cbs/constrained_tracks.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

using test::Fleet;

const StopCondition never_over = [] { return false; };

TEST_CASE("two robots that swap the ends of a corridor complete in turn, whoever takes the bay") {
    // R0 goes from 0 to 2, R1 from 2 to 0; one goes into the bay 3 and comes back. Alone they
    // complete at 2; R1 in the bay: R0 at 3, R1 at 4, or the other way round.
    const Fleet fleet({4, {{0, 1}, {1, 2}, {1, 3}}}, {{0, {{2}}}, {2, {{0}}}});
    const Problem problem = fleet.problem();
    SharedDistances distances(problem);
    ConstrainedTracks tracks(problem, distances);
    const std::array<RobotId, 2> robots{0, 1};
    const std::array<SetId, 2> free{ConstraintSets::empty, ConstraintSets::empty};
    const JointPlan plan = tracks.together(robots, free, {}, 1000, never_over);
    REQUIRE(plan.end == SearchEnd::found);
    CHECK(plan.bound == 7);
    CHECK(plan.tracks[0]->cost + plan.tracks[1]->cost == 7);
    const std::array<Tick, 2> in_time{3, 3};
    CHECK(tracks.together(robots, free, in_time, 1000, never_over).end == SearchEnd::proven_none);
    CHECK(tracks.together(robots, free, {}, 1, never_over).end == SearchEnd::stopped);
}

}  // namespace
}  // namespace rightofway
