"""Start-up of a timetable: each robot waits at home until it begins one of its laps there.

A robot waits at home from tick 0, so no other robot may pass its home before it sets out. Each
robot begins with the first lap at which it is home from a tick on. If another robot would pass it
while it waits, that robot begins with a later lap, after it would have passed. This is repeated
until no robot is passed while it waits. Times only rise, so they are the least from that tick on:
if they rise without end, no start exists in which robots only wait at home.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import BaselineComparison, GroupResult
from rightofway.cyclic.route import CyclicRoute, GroupContext
from rightofway.model import Scenario, Tick
from rightofway.model.lap import compute_dwell_between_laps
from rightofway.native import list_excluded
from rightofway.precedence import CyclicSchedule

MOST_BEGINS = 200
"""Ticks that are compared for the beginning."""

MOST_PASSES = 20_000
"""Ticks times pairs of robots of which one passes the home of the other, in the comparison."""

RAISES_PER_ROBOT = 50
"""First laps that are replaced by later ones before a start counts as not found, per robot."""


def start(
    group: GroupContext,
    timetable: CyclicSchedule,
    comparison: BaselineComparison,
    *,
    periods: int = 3,
    most_visits: int = 1_000_000,
) -> GroupResult | None:
    """Return the result of a group that follows a timetable from its first lap on.

    None if no start is found in which robots only wait at home. The history holds ``periods``
    periods, or one period if it has more than ``most_visits`` visits.
    """
    scenario = group.scenario
    begins = find_start(scenario, timetable)
    if begins is None:
        return None
    n_visits = sum(map(len, timetable.enter))
    n_periods = 1 if n_visits > most_visits else periods
    history = tuple(
        _make_history(timetable, robot, begin, begin - min(begins), n_periods)
        for robot, begin in enumerate(begins)
    )
    pattern = Pattern(
        transient=Tick(max(past[1] for past in history)),
        period=timetable.period,
        counts=timetable.counts,
        history=history,
        lengths=tuple(map(len, timetable.laps)),
        regular=(1,) * len(history),
    )
    itineraries, routes = scenario.problem.itineraries, []
    for robot, lap in zip(timetable.robots, timetable.laps, strict=True):
        between = compute_dwell_between_laps(scenario.roadmap, itineraries[robot], lap.vertices)
        first_dwell = Tick(lap.dwell[0] - between)
        routes.append(CyclicRoute(robot=robot, lap=lap, first_dwell=first_dwell))
    return GroupResult(
        context=replace(group, routes=tuple(routes)),
        ends="repeats",
        history=history,
        pattern=pattern,
        comparison=comparison,
    )


def find_start(scenario: Scenario, timetable: CyclicSchedule) -> list[int] | None:
    """Return when each robot is home for its first lap, in ticks of the timetable's first periods.

    The start with the shortest transient, of those that begin at or after some ticks of a period;
    None if none is found.
    """
    period = int(timetable.period)
    homes = [
        sorted((enter[:: len(lap)] % period).tolist())
        for lap, enter in zip(timetable.laps, timetable.enter, strict=True)
    ]
    passes = _collect_passes(scenario, timetable)
    ticks = sorted(set().union(*homes))
    most = min(MOST_BEGINS, MOST_PASSES // (1 + sum(map(len, passes.values()))) + 1)
    starts = []
    for tick in ticks[:: -(-len(ticks) // most)]:
        begins = _begin_from(tick, homes, passes, period)
        if begins is None:
            return None  # where there is a start from one tick on, there is one from each
        starts.append((max(begins) - min(begins), min(begins), begins))
    return min(starts)[2]


Passes = Mapping[int, Mapping[int, Sequence[int]]]
"""For a robot the sorted ticks of a period at which each other robot begins to exclude it from its
home."""


def _begin_from(
    tick: int, homes: Sequence[Sequence[int]], passes: Passes, period: int
) -> list[int] | None:
    """Return the least begins from a tick on; None if they rise too often."""
    begins = [_find_next(own, tick, period) for own in homes]
    waiting, raises = list(passes), 0
    while waiting:
        robot = waiting.pop()
        for other, times in passes[robot].items():
            passed = _find_last_before(times, begins[robot], period)
            if passed >= begins[other]:  # while the robot waits at home
                begins[other] = _find_next(homes[other], passed + 1, period)
                raises += 1
                if raises > RAISES_PER_ROBOT * len(homes):
                    return None
                if other in passes:
                    waiting.append(other)
    return begins


def _find_next(times: Sequence[int], tick: int, period: int) -> int:
    """Return the first tick from another one on that is in the times of some period."""
    periods, rest = divmod(tick, period)
    index = bisect_left(times, rest)
    return periods * period + (times[index] if index < len(times) else period + times[0])


def _find_last_before(times: Sequence[int], tick: int, period: int) -> int:
    """Return the last tick before another one that is in the times of some period."""
    periods, rest = divmod(tick, period)
    return periods * period + (
        times[index - 1] if (index := bisect_left(times, rest)) else times[-1] - period
    )


def _collect_passes(scenario: Scenario, timetable: CyclicSchedule) -> Passes:
    """Return when robots exclude others from their homes: they enter a vertex, or drive off."""
    resources, period = scenario.problem.resources, int(timetable.period)
    rows = [
        resources.list_rows_of_lap(scenario.roadmap, robot, lap.vertices)
        for robot, lap in zip(timetable.robots, timetable.laps, strict=True)
    ]
    owners = defaultdict[int, list[int]](list)  # of homes, by the rows that exclude them
    for robot, booked in enumerate(rows):
        for row in list_excluded(resources, int(booked[0][0])):
            owners[row].append(robot)
    excluding, passes = list(owners), defaultdict[int, dict[int, set[int]]](dict)
    for other, (booked, lap, enter) in enumerate(
        zip(rows, timetable.laps, timetable.enter, strict=True)
    ):
        length = len(lap)
        drives = np.append(enter[1:], enter[0] + period) - np.resize(
            np.roll(lap.drive, -1), len(enter)
        )
        for own, times in zip(booked[:2], (enter, drives), strict=True):
            for visit in np.flatnonzero(np.isin(own, excluding)).tolist():
                for robot in owners[int(own[visit])]:
                    if robot != other:
                        ticks = times[visit::length] % period
                        passes[robot].setdefault(other, set()).update(ticks.tolist())
    return {
        robot: {other: sorted(ticks) for other, ticks in by_other.items()}
        for robot, by_other in sorted(passes.items())
    }


def _make_history(
    timetable: CyclicSchedule, robot: int, begin: int, later: int, periods: int
) -> array[int]:
    """Return the enters of a robot's visits, counted from the beginning of the start-up."""
    period, enter, length = (
        int(timetable.period),
        timetable.enter[robot],
        len(timetable.laps[robot]),
    )
    lap = int(np.argmin((enter[::length] - begin) % period))
    turn = np.arange(periods + 1)[:, None] * period
    times = (enter + turn).ravel()[lap * length : lap * length + periods * len(enter) + 1]
    times += later - times[0]
    times[0] = 0
    return array("q", times.tobytes())
