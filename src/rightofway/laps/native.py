"""The rules that see two robots only, on endless routes, by the native kernel.

It decides what `rolling` decides with the same rule, so that one is the other's oracle; but instead
of a window for each cut it keeps one precedence graph, and drops what is past.
"""

from __future__ import annotations

import numpy as np

from rightofway import _core
from rightofway.errors import GaveUp
from rightofway.laps.giving import Deadlock
from rightofway.laps.past import Past
from rightofway.laps.rolling import MEMORY, MOST_LAG, PATIENCE, Pace
from rightofway.laps.window import Ground
from rightofway.model import Tick, VertexId
from rightofway.planners import Deadline

__all__ = ["Native"]

OPEN, REPEATS = 0, 1
"""How the kernel ends; otherwise in a deadlock."""


class Native:
    """A group of robots that go on and on, and can be stopped in between.

    Parameters
    ----------
    ground
        The group.
    rule
        ``first-come`` or ``fixed-order``.
    """

    def __init__(self, ground: Ground, rule: str) -> None:
        self.ground = ground
        pace, laps = Pace.of(ground.group, rule), [endless.lap for endless in ground.group]
        drive = np.array([ticks for lap in laps for ticks in lap.drive], np.int64)
        self._kernel = _core.EndlessRun(
            np.cumsum([0, *map(len, laps)], dtype=np.int32),
            np.array([vertex for lap in laps for vertex in lap.vertices], np.int32),
            np.array([lap.least(place) for lap in laps for place in range(len(lap))], np.int64),
            drive if ground.books_ahead else np.zeros_like(drive),
            np.array([endless.first_least for endless in ground.group], np.int64),
            headway=int(ground.headway),
            pacemaker=pace.pacemaker,
            lag=pace.ticks,
            most_lag=MOST_LAG * pace.longest,
            patience=PATIENCE * pace.longest,
            reach=ground.reach,
            memory=MEMORY,
            fixed_order=rule == "fixed-order",
        )

    @property
    def history(self) -> tuple[Past, ...]:
        """For each robot when its visits so far began."""
        pasts = zip(self.ground.group, self._kernel.begun().tolist(), strict=True)
        return tuple(
            Past(endless, begun, *self._kernel.waits(robot))
            for robot, (endless, begun) in enumerate(pasts)
        )

    def until_it_repeats(self, deadline: Deadline) -> tuple[int, int]:
        """Go on until the state at a cut is the same as at an earlier one; return both ticks.

        Raises
        ------
        Deadlock
            If the rule runs into one.
        GaveUp
            If time runs out; it can be asked again.
        """
        end = self._kernel.go_on(deadline.seconds_left())
        if end == REPEATS:
            return self._kernel.came_before, self._kernel.cut
        if end == OPEN:
            raise GaveUp("time ran out before a state came again (give a longer time limit)")
        i, j, vertex, tick, circle = self._kernel.deadlock()
        raise Deadlock((i, j), VertexId(vertex), Tick(tick), circle.tolist())
