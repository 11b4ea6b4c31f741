"""When robots break down the rest finish, wherever that is possible at all."""

from __future__ import annotations

import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.errors import NoPlanExists
from rightofway.execution.replan import plan_the_rest
from rightofway.execution.run import run_in_phases
from rightofway.execution.stop import Rest, breakdown, stop_all
from rightofway.model import NEVER, Plan, Rules, Scenario, Tick
from rightofway.precedence import ActionDependencyGraph, DelayModel
from tests.builders.fleets import fleet_on
from tests.oracles.rest import most_who_can_finish

GRIDS = (
    ["...", "@.@", "..."],
    ["....", ".@@.", "...."],
    [".....", "@@.@@"],
    ["...", "..."],
    ["..@", "...", "@.."],
)
MEETINGS = {"vertex conflict", "swap conflict", "headway", "rotation"}


def small_plan(draw: random.Random, robots: int) -> Plan | None:
    rules = Rules(
        occupancy=draw.choice(["one", "both"]),
        ends=draw.choice(["home", "home", "none"]),
        headway=Fraction(draw.choice([0, 0, 1])),
        laps=1,
    )
    try:
        scenario = fleet_on(draw.choice(GRIDS), draw, robots=robots, rules=rules)
        return rightofway.solve(scenario, "two-level")
    except NoPlanExists:
        return None


def floor_with_breakdowns(draw: random.Random, plan: Plan, most: int) -> ActionDependencyGraph:
    last = max(int(track.enter[-1]) for track in plan.tracks)
    robots = range(len(plan.tracks))
    broken = draw.sample(robots, draw.randint(1, most))
    slow = draw.choice(robots)
    hazards = DelayModel(
        random=draw.choice([(), (("exponential", 0.3, 0.0),), (("chance", 0.1, 5.0),)]),
        pace=tuple(1.6 if robot == slow else 1.0 for robot in robots),
        standstills=tuple(
            ((Tick(draw.randint(0, last)), NEVER),) if robot in broken else () for robot in robots
        ),
    )
    return ActionDependencyGraph(plan.scenario, plan.tracks, hazards)


def most_by_brute_force(rest: Rest, scenario: Scenario) -> int:
    goals = [
        [int(stage.vertex) for stage in left] or [int(at)]
        for left, at in zip(rest.stages, rest.at, strict=True)
    ]
    may_rotate = scenario.rules.occupancy == "one" and scenario.problem.headway == 0
    return most_who_can_finish(
        scenario.roadmap, rest.at, goals, rest.broken, rest.closed, may_rotate=may_rotate
    )


@given(chance=st.integers(0, 2**32 - 1))
@settings(max_examples=80, deadline=None)
def test_as_many_finish_as_brute_force_finds(chance: int) -> None:
    draw = random.Random(chance)  # noqa: S311
    plan = small_plan(draw, robots=draw.randint(2, 4))
    if plan is None:
        return
    floor = floor_with_breakdowns(draw, plan, most=1)
    delay_sample = floor.delay_sample(chance, 0)
    since = min(breakdown(delay_sample, robot) for robot in range(len(plan.tracks)))
    _, rest = stop_all(floor, delay_sample, since, frozenset())
    anew = plan_the_rest(rest, 0)
    assert anew is not None
    assert check(anew.plan).ok
    finishing = len(plan.tracks) - len(rest.broken) - len(anew.cut_off)
    assert finishing == most_by_brute_force(rest, plan.scenario)


@given(chance=st.integers(0, 2**32 - 1), switch=st.booleans())
@settings(max_examples=60, deadline=None)
def test_nobody_collides_over_all_plans_of_a_run_and_the_rest_finish(
    chance: int, switch: bool
) -> None:
    draw = random.Random(chance)  # noqa: S311
    plan = small_plan(draw, robots=draw.randint(2, 4))
    if plan is None:
        return
    floor = floor_with_breakdowns(draw, plan, most=2)
    ended = run_in_phases(floor, chance, 0, switch=switch)
    happened = check(replace(plan, tracks=ended.tracks))
    assert not MEETINGS & set(happened.counts)
    assert not ended.collisions[:3].any()
    for robot, completion in enumerate(ended.completion.tolist()):
        assert completion < NEVER or robot in ended.broken | ended.cut_off
        if completion < NEVER:
            faults = Counter(fault.kind for fault in happened.faults if fault.robots == (robot,))
            assert not faults, happened
            assert completion >= int(ended.tracks[robot].enter[-1])
    assert all(np.all(np.diff(track.enter) > 0) for track in ended.tracks)
