"""A plan that starts from the plan of another scenario keeps all rules, and never loses for it."""

from __future__ import annotations

import random
from dataclasses import replace
from functools import cache

import pytest

import rightofway
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, Scenario, cost_of
from rightofway.planners import registered
from tests.builders.changes import CHANGES
from tests.builders.fleets import random_fleet
from tests.builders.mixed import mixed, nudged
from tests.builders.seeds import seeds
from tests.builders.sizes import sized, sized_on_lanes, zoned
from tests.oracles.judge import faults

STARTERS = sorted(name for name, spec in registered().items() if spec.improves)
"""Planners that can start from a plan."""


def scenario(seed: int) -> Scenario:
    """Return a random fleet: points on a grid or on lanes, with sizes, or with zones."""
    makers = (lambda seed: random_fleet(seed, robots=6), mixed, sized, sized_on_lanes, zoned)
    return makers[seed % len(makers)](seed)


@cache
def some_plan(seed: int) -> Plan:
    try:
        return rightofway.solve(scenario(seed), "auto", time_limit=10, iterations=30)
    except (NoPlanExists, GaveUp, InputError) as reason:
        pytest.skip(f"no plan: {reason}")


def changed_plan(change: str, seed: int, planner: str) -> Plan:
    old, draw = some_plan(seed), random.Random(seed)  # noqa: S311
    few = {"rounds": 5} if planner == "local-search" else {"iterations": 30}
    try:
        new = CHANGES[change](old.scenario, draw)
        return rightofway.solve(new, planner, time_limit=10, start=old, options=few)
    except (NoPlanExists, GaveUp, InputError) as reason:
        pytest.skip(f"no plan: {reason}")


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("seed", seeds(200, 5))
def test_plans_of_changed_scenarios_keep_all_rules(change: str, seed: int) -> None:
    plan = changed_plan(change, seed, STARTERS[seed % len(STARTERS)])
    assert rightofway.check(plan).ok
    assert faults(plan) == set()
    assert plan.run.start is not None
    assert plan.run.start.tracks <= plan.run.start.routes <= len(plan.tracks)


@pytest.mark.parametrize("planner", STARTERS)
@pytest.mark.parametrize("seed", seeds(100, 5))
def test_a_plan_of_the_same_scenario_is_at_least_as_good(planner: str, seed: int) -> None:
    old = some_plan(seed)
    new = changed_plan("nothing", seed, planner)
    assert cost_of(new.scenario, new.tracks) <= cost_of(old.scenario, old.tracks)


@pytest.mark.parametrize("seed", seeds(100, 5))
def test_the_unit_of_speed_and_work_does_not_matter(seed: int) -> None:
    """Half as fast with twice the work is the same plan in ticks of twice the length."""
    old = some_plan(5 * seed)  # of points on a grid, which turn for as long as they drive a cell
    slow = tuple(
        replace(
            robot,
            speed=robot.speed / 2,
            stops=tuple(replace(stop, work=2 * stop.work) for stop in robot.stops),
        )
        for robot in old.scenario.robots
    )
    new = rightofway.solve(replace(old.scenario, robots=slow), "lns", start=old, iterations=1)
    tick, old_tick = (one.scenario.problem.clock.tick for one in (new, old))
    assert new.flowtime * tick <= 2 * old.flowtime * old_tick


@pytest.mark.parametrize("change", ["a home", "a speed", "a robot more"])
@pytest.mark.parametrize("seed", seeds(50, 2))
def test_the_same_seed_gives_the_same_plan_from_the_same_start(change: str, seed: int) -> None:
    one, other = (changed_plan(change, seed, "auto") for _ in range(2))
    assert one.tracks == other.tracks


@pytest.mark.parametrize("seed", seeds(200, 5))
def test_an_old_plan_with_faults_does_no_harm(seed: int) -> None:
    """Other vertices, other times: whatever the old plan is, the new one keeps all rules."""
    old = some_plan(seed)
    draw = random.Random(seed)  # noqa: S311
    for _ in range(4):
        plan = rightofway.solve(old.scenario, "lns", iterations=5, start=nudged(old, draw))
        assert faults(plan) == set()
