"""Fleets that repeat their laps: results of rules, held against slow oracles and the judge."""

import random

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.cyclic import RULES, CyclicResult, plan_of, run_laps
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Rules
from rightofway.planners import planning_headway
from tests.builders.fleets import fleet_on, random_grid
from tests.oracles.laps import largest_mean_cycle_is, replay

every_rule = pytest.mark.parametrize("rule", RULES)

some_rules = st.sampled_from(
    [
        Rules(),
        Rules(headway=1),  # type: ignore[arg-type]
        Rules(occupancy="both"),
        Rules(rotations=False),
        Rules(headway=1, occupancy="both"),  # type: ignore[arg-type]
    ]
)

SLOW = 400
"""Visits in a period that the slow oracle is not asked for."""


def small_run(seed: int, rule: str, rules: Rules) -> CyclicResult | None:
    """Run a random fleet; None if a robot has nowhere to go."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    grid = random_grid(draw, size=draw.randint(4, 7), walls=0.15)
    try:
        scenario = fleet_on(grid, draw, robots=draw.randint(2, 5), rules=rules)
        return run_laps(scenario, rule, time_limit=2)
    except (InputError, NoPlanExists, ValueError):
        return None


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_what_repeats_is_the_timetable_of_its_own_orders(
    rule: str, seed: int, rules: Rules
) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None)
    assert run is not None
    for group in run.groups:
        timetable = group.timetable
        if timetable is None or sum(map(len, timetable.enter)) > SLOW:
            continue
        headway, books_ahead = planning_headway(run.scenario), rules.books_ahead
        times = replay(timetable, 5, headway=headway, books_ahead=books_ahead)
        for (robot, index, period), tick in times.items():
            first = int(timetable.enter[robot][index]) % timetable.period
            assert tick == first + period * timetable.period
        assert largest_mean_cycle_is(timetable, headway=headway, books_ahead=books_ahead)


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_judge_passes_whole_laps_unless_a_robot_at_home_is_in_the_way(
    rule: str, seed: int, rules: Rules
) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None and all(group.timetable for group in run.groups))
    assert run is not None
    try:
        plan = plan_of(run)
    except GaveUp:
        homes = {robot.home for robot in run.scenario.robots}
        laps = [lap for group in run.groups for lap in group.context.laps]
        assert any(homes.intersection(lap.vertices[1:]) for lap in laps)
    else:
        assert check(plan).ok


@every_rule
@settings(max_examples=60, deadline=None)
@example(seed=419, rules=Rules())  # a decision is taken back when a robot has waited for it
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_who_waits_for_whom_adds_up_to_no_more_than_the_time_lost(
    rule: str, seed: int, rules: Rules
) -> None:
    """What is missing was waited for nobody, by one that could have gone."""
    run = small_run(seed, rule, rules)
    assume(run is not None)
    assert run is not None
    for group in run.groups:
        for robot, laps, lap in zip(
            group.robots,
            group.pattern.counts if group.pattern else (),
            group.context.laps,
            strict=False,
        ):
            assert group.pattern is not None
            waits = sum(one.ticks for one in group.waits() if one.waits == robot)
            assert not laps or waits <= group.pattern.period - laps * lap.duration


@every_rule
@settings(max_examples=60, deadline=None)
@example(seed=304, rules=Rules(headway=1))  # type: ignore[arg-type]  # goes back to before a cut
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_period_by_theory_is_that_of_the_simulation(rule: str, seed: int, rules: Rules) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None)
    assert run is not None
    for group in run.groups:
        bottleneck = group.bottleneck()
        assert bottleneck is None or (
            group.pattern is not None and bottleneck.cycle_time == group.pattern.period
        )
