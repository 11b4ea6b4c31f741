"""A timetable, begun: all robots wait at home until their first lap of it is due.

Then the fleet follows the timetable from the first lap on, and what holds for a run holds for it:
its report, its plan. Where others pass a robot's home while it would still wait there, another
tick is a better beginning; the one with the fewest of these is taken.
"""

from __future__ import annotations

from array import array
from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import CyclicResult, GroupRun
from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.schedule_search import GroupTimetable
from rightofway.model import Scenario, Tick
from rightofway.precedence import CyclicSchedule

__all__ = ["run_of"]

MOST_BEGINNINGS = 200
"""How many beginnings are looked at; in large groups not all."""

PERIODS, LONG = 3, 1_000_000
"""How many periods of visits a run is told with; a long one, of more visits, with one."""


def run_of(scenario: Scenario, chosen: Sequence[GroupTimetable]) -> CyclicResult:
    """Let a fleet begin its timetables and go on with them for ever."""
    return CyclicResult(
        scenario=scenario,
        rule="timetable",
        routes="chosen",
        groups=tuple(_group_run(scenario, one.timetable) for one in chosen),
    )


def _group_run(scenario: Scenario, timetable: CyclicSchedule) -> GroupRun:
    passes = _passes(timetable)
    begins = min(
        _beginnings(timetable), key=lambda tick: (_in_the_way(timetable, passes, tick), tick)
    )
    periods = 1 if sum(map(len, timetable.enter)) > LONG else PERIODS
    robots = range(len(timetable.laps))
    history = tuple(_history(timetable, robot, begins, periods) for robot in robots)
    counts, lengths = timetable.counts, tuple(map(len, timetable.laps))
    pattern = Pattern(
        transient=Tick(max(past[1] for past in history)),
        period=timetable.period,
        counts=counts,
        history=history,
        lengths=lengths,
        regular=(1,) * len(history),
    )
    group = tuple(_endless(scenario, timetable, robot) for robot in range(len(history)))
    return GroupRun(ends="repeats", why="", group=group, history=history, pattern=pattern)


def _endless(scenario: Scenario, timetable: CyclicSchedule, place: int) -> CyclicRoute:
    robot, lap = timetable.robots[place], timetable.laps[place]
    turn = scenario.problem.itineraries[robot].stages[-1].turn
    return CyclicRoute(robot=robot, lap=lap, first_least=Tick(lap.least(0) - turn))


def _beginnings(timetable: CyclicSchedule) -> list[int]:
    """Return the ticks at which a robot comes home."""
    homes = [
        enter[:: len(lap)] % int(timetable.period)
        for lap, enter in zip(timetable.laps, timetable.enter, strict=True)
    ]
    ticks: list[int] = np.unique(np.concatenate(homes)).tolist()
    return ticks[:: -(-len(ticks) // MOST_BEGINNINGS)]


def _first_home(timetable: CyclicSchedule, robot: int, begins: int) -> tuple[int, int]:
    """Return the visit and the tick at which a robot is first at home from a tick on."""
    length = len(timetable.laps[robot])
    later = (timetable.enter[robot][::length] - begins) % int(timetable.period)
    lap = int(np.argmin(later))
    return lap * length, int(later[lap]) + begins


def _passes(timetable: CyclicSchedule) -> dict[int, NDArray[np.int64]]:
    """Return when others visit each robot's home in a period, where they do."""
    owner = {lap.vertices[0]: robot for robot, lap in enumerate(timetable.laps)}
    passes = defaultdict(list)
    for robot, (lap, enter) in enumerate(zip(timetable.laps, timetable.enter, strict=True)):
        for index, vertex in enumerate(lap.vertices):
            if owner.get(vertex, robot) != robot:
                passes[owner[vertex]].append(enter[index :: len(lap)])
    return {robot: np.concatenate(ticks) for robot, ticks in passes.items()}


def _in_the_way(
    timetable: CyclicSchedule, passes: Mapping[int, NDArray[np.int64]], begins: int
) -> int:
    """Return how many visits others make to homes whose robots still wait there."""
    period, visits = int(timetable.period), 0
    for robot, ticks in passes.items():
        until = _first_home(timetable, robot, begins)[1]
        visits += int(np.count_nonzero((ticks - begins) % period < until - begins))
    return visits


def _history(timetable: CyclicSchedule, robot: int, begins: int, periods: int) -> Sequence[int]:
    """Return when visits begin, counted from the beginning; at home from then on."""
    period, enter = int(timetable.period), timetable.enter[robot]
    visit, tick = _first_home(timetable, robot, begins)
    turn = np.arange(periods + 1)[:, None] * period
    times = (enter + turn).ravel()[visit : visit + periods * len(enter) + 1]
    times += tick - begins - times[0]
    times[0] = 0
    return array("q", times.tobytes())
