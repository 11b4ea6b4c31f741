"""A cyclic result as a plan: of whole laps that the judge passes, or of some periods for a page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from math import ceil

from rightofway.check import check
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import CyclicResult, GroupResult
from rightofway.errors import GaveUp
from rightofway.model import Plan, PlannerRun, SteadyState, Track

__all__ = ["excerpt", "plan_of", "whole_laps"]


def plan_of(result: CyclicResult, laps: int | None = None) -> Plan:
    """Turn a cyclic result into a plan that the judge has passed.

    Parameters
    ----------
    result
        The result of `run_laps` or `best_timetable`.
    laps
        How many laps each robot makes. If None, as many as it completes until the transient and
        one more period of each group are over, or until the history of an open group ends.

    Returns
    -------
    Plan
        Each robot makes whole laps and then stays at home.

    Raises
    ------
    GaveUp
        If there is no such plan: the history ends before a robot has made its laps, or a robot that
        has finished its last lap stands in the way of others.
    """
    plan = whole_laps(result, laps)
    report = check(plan)
    if not report.ok:
        raise GaveUp(
            "whole laps make no plan here, as a robot that is home for the last time stays there:"
            f" {report.faults[0].message}"
        )
    return plan


def whole_laps(result: CyclicResult, laps: int | None = None) -> Plan:
    """Return the plan that `plan_of` has judged; robots at home may be in the way of others.

    Raises
    ------
    GaveUp
        If the history of a robot ends before it has made its laps.
    """
    patterns = [group.pattern for group in result.groups if group.pattern]
    ends = [max(past[-1] for past in group.history) for group in result.groups if not group.pattern]
    if patterns:
        ends.append(max(pattern.transient + 2 * pattern.period for pattern in patterns))
    until, n_laps, tracks = min(ends), {}, {}
    for group in result.groups:
        rows = zip(group.robots, group.context.names, group.laps_made(), strict=True)
        for index, (robot, name, made) in enumerate(rows):
            moves = _moves(group, index)
            own = laps or max(_laps_until(group, index, until, None if moves else made), 1)
            if not group.pattern and own > made:
                raise GaveUp(f"{name} was not followed for {own} laps")
            if group.pattern and not moves:
                raise GaveUp(f"{name} waits for ever (choose another rule)")
            n_laps[robot] = own
            tracks[robot] = _track(group, index, own * len(group.context.routes[index]) + 1)
    return _plan(result, n_laps, tracks, "whole laps")


def excerpt(
    result: CyclicResult, periods: int = 4, *, most_visits: int = 200_000
) -> tuple[Plan, tuple[SteadyState, ...]]:
    """Return some periods of a cyclic result, as a page shows them.

    Parameters
    ----------
    result
        The result of `run_laps` or `best_timetable`.
    periods
        How many periods (or longest mean laps, if open) of the group that needs most time for them.
    most_visits
        The time is cut so that all robots together make about as many visits at most.

    Returns
    -------
    plan, steady
        The plan holds whole laps of each robot beyond that time, so that no robot stays at home
        before; a robot that stands still for ever makes no more visits. Later robots may be in
        each other's way: the plan is for display only. The steady states tell for each group that
        repeats from when on it does, and its bottleneck.

    Raises
    ------
    GaveUp
        If the history of a robot holds no whole lap.
    """
    until, visits_per_tick = 0, Fraction(0)
    for group in result.groups:
        means, pattern = [mean or Fraction(1) for mean in group.mean_laps()], group.pattern
        end = pattern.transient + periods * pattern.period if pattern else periods * max(means)
        until = max(until, ceil(end))
        visits_per_tick += sum(map(Fraction, map(len, group.context.routes), means))
    until = min(until, int(most_visits / visits_per_tick))
    n_laps, tracks = {}, {}
    for group in result.groups:
        rows = zip(group.robots, group.context.names, group.laps_made(), strict=True)
        for index, (robot, name, made) in enumerate(rows):
            if group.ends == "deadlock" or (group.pattern and not _moves(group, index)):
                n_visits = len(group.history[index])
                n_laps[robot], tracks[robot] = made + 1, _track(group, index, n_visits)
                continue
            if not group.pattern and not made:
                raise GaveUp(f"{name} was not followed for a whole lap (allow more time)")
            most = None if group.pattern else made - 1
            n_laps[robot] = _laps_until(group, index, until, most) + 1
            n_visits = n_laps[robot] * len(group.context.routes[index]) + 1
            tracks[robot] = _track(group, index, n_visits)
    plan = _plan(result, n_laps, tracks, result.rule)
    return plan, tuple(
        _steady_state(group, group.pattern, plan) for group in result.groups if group.pattern
    )


def _moves(group: GroupResult, index: int) -> bool:
    """Whether a robot makes laps for ever."""
    return group.pattern is not None and group.pattern.counts[index] > 0


def _enter(group: GroupResult, index: int) -> Callable[[int], int]:
    """Return the function from a robot's visits to their enters."""
    pattern = group.pattern
    if pattern is not None and pattern.counts[index]:
        return lambda visit: pattern.enter(index, visit)
    return group.history[index].__getitem__


def _laps_until(group: GroupResult, index: int, until: int, most: int | None) -> int:
    """Return how many laps a robot completes by a tick, and at most."""
    enter, length, laps = _enter(group, index), len(group.context.routes[index]), 0
    while (most is None or laps < most) and enter((laps + 1) * length) <= until:
        laps += 1
    return laps


def _track(group: GroupResult, index: int, n_visits: int) -> Track:
    route, enter, visits = group.context.routes[index], _enter(group, index), range(n_visits)
    return Track.of([route.vertex(visit) for visit in visits], [enter(visit) for visit in visits])


def _plan(
    result: CyclicResult, n_laps: Mapping[int, int], tracks: Mapping[int, Track], status: str
) -> Plan:
    robots = tuple(
        replace(robot, laps=n_laps[index]) for index, robot in enumerate(result.scenario.robots)
    )
    options = {"rule": result.rule, "routes": result.routes}
    return Plan(
        scenario=replace(result.scenario, robots=robots),
        tracks=tuple(tracks[robot] for robot in range(len(robots))),
        run=PlannerRun(name="laps", options=options, status=status),
    )


def _steady_state(group: GroupResult, pattern: Pattern, plan: Plan) -> SteadyState:
    """Return from when on a group repeats, and its critical visits if the plan holds them all."""
    critical = _critical_visits(group, pattern)
    rows = zip(group.robots, pattern.counts, strict=True)
    held = all(index < len(plan.tracks[robot]) for robot, index in critical)
    return SteadyState(
        robots=tuple(robot for robot, laps in rows if laps),
        start=pattern.transient,
        period=pattern.period,
        critical=critical if held else (),
    )


def _critical_visits(group: GroupResult, pattern: Pattern) -> tuple[tuple[int, int], ...]:
    """Return the visits of the critical circuit; none if the rule wastes more time than that."""
    graph = group.graph()
    if graph is None:
        return ()
    circuit = graph.critical_circuit()
    if circuit.cycle_time != pattern.period:
        return ()
    found = []
    for visit in graph.arcs.tail[circuit.arcs].tolist():
        robot = int(graph.robot[visit])
        index = pattern.visits(robot).start + visit - int(graph.first[robot])
        found.append((group.robots[robot], index))
    return tuple(found)
