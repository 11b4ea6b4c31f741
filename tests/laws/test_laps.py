"""Fleets that repeat their work: what is said of ever after, held against slow and other judges."""

import random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.errors import InputError, NoPlanExists
from rightofway.laps import RULES, LapsRun, run_laps
from rightofway.laps.plan import whole_laps
from rightofway.model import Rules
from rightofway.planners import planning_headway
from tests.fleets import fleet_on, random_grid
from tests.oracles.laps import largest_mean_cycle_is, replay

every_rule = pytest.mark.parametrize("rule", RULES)

some_rules = st.sampled_from(
    [
        Rules(),
        Rules(headway=1),  # type: ignore[arg-type]
        Rules(occupancy="both"),
        Rules(rotations=False),
    ]
)


SLOW = 400
"""Visits in a period that the slow oracle is not asked for."""


def small_run(seed: int, rule: str, rules: Rules) -> LapsRun | None:
    """Run a random fleet; None if it has no laps."""
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
def test_the_judge_finds_no_fault_until_a_robot_stays_at_home(
    rule: str, seed: int, rules: Rules
) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None and all(group.timetable for group in run.groups))
    assert run is not None
    plan = whole_laps(run)
    stays = min(int(track.enter[-1]) for track in plan.tracks)
    assert all(fault.tick >= stays for fault in check(plan).faults)


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_who_waits_for_whom_adds_up_to_the_time_lost(rule: str, seed: int, rules: Rules) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None)
    assert run is not None
    for group in run.groups:
        for robot, laps, endless in zip(
            group.robots, group.pattern.counts if group.pattern else (), group.group, strict=False
        ):
            assert group.pattern is not None
            waits = sum(one.ticks for one in run.conflicts(group) if one.waits == robot)
            assert not laps or waits == group.pattern.period - laps * endless.lap.duration


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_period_by_theory_is_that_of_the_simulation(rule: str, seed: int, rules: Rules) -> None:
    run = small_run(seed, rule, rules)
    assume(run is not None)
    assert run is not None
    for group in run.groups:
        bottleneck = run.bottleneck(group)
        assert bottleneck is None or (
            group.pattern is not None and bottleneck.cycle_time == group.pattern.period
        )
