"""The execution kernel agrees with robots that look, tick by tick, before they drive."""

from __future__ import annotations

import random

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rightofway.model import NEVER
from rightofway.precedence import ActionDependencyGraph, DelayModel
from tests.builders.executions import RULES, oracle_of, some_delays, some_plan, times
from tests.oracles import execution


@given(
    seed=st.integers(0, 5), rules=st.integers(0, len(RULES) - 1), chance=st.integers(0, 2**32 - 1)
)
@settings(max_examples=150, deadline=None)
def test_the_kernel_equals_robots_that_look(seed: int, rules: int, chance: int) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    last = max(int(track.enter[-1]) for track in plan.tracks)
    delays = some_delays(draw, len(plan.tracks), last)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    since = np.array([draw.choice([0, 0, 0, 12]) for _ in adg.vertex], np.int64)
    adg = adg.reordered(adg.order, since)
    delay_sample = adg.delay_sample(chance, 3)
    slow = oracle_of(adg, delay_sample)
    for clock, run in ((False, execution.by_right_of_way), (True, execution.by_clock)):
        found, expected = adg.execute(delay_sample, clock=clock), run(slow)
        assert times(found) == times(expected)
        assert tuple(found.collisions.tolist()) == execution.collisions(slow, expected)
        if not clock:
            assert not found.collisions[:3].any()
    assert adg.deadlocked() == []


@given(seed=st.integers(0, 5), rules=st.integers(0, 3), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_robots_in_a_wrong_order_deadlock_just_where_the_kernel_says(
    seed: int, rules: int, chance: int
) -> None:
    """Two visits next to each other at one vertex change places."""
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    delays = DelayModel.none(len(plan.tracks))
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    firsts = set(adg.first_visit.tolist())
    swappable = [
        visit
        for visit, other in enumerate(adg.order.tolist())
        if other >= 0 and other not in firsts and adg.robot_of(other) != adg.robot_of(visit)
    ]
    if not swappable:
        return
    before = adg.order.copy()
    visit = draw.choice(swappable)
    other = int(before[visit])
    after = np.flatnonzero(before == visit)
    before[visit], before[other] = before[other], visit
    before[after] = other
    adg = adg.reordered(before)
    delay_sample = adg.delay_sample(0, 0)
    found, expected = (
        adg.execute(delay_sample),
        execution.by_right_of_way(oracle_of(adg, delay_sample)),
    )
    assert found.completion.tolist() == expected.completion
    stuck = [robot for robot, tick in enumerate(expected.completion) if tick >= NEVER]
    assert adg.deadlocked() == stuck


@given(seed=st.integers(0, 5), rules=st.integers(0, 3), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_runs_are_what_single_runs_are_however_they_are_cut_up(
    seed: int, rules: int, chance: int
) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    delays = some_delays(draw, len(plan.tracks), 20)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    whole, second = adg.runs(chance, 0, 8), adg.runs(chance, 5, 3)
    assert np.array_equal(whole.completion[5:], second.completion)
    for run in range(8):
        delay_sample = adg.delay_sample(chance, run)
        one, clocked = adg.execute(delay_sample), adg.execute(delay_sample, clock=True)
        assert one.completion.tolist() == whole.completion[run].tolist()
        assert one.is_broken.tolist() == whole.is_broken[run].tolist()
        assert one.collisions.tolist() == whole.by_right_of_way[run].tolist()
        assert clocked.collisions.tolist() == whole.by_clock[run].tolist()


@given(seed=st.integers(0, 5), rules=st.integers(0, 5), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_what_lateness_is_put_down_to_sums_up_to_it(seed: int, rules: int, chance: int) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    delays = some_delays(draw, len(plan.tracks), 20)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    runs = adg.runs(chance, 0, 5)
    ends = adg.first_visit[1:] - 1
    late = runs.completion - adg.planned[ends] - adg.dwell[ends]
    expected = np.where(runs.completion < NEVER, np.maximum(late, 0), 0).sum()
    assert runs.own.sum() + runs.of_others.sum() == expected
    assert runs.between[:, 2].sum() == runs.of_others.sum()
