#include <doctest/doctest.h>

#include <vector>

#include "cbs/cbs.hpp"
#include "cbs/vertex_cover.hpp"
#include "fleets.hpp"

namespace rightofway {
namespace {

using test::Fleet;

const StopCondition never_over = [] { return false; };

const CbsOptions all{.cardinal = true,
                     .bypass = true,
                     .clear = true,
                     .targets = true,
                     .disjoint = true,
                     .pairs = true,
                     .pair_nodes = 100,
                     .joint_states = 10'000,
                     .factor = 1'000'000,
                     .latest = never};

TEST_CASE(
    "two robots that swap the ends of a corridor with a bay lose what one needs for the bay") {
    // R0 goes from 0 to 2, R1 from 2 to 0; one has to go into the bay 3 and come back: 2 ticks,
    // and the other one follows without a wait.
    const Fleet fleet({4, {{0, 1}, {1, 2}, {1, 3}}}, {{0, {{2}}}, {2, {{0}}}});
    const Problem problem = fleet.problem();
    SharedDistances distances(problem);
    for (const std::int64_t pair_nodes : {0, 100}) {
        ConstrainedTracks tracks(problem, distances);
        CbsOptions options = all;
        options.pair_nodes = pair_nodes;
        PairLosses losses(tracks, options);
        ConflictTree tree(tracks, {0, 1}, options, pair_nodes > 0 ? &losses : nullptr);
        REQUIRE(tree.start(std::vector<SetId>{0, 0}, never_over));
        CHECK(tree.bound() == 4);
        CHECK(tree.run(never, never, 1000, never_over) == SearchEnd::found);
        CHECK(tree.bound() == 7);
        CHECK(losses.together({0, 1}, {0, 0}, never_over) == 3);
        // One loses 1 and the other 2, or the other way round.
        CHECK(losses.either({0, 1}, {0, 0}, never_over) == std::array<Tick, 2>{2, 2});
    }
}

TEST_CASE("pairs search no more joint states than they are allowed, and later raise their bound") {
    const Fleet fleet({4, {{0, 1}, {1, 2}, {1, 3}}}, {{0, {{2}}}, {2, {{0}}}});
    const Problem problem = fleet.problem();
    SharedDistances distances(problem);
    ConstrainedTracks tracks(problem, distances);
    CbsOptions options = all;
    options.pair_nodes = 1;
    options.joint_states = 3;
    PairLosses losses(tracks, options);
    const auto loss = [&] { return losses.together({0, 1}, {0, 0}, never_over); };
    CHECK(loss() < 3);
    CHECK(losses.n_states() == 3);
    CHECK(loss() < 3);
    CHECK(losses.n_states() == 3);
    losses.allow(100);
    CHECK(loss() == 3);
    CHECK(losses.n_states() <= 15);
}

TEST_CASE("a known plan of least cost is proven, and nothing below it is found") {
    const Fleet fleet({4, {{0, 1}, {1, 2}, {1, 3}}}, {{0, {{2}}}, {2, {{0}}}});
    const Problem problem = fleet.problem();
    SharedDistances distances(problem);
    ConstrainedTracks tracks(problem, distances);
    ConflictTree tree(tracks, {0, 1}, all, nullptr);
    REQUIRE(tree.start(std::vector<SetId>{0, 0}, never_over));
    CHECK(tree.run(7, never, 1000, never_over) == SearchEnd::proven_none);
    CHECK(tree.bound() == 7);
    CHECK(tree.tracks().empty());
}

TEST_CASE("constraints in any order are one set") {
    ConstraintSets sets;
    const Constraint first{1, 4, 5};
    const Constraint second{0, 7, 8};
    const SetId one = sets.with(sets.with(ConstraintSets::empty, first), second);
    CHECK(one == sets.with(sets.with(ConstraintSets::empty, second), first));
    CHECK(one == sets.with(one, first));
    CHECK(sets.at(one).size() == 2);
}

TEST_CASE("the least cover of a triangle of losses takes half of each pair") {
    CHECK(cover(3, {{0, 1, 2}, {1, 2, 2}, {0, 2, 2}}) == 3);
    CHECK(cover(4, {{0, 1, 5}, {2, 3, 1}}) == 6);
    CHECK(cover(3, {{0, 1, 5}, {1, 2, 4}}) == 5);
    CHECK(cover(2, {}) == 0);
}

}  // namespace
}  // namespace rightofway
