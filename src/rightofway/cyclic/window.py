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

from rightofway.cyclic.route import CyclicRoute
from rightofway.model import Route, Tick, VertexId
from rightofway.planners import Task
from rightofway.planners.conflict_resolution import PartialPlan
from rightofway.precedence import Meeting, PrecedenceGraph, Segment

__all__ = ["Cut", "Ground", "Numbered", "TooShort", "Window"]

Numbered = tuple[tuple[int, int], tuple[int, int]]
"""A right of way as (robot, number of its visit) twice; the first goes first."""


class TooShort(Exception):
    """The window has to show more visits of some robots.

    Attributes
    ----------
    robots
        Which, by place in the group.
    """

    def __init__(self, robots: Iterable[int]) -> None:
        self.robots = tuple(robots)
        super().__init__()


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
    group: Sequence[CyclicRoute]
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


class Window(PartialPlan):
    """A fleet that goes on from a cut.

    Parameters
    ----------
    ground
        The group.
    cut
        What is frozen.
    ahead
        For each robot how many ticks its visits to come have to last, if nobody is in its way.
    shown
        For each robot a number; visits below it have to be in the window.

    Attributes
    ----------
    begins
        The tick at which the graph's time begins.
    starts
        For each robot the number of its first visit in the window.
    """

    def __init__(
        self, ground: Ground, cut: Cut, ahead: Sequence[int], shown: Sequence[int]
    ) -> None:
        self.ground = ground
        self.begins = max(cut.tick - ground.reach, 0)
        self.cut = cut
        self.starts = [bisect_right(past, self.begins) - 1 for past in cut.history]
        self.group = ground.group
        self.n_vertices = ground.task.scenario.roadmap.n_vertices
        ends = map(self._end, range(len(ahead)), ahead, shown)
        routes = [self._route(robot, end) for robot, end in enumerate(ends)]
        graph = _Graph(routes, headway=ground.headway, books_ahead=ground.books_ahead)
        graph.frozen = frozenset(
            graph.visit(robot, index)
            for robot, (start, past) in enumerate(zip(self.starts, cut.history, strict=True))
            for index in range(len(past) - start)
        )
        super().__init__(ground.task, routes, graph=graph)
        self._ends = (np.cumsum([len(route) for route in routes]) - 1).tolist()

    def visit(self, robot: int, number: int) -> int:
        """Return the graph's number of a robot's visit."""
        return self.graph.visit(robot, number - self.starts[robot])

    def shows(self, robot: int, number: int) -> bool:
        """Tell whether the window reaches as far as a visit."""
        return number - self.starts[robot] < len(self.routes[robot]) - 1

    def number(self, visit: int) -> tuple[int, int]:
        """Return the robot of a visit of the graph, and the visit's number."""
        robot, index = self.graph.place(visit)
        return robot, self.starts[robot] + index

    def gap_before(self, visit: int) -> int:
        """Return how long a place has to be left before a visit of the graph begins [ticks]."""
        robot, number = self.number(visit)
        approach = self.group[robot].drive(number) if self.ground.books_ahead else 0
        return self.ground.headway + approach

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

    def ends(self) -> NDArray[np.int64]:
        """Return when each robot leaves the window [ticks]."""
        enter = self.graph.enter
        return np.array([enter(visit) for visit in self._ends], np.int64) + self.begins

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
            raise TooShort(meeting.robots)
        return True

    def _end(self, robot: int, ahead: int, shown: int) -> int:
        begun = len(self.cut.history[robot])
        return max(begun + self.group[robot].lasting(begun, ahead), shown)

    def _route(self, robot: int, end: int) -> Route:
        endless, start, past = self.group[robot], self.starts[robot], self.cut.history[robot]
        visits = range(start, end)
        vertices, dwell, drive = endless.stretch(visits)
        dwell[-1] = endless.least(visits[-1])
        for index, visit in enumerate(range(start, len(past))):
            dwell[index] = Tick(self._lasted(robot, visit) - endless.drive(visit + 1))
        return Route(
            vertices=(*vertices, VertexId(self.n_vertices + robot)),
            dwell=(*dwell, Tick(0)),
            drive=(Tick(0), *drive[1:], Tick(0)),
        )

    def _lasted(self, robot: int, visit: int) -> int:
        """Return how long a visit from before the cut lasts at least, seen from the window."""
        past = self.cut.history[robot]
        enter = past[visit]
        known = visit + 1 < len(past)
        still_there = self.cut.tick + 1  # no later right of way lets it go before
        leave = past[visit + 1] if known else enter + self.group[robot].least(visit)
        leave = leave if known else max(leave, still_there)
        return max(leave - max(enter, self.begins), 1)
