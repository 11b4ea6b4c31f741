"""A stretch of a simulation, closed by orders or by a seam, keeps every rule and loses little."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import islice

import pytest
from hypothesis import reject
from hypothesis import strategies as st

from rightofway.cyclic import run_laps
from rightofway.cyclic.closing import Stretch, close_stretch, close_windows, find_stretches
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.problem import CyclicProblem
from rightofway.cyclic.result import GroupResult
from rightofway.cyclic.route import GroupContext, make_cyclic_routes, split_groups
from rightofway.cyclic.run import advance
from rightofway.cyclic.simulator import CyclicSimulator
from rightofway.errors import InputError, NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.planners import Deadline
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.fleets import random_fleet
from tests.builders.laws import law, leave
from tests.oracles import periodic_bookings as oracle
from tests.oracles import periodic_space

RULES = [Rules(), Rules(headway=Fraction(2)), Rules(occupancy="both"), Rules(rotations=False)]
PERIODS = 6
"""How many periods of a pattern the history of an open group holds."""

LAPS = 20
"""How many of the longest laps the history of a long run holds at least."""


def bind_problem(run: GroupResult) -> CyclicProblem:
    """Return the problem of a group without other laps, other groups and weights."""
    return CyclicProblem(
        context=run.context,
        ways=tuple((lap,) for lap in run.context.laps),
        round_trips=(),
        forbidden=frozenset(),
        weights=(Fraction(1),) * len(run.context),
        least_fairness=Fraction(0),
        deadline=Deadline(),
        draw=random.Random(0),  # noqa: S311 (no secret depends on it)
    )


@st.composite
def fleets(draw: st.DrawFn, most_robots: int = 4) -> Scenario:
    return random_fleet(
        draw(st.integers(0, 10**6)),
        size=draw(st.integers(4, 6)),
        robots=draw(st.sampled_from((*range(3, most_robots + 1), *range(2, most_robots + 1)))),
        rules=draw(st.sampled_from(RULES)),
        apart=True,
    )


def open_run(scenario: Scenario) -> tuple[GroupResult, Pattern]:
    """Return the largest group first come first served, as if its end were open."""
    run = max(run_laps(scenario, time_limit=None).groups, key=lambda group: len(group.context))
    pattern = run.pattern
    if len(run.context) == 1 or pattern is None or not all(pattern.counts):
        leave("no several robots that all make laps")
    history = tuple(
        tuple(
            pattern.enter(robot, visit)
            for visit in range((regular // length + PERIODS * count) * length + 1)
        )
        for robot, (length, count, regular) in enumerate(
            zip(pattern.lengths, pattern.counts, pattern.regular, strict=True)
        )
    )
    return replace(run, ends="open", history=history, pattern=None), pattern


@law(fleets())
def test_closed_windows_keep_every_rule_across_the_seam(scenario: Scenario) -> None:
    run, _ = open_run(scenario)
    problem, context = bind_problem(run), run.context
    # the oracle compares every two visits
    short = (window for window in close_windows(problem, run) if window.n_visits <= 150)
    for window in islice(short, 4):
        timetable = problem.join_cycles(problem.book(window)[1], window.period)
        ahead = context.booking_rules.books_ahead
        assert (
            oracle.faults(timetable, headway=context.booking_rules.headway, books_ahead=ahead) == []
        )


@law(fleets())
def test_the_best_window_is_not_below_the_run_in_the_long_run(scenario: Scenario) -> None:
    run, pattern = open_run(scenario)
    problem = bind_problem(run)
    best = max(map(problem.compute_value, close_windows(problem, run)), default=Fraction(0))
    assert best >= Fraction(sum(pattern.counts), pattern.period)


def long_run_of(
    scenario: Scenario, connections: str = "clear", rule: str = "first-come"
) -> GroupResult | None:
    """Return a run of the largest group, None where a robot is alone or makes no laps."""
    try:
        routes = make_cyclic_routes(scenario, connections)
    except (InputError, NoPlanExists):
        return None
    group = max(split_groups(scenario, routes), key=len)
    context = GroupContext(scenario=scenario, routes=tuple(group))
    simulation = CyclicSimulator(context, rule)
    run = advance(simulation, Deadline())
    while run.ends == "repeats" and max(past[-1] for past in run.history) < LAPS * context.longest:
        simulation.reset_states()
        run = advance(simulation, Deadline())
    makes_laps = len(group) > 1 and run.ends == "repeats" and all(run.compute_mean_laps())
    return run if makes_laps else None


@st.composite
def long_runs(draw: st.DrawFn) -> GroupResult:
    """Draw a long run of the largest group of a small fleet."""
    ways = st.sampled_from(["clear", "direct"])
    rules = st.sampled_from(["first-come", "least-loss"])
    return laps_of(long_run_of(draw(fleets(6)), draw(ways), draw(rules)))


def laps_of(run: GroupResult | None) -> GroupResult:
    """Return a run, and have Hypothesis draw again where there is none."""
    return run if run is not None else reject()


@law(long_runs(), st.integers(3, 15), st.integers(1, 3))
def test_a_closed_stretch_keeps_every_rule_across_the_seam(
    run: GroupResult, laps: int, begins: int
) -> None:
    problem, context = bind_problem(run), run.context
    stretch = Stretch(begins=begins * context.longest, period=laps * context.longest)
    if stretch.begins + stretch.period > max(past[-1] for past in run.history):
        leave("a stretch beyond the run")
    closed = close_stretch(problem, run, stretch)
    if closed is None:
        leave("a stretch that cannot be closed")
    timetable = closed.timetable
    assert timetable.period == stretch.period
    graph = problem.build_graph(timetable)
    assert graph.compute_slack().min() >= 0
    assert not graph.has_swaps()
    if sum(map(len, timetable.enter)) <= 400:  # the oracle compares every two visits
        ahead = context.booking_rules.books_ahead
        assert (
            oracle.faults(timetable, headway=context.booking_rules.headway, books_ahead=ahead) == []
        )


def test_a_stretch_in_which_a_robot_makes_no_lap_cannot_be_closed() -> None:
    run = long_run_of(random_fleet(22, size=4, robots=6, rules=RULES[2], apart=True))
    assert run is not None
    longest = run.context.longest
    stretch = Stretch(begins=longest, period=4 * longest)
    assert close_stretch(bind_problem(run), run, stretch) is None


@law(long_runs())
def test_the_value_of_a_stretch_is_a_bound(run: GroupResult) -> None:
    problem = bind_problem(run)
    for value, stretch in find_stretches(problem, run)[:2]:
        closed = close_stretch(problem, run, stretch)
        if closed is not None:
            assert float(problem.compute_value(closed)) <= value + 1e-9
            assert value <= problem.bound + Fraction(1, 10**9)


any_fleets = any_fleet(robots=(2, 3), without=LAPS_REFUSE, always={"sizes", "both"}, apart=True)


@pytest.mark.slow
@law(any_fleets.map(long_run_of).map(laps_of))
def test_closings_of_any_fleet_keep_every_rule_across_the_seam(run: GroupResult) -> None:
    """Windows closed by their orders, and stretches closed at a seam."""
    context = run.context
    problem = bind_problem(run)
    short = (window for window in close_windows(problem, run) if window.n_visits <= 150)
    closed = [
        problem.join_cycles(problem.book(window)[1], window.period) for window in islice(short, 3)
    ]
    for laps in (5, 9):
        stretch = Stretch(begins=context.longest, period=laps * context.longest)
        if stretch.begins + stretch.period <= min(past[-1] for past in run.history):
            found = close_stretch(problem, run, stretch)
            closed += [] if found is None else [found.timetable]
    for timetable in closed:
        assert problem.build_graph(timetable).compute_slack().min() >= 0
        cycles = periodic_space.cycles_of(timetable)
        assert not periodic_space.conflicts(context.scenario, cycles, int(timetable.period))
