"""A run of laps for the eye: a plan that goes on for some periods, and where it repeats itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil

from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import CyclicResult, GroupRun
from rightofway.errors import GaveUp
from rightofway.model import Plan, PlannerRun, SteadyState, Track

__all__ = ["shown"]

PERIODS = 4
"""As many of the longest period, or of the longest lap where nothing is known to repeat."""

MOST_VISITS = 200_000
"""Of all robots together; no more are shown, however long the periods are."""


def shown(run: CyclicResult, periods: int = PERIODS) -> tuple[Plan, tuple[SteadyState, ...]]:
    """Return the laps of a run as a page shows them.

    Parameters
    ----------
    run
        What the fleet did.
    periods
        How many periods to show of the group that needs most time for them.

    Returns
    -------
    plan, steady
        Each robot makes whole laps beyond the last of these periods, so nobody stays at home before
        it is over; one that comes to a standstill gets no further. After that robots may be in each
        other's way: the plan is for the eye only. And for each group that repeats itself: from when
        on, and its bottleneck.

    Raises
    ------
    GaveUp
        If a robot was not followed for a whole lap.
    """
    until = _until(run, periods)
    robots, tracks = list(run.scenario.robots), {}
    for group in run.groups:
        for index, robot in enumerate(group.robots):
            laps = _laps(run, group, index, until)
            robots[robot] = replace(robots[robot], laps=laps)
            tracks[robot] = _track(group, index, laps)
    plan = Plan(
        scenario=replace(run.scenario, robots=tuple(robots)),
        tracks=tuple(tracks[robot] for robot in range(len(robots))),
        run=PlannerRun(
            name="laps", options={"rule": run.rule, "routes": run.routes}, status=run.rule
        ),
    )
    return plan, tuple(
        _steady(run, group, group.pattern, plan.tracks)
        for group in run.groups
        if group.pattern is not None
    )


def _until(run: CyclicResult, periods: int) -> int:
    """Return how long the laps are shown [ticks]."""
    worth, visits_a_tick = 0, Fraction(0)
    for group in run.groups:
        means = [mean or Fraction(1) for mean in group.mean_laps()]
        pattern = group.pattern
        end = pattern.transient + periods * pattern.period if pattern else periods * max(means)
        worth = max(worth, ceil(end))
        lengths = (len(endless.lap) for endless in group.group)
        visits_a_tick += sum(map(Fraction, lengths, means))
    return min(worth, int(MOST_VISITS / visits_a_tick))


def _stands(group: GroupRun, index: int) -> bool:
    """Whether a robot comes to a standstill."""
    return group.ends == "deadlock" or bool(group.pattern and not group.pattern.counts[index])


def _laps(run: CyclicResult, group: GroupRun, index: int, until: int) -> int:
    """Return how many laps a robot makes by then and one more, or as many as are known."""
    made = group.laps_made()[index]
    if _stands(group, index):
        return made + 1
    if group.pattern is None and not made:
        name = run.scenario.robots[group.robots[index]].name
        raise GaveUp(f"{name} was not followed for a whole lap (allow more time)")
    length, laps = len(group.group[index].lap), 1
    while (group.pattern or laps < made) and _enter(group, index, laps * length) <= until:
        laps += 1
    return laps


def _enter(group: GroupRun, index: int, visit: int) -> int:
    if group.pattern:
        return group.pattern.enter(index, visit)
    return group.history[index][visit]


def _track(group: GroupRun, index: int, laps: int) -> Track:
    endless, past = group.group[index], group.history[index]
    visits = range(len(past) if _stands(group, index) else laps * len(endless.lap) + 1)
    return Track.of(
        [endless.vertex(visit) for visit in visits],
        [_enter(group, index, visit) for visit in visits],
    )


def _steady(
    run: CyclicResult, group: GroupRun, pattern: Pattern, tracks: Sequence[Track]
) -> SteadyState:
    critical = _critical(run, group, pattern)
    return SteadyState(
        robots=tuple(
            robot for robot, laps in zip(group.robots, pattern.counts, strict=True) if laps
        ),
        start=pattern.transient,
        period=pattern.period,
        critical=critical if all(index < len(tracks[robot]) for robot, index in critical) else (),
    )


def _critical(run: CyclicResult, group: GroupRun, pattern: Pattern) -> tuple[tuple[int, int], ...]:
    """Return the visits of the critical circuit; none where the rule wastes more time than that."""
    graph = run.graph(group)
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
