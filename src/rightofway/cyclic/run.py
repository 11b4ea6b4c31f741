"""Simulate a fleet that repeats its laps under one rule, until a state recurs or time is over."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from rightofway.cyclic.pattern import find_pattern
from rightofway.cyclic.result import CyclicResult, GroupResult
from rightofway.cyclic.rolling_horizon import RollingHorizon
from rightofway.cyclic.route import (
    ROUTES,
    GroupContext,
    make_cyclic_routes,
    split_groups,
    take_out_closed_places,
)
from rightofway.cyclic.rules import NATIVE_RULES, RULES
from rightofway.cyclic.simulator import CyclicSimulator, Deadlock
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import make_words
from rightofway.model import Scenario, require_time_limit
from rightofway.planners import Deadline
from rightofway.progress import log_progress

Simulation = CyclicSimulator | RollingHorizon
"""The simulation of a group under a lap rule."""


@checks_arguments
def run_laps(
    scenario: Scenario,
    rule: str = "first-come",
    *,
    routes: str = "clear",
    time_limit: float | None = 10,
    report: Callable[[Fact], None] = log_progress,
) -> CyclicResult:
    """Simulate repeated laps of all robots until the pattern of the fleet repeats.

    Parameters
    ----------
    scenario
        The problem; its number of laps is not used. The roadmap of the result has no places that
        are closed permanently from 0 on.
    rule
        The robot of two that goes first at a meeting: ``first-come``, ``fixed-order`` (the first in
        the scenario), ``least-loss`` (the robot that would lose the larger part of its lap) or
        ``two-level`` (as in the paper).
    routes
        The choice of round trips, for all laps: ``clear``, ``direct`` or ``shortest``; see
        `make_cyclic_routes`.
    time_limit
        Time limit [s]; None for no limit. Groups get shares by their size; open groups continue in
        the time left.
    report
        Receives sentences on progress.

    Returns
    -------
    CyclicResult
        One result for each independent group of robots.

    Raises
    ------
    InputError
        For an unknown rule, a time limit that is negative or no number, or a robot without a lap to
        repeat.
    NoPlanExists
        If a robot cannot reach a place.

    Notes
    -----
    Exact: a pattern is reported after a state has recurred, hence the pattern repeats permanently.
    A group without a recurrence within the limit is open. Deterministic below the limit. Where
    rules forbid rotations and robots of a group rotate, the group is simulated again, in the other
    half of the time, with a headway of one tick.
    """
    make_words(*RULES).read_at("rule", rule)
    make_words(*ROUTES).read_at("routes", routes)
    deadline = Deadline.after(require_time_limit(time_limit))
    scenario = take_out_closed_places(scenario)
    groups = split_groups(scenario, make_cyclic_routes(scenario, routes))
    contexts = [GroupContext(scenario=scenario, routes=tuple(group)) for group in groups]

    def simulate(chosen: Sequence[GroupContext], until: Deadline) -> list[GroupResult]:
        simulations = [make_simulation(context, rule) for context in chosen]
        return share_time(simulations, until, report)

    may_repeat = any(context.might_rotate for context in contexts)
    results = simulate(contexts, deadline.shorten(0.5) if may_repeat else deadline)
    rotating = [index for index, result in enumerate(results) if result.has_rotation()]
    apart = [replace(contexts[index], is_apart=True) for index in rotating]
    for index, result in zip(rotating, simulate(apart, deadline), strict=True):
        results[index] = result
    return CyclicResult(scenario=scenario, rule=rule, routes=routes, groups=tuple(results))


def make_simulation(context: GroupContext, rule: str) -> Simulation:
    """Return a new simulation of a group."""
    return CyclicSimulator(context, rule) if rule in NATIVE_RULES else RollingHorizon(context)


def share_time(
    simulations: Sequence[Simulation],
    deadline: Deadline,
    report: Callable[[Fact], None],
    *,
    least_share: float = 0.05,
) -> list[GroupResult]:
    """Advance all groups, small groups first; then open groups again until time is over.

    Each group gets a share of the time left by its size, at least the least share.
    """
    results: dict[int, GroupResult] = {}
    sizes = [len(simulation.context) for simulation in simulations]
    open_ones = sorted(range(len(simulations)), key=lambda index: sizes[index])
    while open_ones:
        left = sum(sizes[index] for index in open_ones)
        for index in open_ones:
            known = sum(simulation.ends != "open" for simulation in results.values())
            report(Fact("groups done", number=known, groups=len(simulations), robots=sizes[index]))
            share = deadline.shorten(max(sizes[index] / left, least_share))
            left -= sizes[index]
            results[index] = advance(simulations[index], share)
        open_ones = [index for index in open_ones if results[index].ends == "open"]
        if deadline.measure_seconds_left() == 0:
            break
    return [results[index] for index in range(len(simulations))]


def advance(simulation: Simulation, deadline: Deadline) -> GroupResult:
    """Continue until the pattern repeats, a deadlock, or the deadline; another call continues."""
    context = simulation.context
    try:
        recurrence = simulation.advance(deadline)
    except Deadlock as deadlock:
        return GroupResult(
            context=context,
            ends="deadlock",
            why=_describe_deadlock(deadlock, context),
            history=tuple(simulation.history),
        )
    except GaveUp:
        return GroupResult(
            context=context,
            ends="open",
            why=Fact("no state again"),
            history=tuple(simulation.history),
        )
    pattern = find_pattern(simulation.history, [len(lap) for lap in context.laps], recurrence)
    return GroupResult(context=context, ends="repeats", history=pattern.history, pattern=pattern)


def _describe_deadlock(deadlock: Deadlock, context: GroupContext) -> Fact:
    """Return the two robots that no waiting keeps apart, and the circle that a wait would close."""
    scenario, robots = context.scenario, context.robots
    first, second = (robots[position] for position in deadlock.robots)
    place = Fact("place at time", name=int(deadlock.vertex), what=int(deadlock.tick))
    pair = Fact("deadlock", scenario, one=first, other=second, place=place)
    if len(deadlock.circle) < 3:  # noqa: PLR2004 (the two themselves)
        return pair
    circle = tuple(robots[position] for position in deadlock.circle)
    return Fact("deadlock in a circle", scenario, deadlock=pair, robots=circle)
