#include <doctest/doctest.h>

#include <array>

#include "cbs/fewest_actions.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

using test::Fleet;

const StopCondition never_over = [] { return false; };

TimedTrack track(std::vector<Visit> visits) {
    const Tick cost = visits.back().enter;
    return {std::move(visits), cost};
}

TEST_CASE("a robot that waits at two places waits at one, and is as early") {
    // R0 works at 3 until 4 and is at 4 at 5. R1 follows from 0 to 3, where it may be at 5.
    const Fleet fleet({5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}}, {{3, {{3, 4}, {4}}}, {0, {{3}}}});
    const Problem problem = fleet.problem();
    SharedDistances distances(problem);
    for (const std::int64_t most_states : {0, 1000}) {
        FleetPlan plan(problem);
        TimedTrack first = track({{0, 3, 0}, {5, 4, 1}});
        TimedTrack second = track({{0, 0, 0}, {1, 1, 1}, {3, 2, 1}, {5, 3, 1}});
        plan.exchange(0, first);
        plan.exchange(1, second);
        std::array<Tick, 2> waits{0, 2};
        const bool is_proven =
            take_fewest_actions(distances, plan, waits, never, most_states, never_over);
        CHECK(is_proven == (most_states > 0));
        CHECK(plan.cost() == 10);
        const auto& visits = plan.track(1).visits;
        std::int64_t n_waits = 0;
        for (std::size_t k = 1; k < visits.size(); ++k) {
            n_waits += visits[k].enter - visits[k - 1].enter > visits[k].drive ? 1 : 0;
        }
        CHECK(n_waits == (most_states > 0 ? 1 : 2));
    }
}

}  // namespace
}  // namespace rightofway
