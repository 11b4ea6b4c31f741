"""Start-up of a timetable: each robot waits at home until the start of its first lap.

The start-up begins at the tick of the period with the fewest visits of other robots to homes with
a waiting robot.
"""

from __future__ import annotations

from array import array
from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import BaselineComparison, GroupResult
from rightofway.cyclic.route import CyclicRoute, GroupContext
from rightofway.model import Scenario, Tick
from rightofway.model.lap import compute_dwell_between_laps
from rightofway.native import list_excluded
from rightofway.precedence import CyclicSchedule


def start(
    scenario: Scenario,
    timetable: CyclicSchedule,
    comparison: BaselineComparison,
    *,
    periods: int = 3,
    most_begins: int = 200,
    most_visits: int = 1_000_000,
) -> GroupResult:
    """Return the result of a group that follows a timetable from its first lap on.

    Compares up to ``most_begins`` ticks for the beginning. The history holds ``periods`` periods,
    or one period if it has more than ``most_visits`` visits.
    """
    period, robots = int(timetable.period), range(len(timetable.laps))
    homes = [
        enter[:: len(lap)] % period
        for lap, enter in zip(timetable.laps, timetable.enter, strict=True)
    ]
    ticks: list[int] = np.unique(np.concatenate(homes)).tolist()
    passes = _passes(scenario, timetable)

    def visits_while_waiting(begins: int) -> int:
        """Return the number of visits to homes of robots that wait there."""
        taken = 0
        for robot, enter in passes.items():
            waits = _first_home(timetable, robot, begins)[1]
            taken += int(np.count_nonzero((enter - begins) % period < waits))
        return taken

    considered = ticks[:: -(-len(ticks) // most_begins)]
    begins = min(considered, key=lambda tick: (visits_while_waiting(tick), tick))
    n_visits = sum(map(len, timetable.enter))
    n_periods = 1 if n_visits > most_visits else periods
    history = tuple(_history(timetable, robot, begins, n_periods) for robot in robots)
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
        context=GroupContext(scenario=scenario, routes=tuple(routes)),
        ends="repeats",
        history=history,
        pattern=pattern,
        comparison=comparison,
    )


def _first_home(timetable: CyclicSchedule, robot: int, begins: int) -> tuple[int, int]:
    """Return a robot's first visit home at or after a tick, and the time until then [ticks]."""
    length = len(timetable.laps[robot])
    later = (timetable.enter[robot][::length] - begins) % int(timetable.period)
    lap = int(np.argmin(later))
    return lap * length, int(later[lap])


def _passes(scenario: Scenario, timetable: CyclicSchedule) -> dict[int, NDArray[np.int64]]:
    """Return for each robot the enters of others' visits that exclude it from its home, if any."""
    resources = scenario.problem.resources
    owners = defaultdict[int, list[int]](list)  # of homes, by the rows that exclude them
    booked = list[list[tuple[int, ...]]]()  # of each visit of each lap
    for index, (robot, lap) in enumerate(zip(timetable.robots, timetable.laps, strict=True)):
        rows = resources.list_rows_of_lap(scenario.roadmap, robot, lap.vertices)
        for row in list_excluded(resources, int(rows[0][0])):
            owners[row].append(index)
        booked.append(list(zip(rows[0].tolist(), rows[1].tolist(), strict=True)))
    passes = defaultdict[int, list[NDArray[np.int64]]](list)
    for index, (visits, enter) in enumerate(zip(booked, timetable.enter, strict=True)):
        for visit, own in enumerate(visits):
            met = {number for row in own for number in owners.get(row, ()) if number != index}
            for number in sorted(met):
                passes[number].append(enter[visit :: len(visits)])
    return {robot: np.concatenate(ticks) for robot, ticks in passes.items()}


def _history(timetable: CyclicSchedule, robot: int, begins: int, periods: int) -> array[int]:
    """Return the enters of a robot's visits, counted from the beginning of the start-up."""
    period, enter = int(timetable.period), timetable.enter[robot]
    visit, later = _first_home(timetable, robot, begins)
    turn = np.arange(periods + 1)[:, None] * period
    times = (enter + turn).ravel()[visit : visit + periods * len(enter) + 1]
    times += later - times[0]
    times[0] = 0
    return array("q", times.tobytes())
