#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "cbs/cbs.hpp"
#include "cbs/joint_tracks.hpp"
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
    JointTracks joint;
    for (const Tick latest : {2, 3, 5}) {
        const TrackGraph* first = tracks.graph(0, ConstraintSets::empty, latest);
        const TrackGraph* second = tracks.graph(1, ConstraintSets::empty, latest);
        REQUIRE(first != nullptr);
        REQUIRE(second != nullptr);
        REQUIRE(joint.search(problem, *first, *second, false, 1000, never_over));
        CHECK(joint.completions().empty() == (latest < 5));
        CHECK_FALSE(joint.search(problem, *first, *second, false, 0, never_over));
    }
}

}  // namespace
}  // namespace rightofway
