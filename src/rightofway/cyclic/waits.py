"""Where robots wait for each other: in their first laps, and for ever after.

A conflict is told by its trace in the timetable: a robot enters a vertex later than it could, at
the very tick from which another one lets it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import History, Pattern
from rightofway.cyclic.route import CyclicRoute
from rightofway.model import NEVER, Tick, VertexId

__all__ = ["Bookings", "Conflict"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """A robot waits for another one.

    Attributes
    ----------
    vertex
        The place that it has to wait for.
    waits, for_robot
        Who waits for whom; numbers in the scenario.
    tick
        When the one that waits could have entered; in a pattern, as an offset in its period.
    ticks
        How much later it enters.
    """

    vertex: VertexId
    waits: int
    for_robot: int
    tick: Tick
    ticks: Tick

    @property
    def pair(self) -> tuple[int, int]:
        """The two robots, the one listed first in front."""
        return min(self.waits, self.for_robot), max(self.waits, self.for_robot)


@dataclass(frozen=True, slots=True, kw_only=True)
class Bookings:
    """Reads waits from the times of a group.

    Attributes
    ----------
    group
        The endless routes of its robots.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there.
    """

    group: Sequence[CyclicRoute]
    headway: Tick
    books_ahead: bool

    def in_first_laps(self, history: History) -> tuple[Conflict, ...]:
        """Return who waits for whom in the first lap of each robot, by tick."""
        first = [
            range(min(len(past) - 1, len(endless.lap)))
            for past, endless in zip(history, self.group, strict=True)
        ]
        until = max(past[visits.stop] for past, visits in zip(history, first, strict=True))
        seen = [range(min(len(past) - 1, bisect_right(past, until))) for past in history]
        return self._conflicts(
            lambda robot, visits: np.array(history[robot][visits.start : visits.stop], np.int64),
            seen,
            first,
        )

    def in_period(self, pattern: Pattern) -> tuple[Conflict, ...]:
        """Return who waits for whom in each period, by offset.

        Where a rule takes a decision back after a robot has waited for it, that wait is for nobody,
        and is not told.
        """
        firsts = (pattern.visits(robot) for robot in range(len(self.group)))
        # in the second period nobody leaves home for the first time, without a turn
        visits = [range(first.stop, first.stop + len(first)) for first in firsts]
        return self._conflicts(pattern.enters, visits, visits, pattern.begins, pattern.period)

    def _conflicts(
        self,
        enters: Callable[[int, range], NDArray[np.int64]],
        seen: Sequence[range],
        asked: Sequence[range],
        begins: int = 0,
        period: int = NEVER,
    ) -> tuple[Conflict, ...]:
        waits = [
            wait
            for robot, visits in enumerate(asked)
            if visits
            for wait in self._waits(enters, robot, visits)
        ]
        frees = self._frees(enters, seen, {wait.let_in % period for wait in waits}, period)
        found = []
        for wait in waits:
            other = frees.get((wait.vertex, wait.let_in % period))
            if other is not None:  # without: for its time in a timetable, or what was taken back
                conflict = Conflict(
                    vertex=wait.vertex,
                    waits=self.group[wait.robot].robot,
                    for_robot=self.group[other].robot,
                    tick=Tick((wait.could - begins) % period),
                    ticks=Tick(wait.enters - wait.could),
                )
                found.append(conflict)
        return tuple(sorted(found, key=lambda one: (one.tick, one.waits)))

    def _waits(
        self, enters: Callable[[int, range], NDArray[np.int64]], robot: int, visits: range
    ) -> Iterator[_Wait]:
        """Yield where a robot enters later than it could."""
        endless = self.group[robot]
        enter = enters(robot, range(visits.start, visits.stop + 1))
        could = enter[:-1] + endless.leasts(visits)
        for index in np.flatnonzero(could < enter[1:]).tolist():
            visit = visits[index] + 1
            approach = endless.drive(visit) if self.books_ahead else 0
            yield _Wait(
                robot=robot,
                vertex=endless.vertex(visit),
                could=int(could[index]),
                enters=int(enter[index + 1]),
                let_in=int(enter[index + 1]) - approach,
            )

    def _frees(
        self,
        enters: Callable[[int, range], NDArray[np.int64]],
        seen: Sequence[range],
        asked: set[int],
        period: int,
    ) -> dict[tuple[VertexId, int], int]:
        """Return who lets others in at those ticks that are asked for, by place and tick."""
        ticks, frees = np.array(sorted(asked), np.int64), {}
        for robot, visits in enumerate(seen):
            if not visits:
                continue
            leave = enters(robot, range(visits.start + 1, visits.stop + 1))
            free = (leave + self.headway) % period
            for index in np.flatnonzero(np.isin(free, ticks)).tolist():
                frees[self.group[robot].vertex(visits[index]), int(free[index])] = robot
        return frees


class _Wait(NamedTuple):
    """A robot enters a vertex later than it could, as soon as it is let in."""

    robot: int
    vertex: VertexId
    could: int
    enters: int
    let_in: int
