"""Fleets that repeat their work: what is said of ever after, held against slow and other judges."""

import random
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.errors import InputError, NoPlanExists
from rightofway.laps import RULES, LapsRun, run_laps
from rightofway.laps.plan import whole_laps
from rightofway.model import Rules, Scenario
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


def small_run(seed: int, rule: str, rules: Rules) -> LapsRun | None:
    """Run a random fleet; None if it has no laps."""
    draw = random.Random(seed)
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
    for group in run.groups if run else ():
        timetable = group.timetable
        if timetable is None:
            continue
        how = {"headway": planning_headway(run.scenario), "books_ahead": rules.books_ahead}
        for (robot, index, period), tick in replay(timetable, 5, **how).items():
            first = int(timetable.enter[robot][index]) % timetable.period
            assert tick == first + period * timetable.period
        assert largest_mean_cycle_is(timetable, **how)


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_judge_finds_no_fault_until_a_robot_stays_at_home(
    rule: str, seed: int, rules: Rules
) -> None:
    run = small_run(seed, rule, rules)
    if run is None or any(group.ends != "repeats" for group in run.groups):
        return
    if not all(all(group.pattern.counts) for group in run.groups if group.pattern):
        return
    plan = whole_laps(run)
    stays = min(int(track.enter[-1]) for track in plan.tracks)
    assert all(fault.tick >= stays for fault in check(plan).faults)
