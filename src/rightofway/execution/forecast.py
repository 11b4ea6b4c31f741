"""What can be expected of a plan at an instant: what has happened is fixed, the rest is reckoned.

Who is overdue with a stay or a drive is expected to be so for as long again; who is ready, and only
waits for its right of way, can go at once; everything else takes the time of the plan. Nobody knows
how long a delay will last, neither here nor on a real floor.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Route, Tick
from rightofway.planners.task import planning_headway
from rightofway.precedence import ActionDependencyGraph, DelaySample, Execution, PrecedenceGraph

__all__ = ["Forecast", "Times"]

Times = NDArray[np.int64]


class Forecast:
    """What can be expected at an instant, and what can still be changed.

    Parameters
    ----------
    floor, setbacks
        A plan, and what befalls it; only what has happened by the instant is looked at.
    happens
        What comes of both.
    now
        The instant [ticks].

    Attributes
    ----------
    begun, over
        Which visits have booked their vertex, and which robots have entered it; bool[N].
    graph
        The precedence graph with the durations that are expected.
    is_possible
        Whether all visits can take place in their order, without a swap.
    """

    def __init__(
        self, floor: ActionDependencyGraph, delay_sample: DelaySample, happens: Execution, now: int
    ) -> None:
        self.floor, self.delay_sample, self.happens, self.now = floor, delay_sample, happens, now
        self.begun = happens.start <= now
        self.over = happens.enter <= now
        scenario = floor.scenario
        self.graph = PrecedenceGraph(
            [self._route(robot) for robot in range(len(floor.routes))],
            headway=planning_headway(scenario),
            books_ahead=scenario.rules.books_ahead,
        )
        self.is_possible = self.graph.give_all(self._rights())

    def times(self) -> Times:
        """Return when visits are expected to begin [ticks]."""
        return np.concatenate([track.enter for track in self.graph.tracks()])

    def visit_of(self, robot: int) -> int:
        """Return the last visit that a robot has entered."""
        first, end = self.floor.first_visit[robot : robot + 2].tolist()
        return int(first + np.count_nonzero(self.over[first:end]) - 1)

    def is_ready(self, robot: int) -> bool:
        """Tell whether a robot has done what it has to and only waits for its right of way."""
        visit = self.visit_of(robot)
        ready = int(self.happens.enter[visit] + self.delay_sample.dwell[visit])
        if not self.floor.scenario.rules.books_ahead:
            ready += int(self.delay_sample.drive[visit + 1])
        stands = False
        for begin, ticks in self.delay_sample.of(robot):
            if self.happens.enter[visit] <= begin < ready:
                ready += ticks
            stands |= begin < self.now < begin + ticks
        return ready <= self.now and not stands

    def _rights(self) -> Iterator[tuple[int, int]]:
        """Yield the rights of way that are still to be used, in the order of the plan."""
        before, robot = self.floor.before, self._robots()
        still = np.flatnonzero(~self.begun & (before >= 0) & (robot[before] != robot))
        still = still[np.argsort(self.floor.planned[still], kind="stable")]
        yield from zip(before[still].tolist(), still.tolist(), strict=True)

    def _robots(self) -> NDArray[np.int64]:
        """Return whose each visit is."""
        lengths = np.diff(self.floor.first_visit)
        return np.repeat(np.arange(len(lengths)), lengths)

    def _route(self, robot: int) -> Route:
        """Return a route with what has happened, and what the visit under way may still take."""
        route, first = self.floor.routes[robot], int(self.floor.first_visit[robot])
        here = self.visit_of(robot) - first
        lasted = np.diff(self.happens.enter[first : first + here + 1])
        dwell = [Tick(ticks - route.drive[k + 1]) for k, ticks in enumerate(lasted.tolist())]
        if here < len(route) - 1:
            dwell.append(Tick(self._lasts(robot, here) - route.drive[here + 1]))
        return replace(route, dwell=(*dwell, *route.dwell[len(dwell) :]))

    def _lasts(self, robot: int, index: int) -> int:
        """Return how long it is from entering the visit under way to entering the next one."""
        route, visit = self.floor.routes[robot], int(self.floor.first_visit[robot]) + index
        since = self.now - int(self.happens.enter[visit])
        drive = int(route.drive[index + 1])
        if not self.floor.scenario.rules.books_ahead:
            least = route.least(index)
            return max(since, least) if self.is_ready(robot) else _with_overdue(least, since)
        if self.begun[visit + 1]:
            stayed = int(self.happens.start[visit + 1] - self.happens.enter[visit])
            return stayed + _with_overdue(drive, since - stayed)
        if self.is_ready(robot):
            return since + drive
        return _with_overdue(int(route.dwell[index]), since) + drive


def _with_overdue(least: int, since: int) -> int:
    """Return how long something takes that has not come to its end yet."""
    overdue = since - least
    return least if overdue < 0 else least + 2 * overdue + 1
