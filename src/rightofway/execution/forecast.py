"""Forecast of an execution at an instant: past times are fixed, later times are estimated.

A stay or drive that is overdue by n ticks is expected to last n more ticks. A robot that waits for
its right of way only is expected to move as soon as it gets it. Other durations are as planned, and
longer by a delay that is known. Closures bind actions that have not begun. A forecast knows
`Progress` only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.progress import Activity, Progress, Times
from rightofway.model import Route, Tick
from rightofway.precedence import ActionDependencyGraph, PrecedenceGraph, build_graph


class Forecast:
    """The expected times at a tick, and the rights of way that can still be changed.

    Attributes
    ----------
    adg, progress
        The plan, and how far its robots have come.
    booked, entered
        Visits that have booked their vertex, and visits that have begun; bool[N].
    graph
        The precedence graph with the expected durations.
    is_possible
        Whether all visits can take place in their order, without a swap and outside closures. If
        not, the expected times are those without closures.
    """

    def __init__(self, adg: ActionDependencyGraph, progress: Progress) -> None:
        self.adg, self.progress = adg, progress
        self.now, self.broken = progress.now, progress.broken
        self.booked, self.entered = progress.booked, progress.entered
        self.books_ahead = adg.scenario.problem.booking_rules.books_ahead
        begun = self._mark_begun()
        try:
            self.graph = self._make_graph(begun)
            self.is_possible = self.graph.give_all(self._list_rights())
        except ValueError:  # closures leave a robot no times
            self.is_possible = False
        if not self.is_possible and adg.scenario.closures:
            self.graph = self._make_graph(np.ones_like(begun))
            self.graph.give_all(self._list_rights())

    def compute_times(self) -> Times:
        """Return the expected enter of each visit [ticks]; int64[N]."""
        return np.concatenate([track.enter for track in self.graph.build_tracks()])

    def get_visit(self, robot: int) -> int:
        """Return the last visit that a robot has begun."""
        first, end = self.adg.first_visit[robot : robot + 2].tolist()
        return int(first + np.count_nonzero(self.entered[first:end]) - 1)

    def has_set_off(self, robot: int) -> bool:
        """Tell whether a robot drives to, or waits before, a vertex that it has not booked."""
        return not self.books_ahead and self.progress.activity[robot] != Activity.STAYS

    def is_driving(self, robot: int) -> bool:
        """Tell whether a robot drives to a vertex that it has not booked."""
        return not self.books_ahead and self.progress.activity[robot] == Activity.DRIVES

    @property
    def may_turn_back(self) -> bool:
        """Whether robots that drive to a vertex that they have not booked may turn back.

        Where robots have broken down, or closures leave the fleet no times, that may be the way.
        """
        return bool(self.broken) or (bool(self.adg.scenario.closures) and not self.is_possible)

    def _make_graph(self, begun: NDArray[np.bool_]) -> PrecedenceGraph:
        """Return the graph of expected durations; closures do not bind begun actions."""
        return build_graph(
            self.adg.scenario.problem,
            [self._route(robot) for robot in range(len(self.adg.routes))],
            begun=begun,
        )

    def _mark_begun(self) -> NDArray[np.bool_]:
        """Return which stays at visits, and which drives into them, have begun; bool[N, 2]."""
        begun = np.column_stack((self.booked, self.booked))
        for robot in range(len(self.adg.routes)):
            if self.has_set_off(robot):
                begun[self.get_visit(robot) + 1, 1] = True
        return begun

    def _list_rights(self) -> Iterator[tuple[int, int]]:
        """Yield the unused rights of way, in the order of planned times."""
        lengths = np.diff(self.adg.first_visit)
        robot = np.repeat(np.arange(len(lengths)), lengths)
        first, second = self.adg.order.T
        unused = ~self.booked[second] & (robot[first] != robot[second])
        first, second = first[unused], second[unused]
        in_order = np.argsort(self.adg.planned[second], kind="stable")
        yield from zip(first[in_order].tolist(), second[in_order].tolist(), strict=True)

    def _route(self, robot: int) -> Route:
        """Return a route with actual durations so far and the expected one of the current visit."""
        route, first = self.adg.routes[robot], int(self.adg.first_visit[robot])
        current = self.get_visit(robot) - first
        lasted = np.diff(self.progress.enter[first : first + current + 1])
        dwell = [Tick(ticks - route.drive[k + 1]) for k, ticks in enumerate(lasted.tolist())]
        if current < len(route) - 1:
            dwell.append(Tick(self._estimate_lasting(robot, current) - route.drive[current + 1]))
        return replace(route, dwell=(*dwell, *route.dwell[len(dwell) :]))

    def _estimate_lasting(self, robot: int, index: int) -> int:
        """Return the expected ticks from the enter of the current visit to the next enter."""
        route, visit = self.adg.routes[robot], int(self.adg.first_visit[robot]) + index
        enter, start = self.progress.enter, self.progress.start
        since, drive = self.now - int(enter[visit]), int(route.drive[index + 1])
        is_ready = self.progress.activity[robot] == Activity.WAITS
        more = self.progress.get_delay(robot) or 0
        if not self.books_ahead:
            least = route.compute_least(index)
            return max(since, least) if is_ready else _add_overdue(least + more, since)
        if self.booked[visit + 1]:
            stayed = int(start[visit + 1] - enter[visit])
            is_lost = robot in self.broken
            return stayed + (drive if is_lost else _add_overdue(drive + more, since - stayed))
        if is_ready:
            return since + drive
        return _add_overdue(int(route.dwell[index]) + more, since) + drive


def _add_overdue(least: int, since: int) -> int:
    """Return the expected ticks of an action that began ``since`` ticks ago; least: ``least``."""
    overdue = since - least
    return least if overdue < 0 else least + 2 * overdue + 1
