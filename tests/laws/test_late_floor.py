"""The kernel of the late floor does what a floor does on which robots look before they drive."""

from __future__ import annotations

import random
from fractions import Fraction
from functools import cache

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.model import NEVER, Plan, Rules, Tick
from rightofway.precedence import ActionDependencyGraph, DelayModel, DelaySample, Execution
from tests.builders.fleets import random_fleet
from tests.oracles import late_floor

RULES = (
    Rules(),
    Rules(occupancy="both"),
    Rules(headway=Fraction(1)),
    Rules(occupancy="both", headway=Fraction(1, 2)),
    Rules(ends="none"),
    Rules(laps=2, occupancy="both"),
)
HAZARDS = (
    (),
    (("exponential", 0.5, 0.0),),
    (("uniform", -0.5, 1.0), ("chance", 0.1, 7.0)),
    (("normal", 0.2, 0.3), ("breaks", 0.1, 0.0)),
)


@cache
def some_plan(seed: int, rules: int) -> Plan:
    scenario = random_fleet(seed, size=5, robots=5, rules=RULES[rules])
    return rightofway.solve(scenario, "lacam" if seed % 2 else "two-level")


def some_hazards(draw: random.Random, robots: int, makespan: int) -> DelayModel:
    def standstills() -> tuple[tuple[Tick, Tick], ...]:
        if draw.random() < 0.6:
            return ()
        lasts = draw.choice([1, 5, 30, NEVER])
        more = [(draw.randint(0, makespan), draw.choice([1, 5, 30])) for _ in range(2)]
        every = sorted([(draw.randint(0, makespan), lasts), *more])
        return tuple((Tick(tick), Tick(ticks)) for tick, ticks in every)

    return DelayModel(
        random=draw.choice(HAZARDS),
        pace=tuple(draw.choice([1.0, 1.0, 1.7, 0.6]) for _ in range(robots)),
        standstills=tuple(standstills() for _ in range(robots)),
    )


def oracle_of(floor: ActionDependencyGraph, delay_sample: DelaySample) -> late_floor.Floor:
    return late_floor.Floor(
        first_visit=floor.first_visit.tolist(),
        vertex=floor.vertex.tolist(),
        planned=floor.planned.tolist(),
        nominal_drive=floor.drive.tolist(),
        before=floor.before.tolist(),
        since=floor.since.tolist(),
        headway=int(floor.scenario.problem.headway),
        books_ahead=floor.scenario.rules.books_ahead,
        dwell=delay_sample.dwell.tolist(),
        drive=delay_sample.drive.tolist(),
        standstills=[delay_sample.of(robot) for robot in range(len(floor.routes))],
    )


def times(happened: late_floor.Happened | Execution) -> tuple[list[int], list[int], list[int]]:
    return list(happened.enter), list(happened.start), list(happened.completion)


@given(
    seed=st.integers(0, 5), rules=st.integers(0, len(RULES) - 1), chance=st.integers(0, 2**32 - 1)
)
@settings(max_examples=150, deadline=None)
def test_the_kernel_equals_robots_that_look(seed: int, rules: int, chance: int) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    last = max(int(track.enter[-1]) for track in plan.tracks)
    hazards = some_hazards(draw, len(plan.tracks), last)
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, hazards)
    told = np.array([draw.choice([0, 0, 0, 12]) for _ in floor.vertex], np.int64)
    floor = floor.reordered(floor.before, told)
    delay_sample = floor.delay_sample(chance, 3)
    slow = oracle_of(floor, delay_sample)
    for clock, run in ((False, late_floor.by_right_of_way), (True, late_floor.by_clock)):
        found, expected = floor.execute(delay_sample, clock=clock), run(slow)
        assert times(found) == times(expected)
        assert tuple(found.collisions.tolist()) == late_floor.collisions(slow, expected)
        if not clock:
            assert not found.collisions[:3].any()
    assert floor.deadlocked() == []


@given(seed=st.integers(0, 5), rules=st.integers(0, 3), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_robots_in_a_wrong_order_deadlock_just_where_the_kernel_says(
    seed: int, rules: int, chance: int
) -> None:
    """Two visits next to each other at one vertex change places."""
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = DelayModel.none(len(plan.tracks))
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, hazards)
    firsts = set(floor.first_visit.tolist())
    swappable = [
        visit
        for visit, other in enumerate(floor.before.tolist())
        if other >= 0 and other not in firsts and floor.robot_of(other) != floor.robot_of(visit)
    ]
    if not swappable:
        return
    before = floor.before.copy()
    visit = draw.choice(swappable)
    other = int(before[visit])
    after = np.flatnonzero(before == visit)
    before[visit], before[other] = before[other], visit
    before[after] = other
    floor = floor.reordered(before)
    delay_sample = floor.delay_sample(0, 0)
    found, expected = (
        floor.execute(delay_sample),
        late_floor.by_right_of_way(oracle_of(floor, delay_sample)),
    )
    assert found.completion.tolist() == expected.completion
    stuck = [robot for robot, tick in enumerate(expected.completion) if tick >= NEVER]
    assert floor.deadlocked() == stuck


@given(seed=st.integers(0, 5), rules=st.integers(0, 3), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_runs_are_what_single_runs_are_however_they_are_cut_up(
    seed: int, rules: int, chance: int
) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = some_hazards(draw, len(plan.tracks), 20)
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, hazards)
    whole, second = floor.runs(chance, 0, 8), floor.runs(chance, 5, 3)
    assert np.array_equal(whole.completion[5:], second.completion)
    for run in range(8):
        delay_sample = floor.delay_sample(chance, run)
        one, clocked = floor.execute(delay_sample), floor.execute(delay_sample, clock=True)
        assert one.completion.tolist() == whole.completion[run].tolist()
        assert one.is_broken.tolist() == whole.is_broken[run].tolist()
        assert one.collisions.tolist() == whole.by_right_of_way[run].tolist()
        assert clocked.collisions.tolist() == whole.by_clock[run].tolist()


@given(seed=st.integers(0, 5), rules=st.integers(0, 5), chance=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_what_lateness_is_put_down_to_sums_up_to_it(seed: int, rules: int, chance: int) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = some_hazards(draw, len(plan.tracks), 20)
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, hazards)
    runs = floor.runs(chance, 0, 5)
    ends = floor.first_visit[1:] - 1
    late = runs.completion - floor.planned[ends] - floor.dwell[ends]
    expected = np.where(runs.completion < NEVER, np.maximum(late, 0), 0).sum()
    assert runs.own.sum() + runs.of_others.sum() == expected
    assert runs.between[:, 2].sum() == runs.of_others.sum()
