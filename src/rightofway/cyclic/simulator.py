"""Wrapper of the native simulator of repeated laps, for rules that consider two robots only.

One precedence graph rolls along: past visits are dropped, and visits of later laps are added, so
that times are updated incrementally.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from rightofway import _core
from rightofway.cyclic.pattern import VisitTimes
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.rules import NATIVE_RULES
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Lap, Tick
from rightofway.native import BookedRows, bind_rows, bind_rules
from rightofway.planners import Deadline
from rightofway.site import VertexId

OPEN, REPEATS = 0, 1
"""Ends reported by the kernel; any other end is a deadlock."""

LAP_LOSS = 1 << 40
"""The cost of a lost lap, in units fine enough for the cost of a tick."""


class Deadlock(Exception):
    """No right of way keeps two robots (positions in the group) apart.

    ``circle`` lists robots, each waiting for the next. It is empty without a cycle: then one of the
    two robots stays, or is already, at a vertex of the other.
    """

    def __init__(
        self, robots: tuple[int, int], vertex: VertexId, tick: Tick, circle: Iterable[int]
    ) -> None:
        self.robots = robots
        self.vertex = vertex
        self.tick = tick
        self.circle = tuple(circle)
        super().__init__()


@dataclass(frozen=True, slots=True, kw_only=True)
class HorizonParams:
    """Parameters of the rolling horizon of a simulation of repeated laps."""

    patience: int = 8  # Longest absence of a pacemaker from home [longest laps].
    pacemaker_part: int = 4  # Least pacemaker lap: longest lap divided by this.
    most_lag: int = 4  # Longest lag [longest laps].
    memory: int = 32  # Number of windows that can be undone.
    window_lags: int = 3  # Initial length of a window [lags].


DEFAULT = HorizonParams()


def choose_pacemaker(laps: Sequence[Lap], least: int) -> int:
    """Return the robot with the shortest lap of at least the given ticks."""
    durations = [lap.duration for lap in laps]
    return durations.index(min(duration for duration in durations if duration >= least))


class CyclicSimulator:
    """A group of robots that repeat their laps under one of `NATIVE_RULES`.

    A cut is made whenever the *pacemaker* is home. Meetings less than a *lag* after a cut are
    resolved before the visits up to the cut are frozen.
    """

    def __init__(self, context: GroupContext, rule: str, params: HorizonParams = DEFAULT) -> None:
        self.context = context
        laps, longest = context.laps, context.longest
        pacemaker = choose_pacemaker(laps, -(-longest // params.pacemaker_part))
        rows = BookedRows.of_laps(context.scenario.problem, context.robots, laps, [1] * len(laps))
        self._kernel = _core.CyclicSimulator(
            bind_rules(context.booking_rules),
            _core.Routes(
                np.cumsum([0, *map(len, laps)], dtype=np.int32),
                np.array([vertex for lap in laps for vertex in lap.vertices], np.int32),
                np.array([ticks for lap in laps for ticks in lap.dwell], np.int64),
                np.array([ticks for lap in laps for ticks in lap.drive], np.int64),
            ),
            np.array([route.first_least for route in context.routes], np.int64),
            _core.Horizon(
                pacemaker=pacemaker,
                lag=laps[pacemaker].duration,
                most_lag=params.most_lag * longest,
                patience=params.patience * longest,
                reach=context.reach,
                memory=params.memory,
            ),
            rule=NATIVE_RULES.index(rule),
            loss=np.array([max(LAP_LOSS // lap.duration, 1) for lap in laps], np.int64),
            rows=bind_rows(rows),
        )

    @property
    def history(self) -> list[VisitTimes]:
        """For each robot, the enters of its visits so far [ticks]."""
        begun = self._kernel.started().tolist()
        return [
            VisitTimes(route, begun[robot], *self._kernel.waits(robot))
            for robot, route in enumerate(self.context.routes)
        ]

    def advance(self, deadline: Deadline) -> tuple[int, int]:
        """Continue until the states at two cuts are equal; return both ticks.

        Exact and deterministic; Ctrl-C interrupts.

        Raises
        ------
        Deadlock
            If a deadlock remains at the longest lag.
        GaveUp
            If time runs out; another call continues.
        """
        answer = self._kernel.advance(deadline.measure_seconds_left())
        if answer == OPEN:
            raise GaveUp(Fact("time over without a state again"))
        if answer == REPEATS:
            return self._kernel.first_seen, self._kernel.cut
        i, j, vertex, tick, circle = self._kernel.deadlock()
        raise Deadlock((i, j), VertexId(vertex), Tick(tick), circle.tolist())

    def set_rule(self, rule: str) -> None:
        """Change the rule from the current cut on, and forget the states seen."""
        self._kernel.set_rule(NATIVE_RULES.index(rule))

    def reset_states(self) -> None:
        """Forget the states seen, so that `advance` continues after a recurrence."""
        self._kernel.reset_states()
