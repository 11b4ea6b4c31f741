"""A window of a run closes to a timetable that keeps every rule, and loses next to nothing."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import islice

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rightofway.cyclic import run_laps
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.problem import CyclicProblem
from rightofway.cyclic.result import GroupRun
from rightofway.cyclic.windows import windows
from rightofway.model import Rules, Scenario
from rightofway.planners import Deadline, planning_headway
from tests.builders.fleets import random_fleet
from tests.oracles import periodic_bookings as oracle

law = settings(max_examples=30, derandomize=True, deadline=None)
RULES = [Rules(), Rules(headway=Fraction(2)), Rules(occupancy="both"), Rules(rotations=False)]
PERIODS = 6
"""How many periods of a pattern are watched."""

MOST_VISITS = 150
"""The judge looks at every two visits."""


def watched(scenario: Scenario) -> tuple[GroupRun, Pattern]:
    """Return what the largest group does first come first served, as if its end were open."""
    assume(all(robot.stops[0].at != robot.home for robot in scenario.robots))
    groups = run_laps(scenario, "first-come", time_limit=None).groups
    run = max(groups, key=lambda group: len(group.group))
    assume(len(run.group) > 1)
    assume(run.pattern is not None and all(run.pattern.counts))
    pattern = run.pattern
    assert pattern is not None
    history = tuple(
        tuple(
            pattern.enter(robot, visit)
            for visit in range((regular // length + PERIODS * count) * length + 1)
        )
        for robot, (length, count, regular) in enumerate(
            zip(pattern.lengths, pattern.counts, pattern.regular, strict=True)
        )
    )
    return replace(run, ends="open", why="", history=history, pattern=None), pattern


def shift_of(scenario: Scenario, run: GroupRun) -> CyclicProblem:
    return CyclicProblem(
        n_vertices=scenario.roadmap.n_vertices,
        headway=planning_headway(scenario),
        books_ahead=scenario.rules.books_ahead,
        robots=run.robots,
        ways=tuple((endless.lap,) for endless in run.group),
        tours=(),
        forbidden=frozenset(),
        weights=(Fraction(1),) * len(run.group),
        least_fairness=Fraction(0),
        deadline=Deadline(),
        draw=random.Random(0),  # noqa: S311 (no secret depends on it)
    )


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    return random_fleet(
        draw(st.integers(0, 10**6)),
        size=draw(st.integers(4, 7)),
        robots=draw(st.integers(2, 4)),
        rules=draw(st.sampled_from(RULES)),
    )


@law
@given(fleets())
def test_closed_windows_keep_every_rule_round_the_seam(scenario: Scenario) -> None:
    run, _ = watched(scenario)
    shift = shift_of(scenario, run)
    short = (window for window in windows(shift, run) if window.visits <= MOST_VISITS)
    for window in islice(short, 4):
        works = shift.on_circle(window)[1]
        timetable = shift.timetable(works, window.period)
        faults = oracle.faults(
            timetable, headway=shift.headway, books_ahead=scenario.rules.books_ahead
        )
        assert faults == []


@law
@given(fleets())
def test_the_best_window_is_not_below_the_run_in_the_long_run(scenario: Scenario) -> None:
    run, pattern = watched(scenario)
    shift = shift_of(scenario, run)
    best = max(map(shift.value, windows(shift, run)), default=Fraction(0))
    assert best >= Fraction(sum(pattern.counts), pattern.period)
