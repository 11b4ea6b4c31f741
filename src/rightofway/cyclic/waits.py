"""Where robots wait for each other: in their first laps, and in each period.

A wait is read from the enters of visits: a robot enters a vertex later than it could, at the very
tick from which another robot no longer books it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import History, Pattern
from rightofway.cyclic.route import GroupContext
from rightofway.model import NEVER, Tick, VertexId

__all__ = ["LapWait", "waits_in_first_laps", "waits_in_period"]

Enters = Callable[[int, range], NDArray[np.int64]]
"""Returns the enters of consecutive visits of a robot [ticks]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LapWait:
    """A robot that waits for another one.

    Attributes
    ----------
    vertex
        The vertex that it waits to enter.
    waits, for_robot
        The robot that waits, and the robot that it waits for; numbers in the scenario.
    tick
        When the waiting robot could have entered; in a pattern, as an offset in the period.
    ticks
        How much later it enters [ticks].
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


def waits_in_first_laps(context: GroupContext, history: History) -> tuple[LapWait, ...]:
    """Return the waits in the first lap of each robot, by tick."""
    first = [
        range(min(len(past) - 1, len(route)))
        for past, route in zip(history, context.routes, strict=True)
    ]
    until = max(past[visits.stop] for past, visits in zip(history, first, strict=True))
    seen = [range(min(len(past) - 1, bisect_right(past, until))) for past in history]
    return _waits(
        context,
        lambda robot, visits: np.array(history[robot][visits.start : visits.stop], np.int64),
        seen,
        first,
    )


def waits_in_period(context: GroupContext, pattern: Pattern) -> tuple[LapWait, ...]:
    """Return the waits of each period, by offset from `Pattern.begins`.

    Where a rule reverses a decision for which a robot has waited, that wait is for no robot, and it
    is left out.
    """
    firsts = (pattern.visits(robot) for robot in range(len(context)))
    # In the second period, no robot leaves home for the first time, without a turn.
    visits = [range(first.stop, first.stop + len(first)) for first in firsts]
    when = {"begins": pattern.begins, "period": pattern.period}
    return _waits(context, pattern.enters, visits, visits, **when)


def _waits(
    context: GroupContext,
    enters: Enters,
    seen: Sequence[range],
    asked: Sequence[range],
    *,
    begins: int = 0,
    period: int = NEVER,
) -> tuple[LapWait, ...]:
    """Return the waits before visits asked for, for robots whose visits are seen."""
    late: list[tuple[int, VertexId, int, int, int]] = []
    for robot, visits in enumerate(asked):
        if not visits:
            continue
        route, enter = context.routes[robot], enters(robot, range(visits.start, visits.stop + 1))
        could = enter[:-1] + route.leasts(visits)
        for index in np.flatnonzero(could < enter[1:]).tolist():
            visit, at = visits[index] + 1, int(enter[index + 1])
            booked = (at - (route.drive(visit) if context.books_ahead else 0)) % period
            late.append((robot, route.vertex(visit), int(could[index]), at, booked))
    ticks = np.array(sorted({booked for *_, booked in late}), np.int64)
    freed_by: dict[tuple[VertexId, int], int] = {}
    for robot, visits in enumerate(seen):
        if visits:
            leave = enters(robot, range(visits.start + 1, visits.stop + 1))
            free = (leave + context.headway) % period
            for index in np.flatnonzero(np.isin(free, ticks)).tolist():
                vertex = context.routes[robot].vertex(visits[index])
                freed_by[vertex, int(free[index])] = robot
    robots = context.robots
    found = [
        LapWait(
            vertex=vertex,
            waits=robots[robot],
            for_robot=robots[freed_by[vertex, booked]],
            tick=Tick((could - begins) % period),
            ticks=Tick(at - could),
        )
        for robot, vertex, could, at, booked in late
        if (vertex, booked) in freed_by  # else it waits for its time in a timetable, or for no one
    ]
    return tuple(sorted(found, key=lambda one: (one.tick, one.waits)))
