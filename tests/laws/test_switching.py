"""Rights of way that are switched on the way never make robots collide or deadlock."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.floor.switching import switched
from rightofway.model import Tick
from rightofway.precedence import DelayedPlan, Hazards
from tests.fleets import random_fleet
from tests.laws.test_late_floor import RULES, oracle_of, some_hazards, some_plan, times
from tests.oracles import late_floor


@given(
    seed=st.integers(0, 5), rules=st.integers(0, len(RULES) - 1), chance=st.integers(0, 2**32 - 1)
)
@settings(max_examples=100, deadline=None)
def test_robots_that_look_find_the_new_order_possible(seed: int, rules: int, chance: int) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = some_hazards(draw, len(plan.tracks), 20)
    floor = DelayedPlan(plan.scenario, plan.tracks, hazards)
    setbacks = floor.setbacks(chance, 0)
    floor, _ = switched(floor, setbacks)
    found = floor.execute(setbacks)
    slow = oracle_of(floor, setbacks)
    expected = late_floor.by_right_of_way(slow)
    assert times(found) == times(expected)
    assert late_floor.collisions(slow, expected)[:3] == (0, 0, 0)
    assert floor.deadlocked() == []


@given(seed=st.integers(0, 5), rules=st.integers(0, len(RULES) - 1))
def test_nothing_is_switched_where_nobody_is_late(seed: int, rules: int) -> None:
    plan = some_plan(seed, rules)
    floor = DelayedPlan(plan.scenario, plan.tracks, Hazards.none(len(plan.tracks)))
    assert switched(floor, floor.setbacks(0, 0))[1] == 0


@given(chance=st.integers(0, 2**32 - 1), cut=st.integers(1, 30))
@settings(max_examples=60, deadline=None)
def test_what_is_still_to_come_decides_nothing(chance: int, cut: int) -> None:
    """Two runs with the same stops before a tick have the same visits begin before it."""
    plan, draw = some_plan(chance % 6, 1), random.Random(chance)  # noqa: S311
    stops = [(Tick(draw.randint(0, 30)), Tick(draw.choice([3, 10]))) for _ in plan.tracks]
    runs = []
    for later in ([], [(Tick(cut), Tick(50))]):
        each = [[stop] for stop in stops]
        each[0] = sorted([stop for stop in each[0] if sum(stop) < cut] + later)
        hazards = Hazards.none(len(plan.tracks))
        standstills = tuple(tuple(one) for one in each)
        floor = DelayedPlan(plan.scenario, plan.tracks, replace(hazards, standstills=standstills))
        setbacks = floor.setbacks(0, 0)
        runs.append(switched(floor, setbacks)[0].execute(setbacks).enter)
    early = (runs[0] <= cut) | (runs[1] <= cut)
    assert np.array_equal(runs[0][early], runs[1][early])


def test_switching_wins_on_average() -> None:
    """Robots stop now and then: keeping the order makes the others wait for nothing."""
    plan = rightofway.solve(random_fleet(1, size=12, robots=12), "local-search", time_limit=5)
    kept, switch = (
        rightofway.simulate(plan, "chance:0.03x20", runs=30, switch=switch)
        for switch in (False, True)
    )
    assert switch.completion.sum() < kept.completion.sum()
