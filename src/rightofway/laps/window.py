"""A window on endless routes: a stretch of each robot's visits, in one precedence graph.

A window begins at a *cut*. What happened up to the cut is frozen: no right of way may change it.
The visits that still matter after it are in the window with their actual times, the visits to come
with their least ones. Each robot leaves the window into a vertex of its own, where it is in the way
of nobody; times are good for as long as nobody has left.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.laps.endless import Endless
from rightofway.model import Route, Tick, VertexId
from rightofway.planners import Task
from rightofway.planners.giving_way import Fleet
from rightofway.precedence import Meeting, PrecedenceGraph, Segment

__all__ = ["Cut", "Ground", "Numbered", "TooShort", "Window"]

Numbered = tuple[tuple[int, int], tuple[int, int]]
"""A right of way as (robot, number of its visit) twice; the first goes first."""


class TooShort(Exception):
    """The window has to be longer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground:
    """What holds for a group at any time.

    Attributes
    ----------
    task
        The problem, and when to stop.
    group
        The endless routes of the robots.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there.
    """

    task: Task
    group: Sequence[Endless]
    headway: Tick
    books_ahead: bool

    @property
    def reach(self) -> int:
        """How long before a cut visits may have been left that still matter [ticks]."""
        drives = (max(endless.lap.drive) for endless in self.group)
        return 1 + self.headway + (max(drives) if self.books_ahead else 0)


@dataclass(frozen=True, slots=True)
class Cut:
    """What is frozen.

    Attributes
    ----------
    tick
        Up to when [ticks].
    history
        For each robot the ticks at which its visits so far began; all up to `tick`.
    """

    tick: int
    history: list[list[int]]


class _Graph(PrecedenceGraph):
    """A precedence graph that refuses to delay what is frozen."""

    frozen: frozenset[int] = frozenset()
    _too_late: bool = False

    def give_way(self, first: int, second: int) -> bool:
        self._too_late = second in self.frozen
        return not self._too_late and super().give_way(first, second)

    def deadlocked(self) -> list[int]:
        return [] if self._too_late else super().deadlocked()

    def deadlocking_rights(self) -> list[tuple[int, int]]:
        return [] if self._too_late else super().deadlocking_rights()


class Window(Fleet):
    """A fleet that goes on from a cut.

    Parameters
    ----------
    ground
        The group.
    cut
        What is frozen.
    ahead
        How many ticks each robot's visits have to last, if nobody is in its way.

    Attributes
    ----------
    begins
        The tick at which the graph's time begins.
    starts
        For each robot the number of its first visit in the window.
    """

    def __init__(self, ground: Ground, cut: Cut, ahead: int) -> None:
        self.begins = max(cut.tick - ground.reach, 0)
        self.cut = cut
        self.starts = [bisect_right(past, self.begins) - 1 for past in cut.history]
        self.group = ground.group
        self.n_vertices = ground.task.scenario.roadmap.n_vertices
        routes = [self._route(robot, ahead) for robot in range(len(ground.group))]
        graph = _Graph(routes, headway=ground.headway, books_ahead=ground.books_ahead)
        graph.frozen = frozenset(
            graph.visit(robot, index)
            for robot, (start, past) in enumerate(zip(self.starts, cut.history, strict=True))
            for index in range(len(past) - start)
        )
        super().__init__(ground.task, routes, graph=graph)
        self._ends = np.cumsum([len(route) for route in routes]) - 1

    def least(self, robot: int, visit: int) -> int:
        """Return how long a visit lasts at least, seen from the window."""
        past, endless = self.cut.history[robot], self.group[robot]
        enter = past[visit] if visit < len(past) else None
        if enter is None:
            return endless.least(visit)
        leave = past[visit + 1] if visit + 1 < len(past) else enter + endless.least(visit)
        return max(leave - max(enter, self.begins), 1)

    def visit(self, robot: int, number: int) -> int:
        """Return the graph's number of a robot's visit."""
        return self.graph.visit(robot, number - self.starts[robot])

    def number(self, visit: int) -> tuple[int, int]:
        """Return the robot of a visit of the graph, and the visit's number."""
        robot, index = self.graph.place(visit)
        return robot, self.starts[robot] + index

    def inside(self, rights: Iterable[Numbered]) -> tuple[Numbered, ...]:
        """Return those whose first visit is still in the window."""
        return tuple(right for right in rights if right[0][1] >= self.starts[right[0][0]])

    def is_past(self, robot: int, number: int) -> bool:
        """Tell whether a visit has begun by the cut."""
        return number < len(self.cut.history[robot])

    def enters(self) -> list[NDArray[np.int64]]:
        """Return when the visits of each robot begin [ticks], without the last one."""
        return [track.enter[:-1] + self.begins for track in self.graph.tracks()]

    def state(self) -> tuple[Hashable, ...]:
        """Return what all that comes depends on, besides the rights of way that are carried on."""
        frozen = (
            (endless.place(start), *route.dwell[: len(past) - start])
            for endless, start, route, past in zip(
                self.group, self.starts, self.routes, self.cut.history, strict=True
            )
        )
        return (self.cut.tick - self.begins, *frozen)

    def first_end(self) -> int:
        """Return when the first robot leaves the window [ticks]."""
        return self.begins + min(self.graph.enter(int(visit)) for visit in self._ends)

    def is_endless(self, meeting: Meeting, segment: Segment) -> bool:
        """Tell whether two robots are head-on for ever, so that neither can let the other pass.

        Two endless routes that run together for as many visits as both laps have run together for
        ever (Fine and Wilf 1965).

        Raises
        ------
        TooShort
            If the window ends before that is known.
        """
        i, j = meeting.robots
        reaches_the_end = (
            segment.i_last == len(self.routes[i]) - 2 or segment.j_last == len(self.routes[j]) - 2
        )
        if segment.kind != "head-on" or not reaches_the_end:
            return False
        if len(segment.vertices) < len(self.group[i].lap) + len(self.group[j].lap):
            raise TooShort
        return True

    def _route(self, robot: int, ahead: int) -> Route:
        endless, start = self.group[robot], self.starts[robot]
        frozen = len(self.cut.history[robot])
        least = [self.least(robot, visit) for visit in range(start, frozen)]
        left = ahead - sum(least)
        while left > 0:
            least.append(endless.least(start + len(least)))
            left -= least[-1]
        visits = range(start, start + len(least))
        drive = [Tick(0), *(endless.drive(visit) for visit in visits[1:]), Tick(0)]
        gone = VertexId(self.n_vertices + robot)
        return Route(
            vertices=(*(endless.vertex(visit) for visit in visits), gone),
            dwell=(*(Tick(a - b) for a, b in zip(least, drive[1:], strict=True)), Tick(0)),
            drive=tuple(drive),
        )
