"""Plans from a cyclic result: whole laps for the judge, or some periods for a page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil

import numpy as np

from rightofway.check import check
from rightofway.cyclic.bottleneck import begin_with_longest_run
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import CyclicResult, GroupResult
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import allow_none, make_whole
from rightofway.model import Plan, PlannerRun, Status, SteadyState, Track
from rightofway.precedence import TimedEventGraph

MOST_LAPS = 10**6
"""Laps of each robot that a plan may be asked for."""


@checks_arguments
def plan_of_laps(result: CyclicResult, laps: int | None = None) -> Plan:
    """Turn a cyclic result into a plan that the judge has passed.

    Parameters
    ----------
    result
        The result of `run_laps` or `find_best_timetable`.
    laps
        Laps of each robot. If None, laps completed by the end of one period after the transient of
        each group, or by the end of the history of an open group.

    Returns
    -------
    Plan
        Each robot makes whole laps and then stays at home.

    Raises
    ------
    GaveUp
        If the history ends before a robot has made its laps, or a robot at home after its last lap
        blocks other robots.
    """
    plan = unroll_laps(result, allow_none(make_whole(1, MOST_LAPS)).read_at("laps", laps))
    report = check(plan)
    if not report.ok:
        raise GaveUp(Fact("laps without a plan", fault=report.faults[0]))
    return plan


def unroll_laps(result: CyclicResult, laps: int | None = None) -> Plan:
    """Return the plan that `plan_of_laps` judges; robots at home may block other robots.

    Raises
    ------
    GaveUp
        If a robot's history ends before its laps.
    """
    patterns = [group.pattern for group in result.groups if group.pattern]
    ends = [max(past[-1] for past in group.history) for group in result.groups if not group.pattern]
    if patterns:
        ends.append(max(pattern.transient + 2 * pattern.period for pattern in patterns))
    until = min(ends)

    def laps_and_visits(group: GroupResult, index: int, n_laps: int) -> tuple[int, int]:
        robot, moves = group.robots[index], _is_moving(group, index)
        own = laps or max(_count_laps_until(group, index, until, None if moves else n_laps), 1)
        if not group.pattern and own > n_laps:
            raise GaveUp(Fact("laps not followed", result.scenario, robot=robot, laps=own))
        if group.pattern and not moves:
            raise GaveUp(Fact("robot without laps", result.scenario, robot=robot))
        return own, own * len(group.context.routes[index]) + 1

    return _plan(result, Status("whole laps"), laps_and_visits)


def make_excerpt(
    result: CyclicResult, periods: int = 4, *, most_visits: int = 200_000
) -> tuple[Plan, tuple[SteadyState, ...]]:
    """Return some periods of a cyclic result for display on a page.

    Parameters
    ----------
    result
        The result of `run_laps` or `find_best_timetable`.
    periods
        Number of periods (longest mean laps, if open) of the group with the longest time for them.
    most_visits
        Approximate maximum number of visits of all robots, which limits the time.

    Returns
    -------
    plan, steady
        The plan holds whole laps of each robot beyond this time, so that no robot stays at home
        before; a robot that is permanently stuck makes no further visits. After this time, bookings
        may conflict: the plan is for display only. The steady state of each group that repeats has
        its first tick and its bottleneck.

    Raises
    ------
    GaveUp
        If the history of a robot holds no whole lap.
    """
    until, visits_per_tick = 0, Fraction(0)
    for group in result.groups:
        means, pattern = [mean or Fraction(1) for mean in group.compute_mean_laps()], group.pattern
        end = pattern.transient + periods * pattern.period if pattern else periods * max(means)
        until = max(until, ceil(end))
        rows = zip(group.context.routes, group.compute_mean_laps(), strict=True)
        visits_per_tick += sum(Fraction(len(route)) / mean for route, mean in rows if mean)
    if visits_per_tick:
        until = min(until, int(most_visits / visits_per_tick))

    def laps_and_visits(group: GroupResult, index: int, laps: int) -> tuple[int, int]:
        if group.ends == "deadlock" or (group.pattern and not _is_moving(group, index)):
            return laps + 1, len(group.history[index])
        if not group.pattern and not laps:
            robot = group.robots[index]
            raise GaveUp(Fact("lap not followed", result.scenario, robot=robot))
        most = None if group.pattern else laps - 1
        own = _count_laps_until(group, index, until, most) + 1
        return own, own * len(group.context.routes[index]) + 1

    plan = _plan(result, Status("excerpt of laps", rule=result.rule), laps_and_visits)
    return plan, tuple(
        _make_steady_state(group, group.pattern, plan) for group in result.groups if group.pattern
    )


def _is_moving(group: GroupResult, index: int) -> bool:
    """Return whether a robot makes laps for ever."""
    return group.pattern is not None and group.pattern.counts[index] > 0


def _count_laps_until(group: GroupResult, index: int, until: int, most: int | None) -> int:
    """Return the number of laps that a robot completes by a tick, and the maximum."""
    pattern, past = group.pattern, group.history[index]
    length, laps = len(group.context.routes[index]), 0
    while most is None or laps < most:
        visit = (laps + 1) * length
        if (pattern.enter(index, visit) if pattern and most is None else past[visit]) > until:
            break
        laps += 1
    return laps


def _plan(
    result: CyclicResult,
    status: Status,
    laps_and_visits: Callable[[GroupResult, int, int], tuple[int, int]],
) -> Plan:
    """Return a plan with some laps and visits of each robot, by group, index and laps made."""
    robots, tracks = list(result.scenario.robots), dict[int, Track]()
    for group in result.groups:
        for index, (robot, n_laps) in enumerate(zip(group.robots, group.count_laps(), strict=True)):
            laps, n_visits = laps_and_visits(group, index, n_laps)
            robots[robot] = replace(robots[robot], laps=laps)
            if group.pattern and _is_moving(group, index):
                enter = group.pattern.enters(index, range(n_visits))
            else:
                enter = np.array(group.history[index][:n_visits], np.int64)
            vertices = np.array(group.context.laps[index].vertices, np.int32)
            tracks[robot] = Track(vertices=np.resize(vertices, n_visits), enter=enter)
    return Plan(
        scenario=replace(result.scenario, robots=tuple(robots)),
        tracks=tuple(tracks[robot] for robot in range(len(robots))),
        run=PlannerRun(
            name="laps", options={"rule": result.rule, "routes": result.routes}, status=status
        ),
    )


def _make_steady_state(group: GroupResult, pattern: Pattern, plan: Plan) -> SteadyState:
    """Return the steady state of a group, with critical visits if the plan has all of them."""
    critical = _list_critical_visits(group, pattern)
    rows = zip(group.robots, pattern.counts, strict=True)
    held = all(index < len(plan.tracks[robot]) for robot, index in critical)
    return SteadyState(
        robots=tuple(robot for robot, laps in rows if laps),
        start=pattern.transient,
        period=pattern.period,
        critical=critical if held else (),
    )


def _list_critical_visits(group: GroupResult, pattern: Pattern) -> tuple[tuple[int, int], ...]:
    """Return the visits of the critical circuit; none if the period exceeds the cycle time."""
    graph = group.build_graph()
    if graph is None:
        return ()
    circuit = graph.find_critical_circuit()
    if circuit.cycle_time != pattern.period:
        return ()
    return list_visits_along(group, pattern, graph, circuit.arcs.tolist())


def list_visits_along(
    group: GroupResult, pattern: Pattern, graph: TimedEventGraph, circuit: Sequence[int]
) -> tuple[tuple[int, int], ...]:
    """Return the visits of a circuit: robot, and index of the visit in each plan of the result.

    Parameters
    ----------
    group, pattern, graph
        A group that repeats, its pattern and its graph.
    circuit
        Numbers of arcs of the graph, in order.
    """
    arcs = begin_with_longest_run(graph, list(circuit))
    visits = graph.arcs.tail[arcs].tolist()
    firsts = [
        pattern.list_visits(robot).start - int(graph.first[robot])
        for robot in range(len(group.robots))
    ]
    return tuple(
        (group.robots[robot], firsts[robot] + visit)
        for robot, visit in zip(graph.robot[visits].tolist(), visits, strict=True)
    )
