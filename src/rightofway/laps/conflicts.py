"""Where robots wait for each other: in their first laps, and for ever after.

A conflict is told by its trace in the timetable: a robot enters a vertex later than it could, at
the very tick from which another one lets it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rightofway.laps.endless import Endless
from rightofway.laps.pattern import History, Pattern
from rightofway.model import Tick, VertexId

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

    group: Sequence[Endless]
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
        return self._conflicts(lambda robot, visit: history[robot][visit], seen, first)

    def in_period(self, pattern: Pattern) -> tuple[Conflict, ...]:
        """Return who waits for whom in each period, by offset."""
        firsts = (pattern.visits(robot) for robot in range(len(self.group)))
        # in the second period nobody leaves home for the first time, without a turn
        visits = [range(first.stop, first.stop + len(first)) for first in firsts]
        return self._conflicts(pattern.enter, visits, visits, pattern.begins, pattern.period)

    def _conflicts(
        self,
        enter: Callable[[int, int], int],
        seen: Sequence[range],
        asked: Sequence[range],
        begins: int = 0,
        period: int = 2**62,
    ) -> tuple[Conflict, ...]:
        frees = {
            (endless.vertex(visit), (enter(robot, visit + 1) + self.headway) % period): endless
            for robot, endless in enumerate(self.group)
            for visit in seen[robot]
        }
        found = []
        for robot, endless in enumerate(self.group):
            for visit in asked[robot]:
                could = enter(robot, visit) + endless.least(visit)
                enters, vertex = enter(robot, visit + 1), endless.vertex(visit + 1)
                approach = endless.drive(visit + 1) if self.books_ahead else 0
                other = frees.get((vertex, (enters - approach) % period))
                if could < enters and other:  # without: it waits for its time in a timetable
                    conflict = Conflict(
                        vertex=vertex,
                        waits=endless.robot,
                        for_robot=other.robot,
                        tick=Tick((could - begins) % period),
                        ticks=Tick(enters - could),
                    )
                    found.append(conflict)
        return tuple(sorted(found, key=lambda one: (one.tick, one.waits)))
