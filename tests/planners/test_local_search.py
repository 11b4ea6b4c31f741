"""Flips of rights of way, on routes that stay as they are."""

from fractions import Fraction

import pytest

import rightofway
from rightofway.metrics import measure
from rightofway.model import Plan, Rules, Scenario, Status, Track
from rightofway.planners import PlanRequest
from rightofway.planners.local_search import local_search
from tests.builders.fleets import grid_fleet, random_fleet


def flowtime(plan: Plan) -> int:
    return measure(plan).flowtime


def improved(scenario: Scenario, rounds: int, **options: str) -> Plan:
    return rightofway.solve(
        scenario, "local-search", time_limit=None, options={"rounds": rounds, **options}
    )


@pytest.mark.parametrize("seed", range(12))
def test_it_is_never_worse_than_two_level_and_more_rounds_never_hurt(seed: int) -> None:
    rules = Rules(occupancy="both" if seed % 2 else "one")
    scenario = random_fleet(seed, size=8, robots=6, walls=0.15, rules=rules)
    first = rightofway.solve(scenario, "two-level")
    descent, rounds = improved(scenario, 0), improved(scenario, 40)
    assert flowtime(first) >= flowtime(descent) >= flowtime(rounds)
    for plan in (descent, rounds):
        for before, after in zip(first.tracks, plan.tracks, strict=True):
            assert after.vertices.tolist() == before.vertices.tolist()


def test_one_flip_lets_the_fast_robot_through_before_the_slow_one() -> None:
    """Through a corridor of eight cells, R1 with a tick a cell and R2 with five.

    In the plan given R1 follows R2: 46 + 45. First it is through at 9 and in nobody's way: 9 + 45.
    """
    scenario = grid_fleet(
        [".@@@@@@.", "........", ".@@@@@@."],
        [("N0", "N7"), ("N16", "N23")],
        rules=Rules(ends="none"),
        speeds=[Fraction(1), Fraction(1, 5)],
    )
    vertex, corridor = scenario.roadmap.get_vertex, [f"N{k}" for k in range(8, 16)]
    behind = (
        Track.of([vertex(v) for v in ["N0", *corridor, "N7"]], [0, *range(10, 46, 5), 46]),
        Track.of([vertex(v) for v in ["N16", *corridor, "N23"]], range(0, 46, 5)),
    )
    draft = local_search(PlanRequest(scenario=scenario, options={"rounds": 0}, start=behind))
    assert [int(track.enter[-1]) for track in draft.tracks] == [9, 45]
    assert draft.status == Status("reversals", objective="flowtime", before=91, after=54)


def test_rounds_find_what_no_single_flip_does() -> None:
    scenario = random_fleet(14, size=8, robots=6, walls=0.15)
    assert flowtime(improved(scenario, 40)) < flowtime(improved(scenario, 0))


@pytest.mark.parametrize("seed", [24, 29, 112])
def test_flips_do_not_make_rotations_where_these_are_forbidden(seed: int) -> None:
    rules = Rules(rotations=False)
    scenario = random_fleet(seed, size=6, robots=9, walls=0.05, rules=rules)
    assert rightofway.check(improved(scenario, 100)).ok


def test_where_nobody_waits_there_is_nothing_to_flip() -> None:
    plan = improved(grid_fleet(["...", "..."], [("N0", "N2"), ("N3", "N5")]), 5)
    assert plan.run.status == Status(
        "then",
        first=Status("waits only"),
        second=Status("reversals", objective="flowtime", before=10, after=10),
    )


def test_time_that_runs_out_leaves_the_best_plan_so_far() -> None:
    scenario = random_fleet(3, size=32, robots=60)
    first = rightofway.solve(scenario, "two-level")
    plan = rightofway.solve(scenario, "local-search", time_limit=1.0, options={"rounds": 10**6})
    assert rightofway.check(plan).ok
    assert flowtime(plan) <= flowtime(first)
