"""Two judges that share no code find the same faults: in plans, broken plans and executions."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import pytest

import rightofway
from rightofway.cyclic import best_timetable, plan_of, run_laps
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Closure, Plan, Scenario, Track, VertexId
from tests.builders.in_a_row import in_a_row
from tests.builders.mixed import mixed, nudged
from tests.builders.seeds import seeds
from tests.builders.sizes import sized, sized_on_lanes, tiny, zoned
from tests.oracles.judge import faults

BETWEEN_ROBOTS = {
    "vertex conflict": "booking",
    "headway": "booking",
    "space conflict": "booking",
    "zone conflict": "booking",
    "swap conflict": "swap",
    "rotation": "rotation",
    "too close": "meeting",
    "closed": "closure",
}
"""What the second judge says instead; every other fault is one of a trip."""

PLANNERS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("prioritized", {}),
    ("two-level", {}),
    ("lacam", {}),
    ("lns", {"iterations": 30}),
    ("auto", {"iterations": 30}),
)


def scenario(seed: int) -> Scenario:
    """Return a random fleet on lanes, on lanes with sizes, on a grid with sizes, or with zones."""
    if seed % 5 < 2:
        return mixed(seed)
    return (sized, sized_on_lanes, zoned)[seed % 5 - 2](seed)


@cache
def some_plan(seed: int) -> Plan:
    name, options = PLANNERS[seed // 5 % 5]
    try:
        return rightofway.solve(scenario(seed), name, time_limit=10, **options)
    except (NoPlanExists, GaveUp, InputError) as reason:
        pytest.skip(f"no plan: {reason}")


def found_by_the_judge(plan: Plan) -> set[tuple[str, tuple[int, ...]]]:
    """Return the faults of trips; if there is none, those of robots with each other."""
    found = {
        (BETWEEN_ROBOTS.get(fault.kind, "trip"), fault.robots)
        for fault in rightofway.check(plan, limit=10**6).faults
    }
    return {fault for fault in found if fault[0] == "trip"} or found


def without_needless_swaps(
    found: set[tuple[str, tuple[int, ...]]],
) -> set[tuple[str, tuple[int, ...]]]:
    """Leave out the swaps of robots whose bookings overlap, too."""
    return {(kind, who) for kind, who in found if kind != "swap" or ("booking", who) not in found}


@pytest.mark.parametrize("seed", seeds(400, 5))
def test_both_judges_find_the_same_faults(seed: int) -> None:
    plan, draw = some_plan(seed), random.Random(seed)  # noqa: S311
    assert faults(plan) == set()
    for _ in range(8):
        broken = nudged(plan, draw)
        judged = without_needless_swaps(found_by_the_judge(broken))
        assert judged == without_needless_swaps(faults(broken))


@pytest.mark.parametrize("seed", seeds(100, 5))
def test_both_judges_agree_on_stops_in_a_row_at_one_place(seed: int) -> None:
    """Some robots have two stops at one place, or one at home before or after the way there."""
    name, options = PLANNERS[seed % 5]
    try:
        plan = rightofway.solve(in_a_row(seed), name, time_limit=10, **options)
    except (NoPlanExists, GaveUp) as reason:
        pytest.skip(f"no plan: {reason}")
    assert faults(plan) == set()
    draw = random.Random(seed)  # noqa: S311
    for _ in range(20):
        broken = nudged(plan, draw)
        judged = without_needless_swaps(found_by_the_judge(broken))
        assert judged == without_needless_swaps(faults(broken))


@pytest.mark.parametrize("seed", seeds(100, 5))
def test_laps_with_stops_in_a_row_are_as_short_as_the_second_judge_allows(
    seed: int,
) -> None:
    """A robot without others: of its laps, the second judge allows none to be a tick shorter."""
    scenario = in_a_row(seed)
    rules = replace(scenario.rules, turn_rate=None)  # laps refuse it
    alone = replace(scenario, robots=scenario.robots[:1], rules=rules)
    try:
        plan = plan_of(run_laps(alone, time_limit=2))
    except (InputError, NoPlanExists, GaveUp) as reason:
        pytest.skip(f"no laps: {reason}")
    assert faults(plan) == faults(plan_of(best_timetable(alone, rounds=5))) == set()
    [track] = plan.tracks
    for visit in range(1, len(track)):
        sooner = track.enter.copy()
        sooner[visit:] -= 1
        shorter = Track(vertices=track.vertices, enter=sooner)
        assert faults(replace(plan, tracks=(shorter,))) == {("trip", (0,))}


@pytest.mark.parametrize("seed", seeds(200, 2))
@pytest.mark.parametrize("more", ["", "switch", "replan"])
def test_late_robots_never_meet(seed: int, more: str) -> None:
    plan = some_plan(seed)
    try:
        outcome = rightofway.simulate(
            plan,
            "chance:0.2x9",
            runs=2,
            seed=seed,
            switch=more == "switch",
            replan=more == "replan",
        )
    except InputError as refused:
        pytest.skip(str(refused))
    assert (outcome.collisions, outcome.deadlocks) == (0, 0)
    for run in range(2):
        assert faults(plan, outcome.trace(run)) == set()


def without_rotations(scenario: Scenario) -> Scenario:
    return replace(scenario, rules=replace(scenario.rules, rotations=False))


def with_a_closure(scenario: Scenario) -> Scenario:
    closure = Closure(at=VertexId(0), from_=Fraction(2), until=Fraction(5))
    return replace(scenario, closures=(closure,))


@pytest.mark.parametrize("seed", seeds(100, 2))
@pytest.mark.parametrize("fleet", [tiny, zoned])
@pytest.mark.parametrize("changed", [without_rotations, with_a_closure])
def test_a_few_robots_keep_rules_that_change_how_plans_are_retimed(
    changed: Callable[[Scenario], Scenario], fleet: Callable[[int], Scenario], seed: int
) -> None:
    try:
        plan = rightofway.solve(changed(fleet(seed)), "lns", iterations=20, time_limit=5)
    except (NoPlanExists, GaveUp, InputError) as reason:
        pytest.skip(f"no plan: {reason}")
    assert faults(plan) == set()
