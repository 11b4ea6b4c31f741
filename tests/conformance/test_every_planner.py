"""What every registered planner owes: valid plans, the same ones for the same seed, honest ends."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.metrics import measure
from rightofway.model import Plan, Scenario
from rightofway.planners import Feature, find_all
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.small import SMALL, STRICT

PLANNERS = sorted(find_all())


def key(plan: Plan) -> list[tuple[bytes, bytes]]:
    return [(track.vertices.tobytes(), track.enter.tobytes()) for track in plan.tracks]


@pytest.mark.parametrize("planner", STRICT)
@pytest.mark.parametrize("scenario", SMALL.values(), ids=list(SMALL))
def test_plans_are_valid_and_never_below_the_lower_bound(planner: str, scenario: Scenario) -> None:
    plan = rightofway.solve(scenario, planner)
    assert rightofway.check(plan).ok
    metrics = measure(plan)
    assert metrics.flowtime >= metrics.lower_bound
    assert plan.run.name == planner
    assert plan.run.status


@pytest.mark.parametrize("planner", STRICT)
@pytest.mark.parametrize("seed", [0, 7])
def test_the_same_seed_gives_the_same_plan(planner: str, seed: int) -> None:
    scenario = random_fleet(3, robots=12)
    plans = [rightofway.solve(scenario, planner, seed=seed) for _ in range(2)]
    assert key(plans[0]) == key(plans[1])


@pytest.mark.parametrize("planner", PLANNERS)
def test_a_robot_alone_completes_as_soon_as_it_can(planner: str) -> None:
    """Three cells out, a tick to turn, two of work, three back: 9."""
    plan = rightofway.solve(grid_fleet(["...."], [("N0", "N3")], work=[2]), planner)
    assert int(plan.tracks[0].enter[-1]) == 9


@pytest.mark.parametrize("planner", PLANNERS)
def test_the_impossible_is_refused_as_proven(planner: str) -> None:
    with pytest.raises(NoPlanExists):
        rightofway.solve(grid_fleet([".@."], [("N0", "N2")]), planner)


@pytest.mark.parametrize("planner", PLANNERS)
def test_every_option_has_its_default_first_and_refuses_what_it_does_not_know(planner: str) -> None:
    spec = find_all()[planner]
    for option in spec.options:
        with pytest.raises(rightofway.InputError, match=r"is unknown|does not fit|is not a number"):
            spec.settle({option.name: "no such value"})
    given: dict[str, Any] = {"no-such-option": 1}
    with pytest.raises(rightofway.InputError, match="is unknown to"):
        spec.settle(given)


@pytest.mark.parametrize(
    "planner", [name for name in PLANNERS if Feature.IMPROVES in find_all()[name].features]
)
@pytest.mark.parametrize("seed", range(3))
def test_who_can_start_from_a_plan_makes_it_no_worse(planner: str, seed: int) -> None:
    first = rightofway.solve(random_fleet(seed, robots=6), "two-level")
    better = rightofway.improve(first, planner, time_limit=5)
    assert rightofway.check(better).ok
    assert measure(better).flowtime <= measure(first).flowtime


def test_only_a_plan_without_faults_is_improved_and_only_by_who_can() -> None:
    plan = rightofway.solve(random_fleet(1, robots=3), "two-level")
    with pytest.raises(rightofway.InputError, match="planner: two-level cannot start from a plan"):
        rightofway.improve(plan, "two-level")
    early = replace(plan.tracks[0], enter=np.arange(len(plan.tracks[0])))
    wrong = replace(plan, tracks=(early, *plan.tracks[1:]))
    told = (
        r"the plan has 1 fault.*without faults \(repair it: `rightofway plan SCENARIO --start PLAN`"
    )
    with pytest.raises(rightofway.InputError, match=told):
        rightofway.improve(wrong)
    assert rightofway.check(rightofway.solve(wrong.scenario, start=wrong, iterations=10)).ok
