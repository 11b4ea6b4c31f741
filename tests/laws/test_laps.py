"""Fleets that repeat their work: what is said of ever after, held against slow and other judges."""

import random

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.cyclic import ROUTES, RULES, CyclicResult, CyclicRoute, cyclic_routes, run_laps
from rightofway.cyclic.backjumping import Deadlock
from rightofway.cyclic.groups import independent_groups
from rightofway.cyclic.native_rules import Native
from rightofway.cyclic.pattern import pattern_of
from rightofway.cyclic.rolling_horizon import Rolling
from rightofway.cyclic.rules import FAR_SIGHTED
from rightofway.cyclic.to_plan import whole_laps
from rightofway.cyclic.window import Ground
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.planners import Deadline, Task, planning_headway
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


def small_fleet(seed: int, rules: Rules) -> Scenario | None:
    """Return a random fleet; None if a robot has nowhere to go."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    grid = random_grid(draw, size=draw.randint(4, 7), walls=0.15)
    try:
        scenario = fleet_on(grid, draw, robots=draw.randint(2, 5), rules=rules)
        cyclic_routes(scenario)
    except (InputError, NoPlanExists, ValueError):
        return None
    return scenario


def small_run(seed: int, rule: str, rules: Rules) -> CyclicResult | None:
    """Run a random fleet; None if it has no laps."""
    scenario = small_fleet(seed, rules)
    return None if scenario is None else run_laps(scenario, rule, time_limit=2)


def ground_of(scenario: Scenario, group: list[CyclicRoute]) -> Ground:
    """Return a group at the beginning."""
    return Ground(
        task=Task(scenario=scenario, options={"swaps": "resolve"}),
        group=group,
        headway=planning_headway(scenario),
        books_ahead=scenario.rules.books_ahead,
    )


def going_on(scenario: Scenario, group: list[CyclicRoute], rule: str) -> Rolling | Native:
    """Return what goes on by a rule."""
    ground = ground_of(scenario, group)
    return Rolling(ground, rule) if rule in FAR_SIGHTED else Native(ground, rule)


def told(going: Rolling | Native) -> tuple[int, int] | Deadlock | None:
    """Return what comes of it: two ticks with one state, a deadlock, or None if it takes long."""
    try:
        return going.until_it_repeats(Deadline.after(2))
    except Deadlock as deadlock:
        return deadlock
    except GaveUp:
        return None


@pytest.mark.parametrize("rule", sorted(RULES.keys() - FAR_SIGHTED))
@settings(max_examples=150, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_the_kernel_decides_as_one_window_after_the_other_does(
    rule: str, seed: int, rules: Rules
) -> None:
    """On crowded floors: many go back, some to before a cut, and many end in a deadlock."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    grid = random_grid(draw, size=draw.randint(3, 7), walls=0.1)
    try:
        scenario = fleet_on(grid, draw, robots=draw.randint(2, 10), rules=rules)
        groups = independent_groups(cyclic_routes(scenario, draw.choice(ROUTES)))
    except (InputError, NoPlanExists, ValueError):
        assume(False)
    for group in groups:
        slow, fast = Rolling(ground_of(scenario, group), rule), going_on(scenario, group, rule)
        expected, found = told(slow), told(fast)
        if expected is None or found is None:
            continue
        if isinstance(expected, Deadlock):
            assert isinstance(found, Deadlock)
            assert vars(found) == vars(expected)
        else:
            assert found == expected
        assert [list(past) for past in fast.history] == [list(past) for past in slow.history]


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
        for robot, laps, endless in zip(
            group.robots, group.pattern.counts if group.pattern else (), group.group, strict=False
        ):
            assert group.pattern is not None
            waits = sum(one.ticks for one in run.conflicts(group) if one.waits == robot)
            assert not laps or waits <= group.pattern.period - laps * endless.lap.duration


@every_rule
@settings(max_examples=60, deadline=None)
@example(seed=304, rules=Rules(headway=1))  # type: ignore[arg-type]  # goes back to before a cut
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


@every_rule
@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 2**32), rules=some_rules)
def test_what_comes_after_is_what_was_foretold(rule: str, seed: int, rules: Rules) -> None:
    """The rule goes on deciding, without knowing that a state has come again."""
    scenario = small_fleet(seed, rules)
    assume(scenario is not None)
    assert scenario is not None
    for group in independent_groups(cyclic_routes(scenario)):
        rolling = going_on(scenario, group, rule)
        try:
            known = rolling.until_it_repeats(Deadline.after(2))
            pattern = pattern_of(rolling.history, [len(endless.lap) for endless in group], known)
            rolling.forget()
            rolling.until_it_repeats(Deadline.after(2))
        except (Deadlock, GaveUp):
            continue
        for robot, past in enumerate(rolling.history):
            known_visits = len(pattern.history[robot])
            if pattern.counts[robot]:
                assert list(past[known_visits:]) == [
                    pattern.enter(robot, visit) for visit in range(known_visits, len(past))
                ]
            else:
                assert len(past) == known_visits
