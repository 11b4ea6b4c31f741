"""Simulation of laps that repeat, under a rule that considers two robots.

One precedence graph holds a window of visits that moves with time: past visits are dropped, later
ones are added, and the times of all others are kept up to date.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Lap, Tick, VertexId

__all__ = ["CyclicSimulator", "Horizon", "UnresolvedConflict"]

ENDS: tuple[Literal["open", "repeats", "deadlock"], ...] = ("open", "repeats", "deadlock")
"""The outcomes of `advance`, in the order of the kernel."""

KERNEL_RULES = ("first-come", "fixed-order", "least-loss")
"""The rules of the kernel, in its order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Horizon:
    """The window of a simulation; all but `pacemaker` and `memory` in ticks.

    Attributes
    ----------
    pacemaker
        At first, cuts are made where this robot is home.
    lag
        Conflicts up to this long after a cut are resolved before all visits up to it are frozen.
    most_lag
        The longest lag, where shorter ones did not suffice.
    patience
        A pacemaker that stays away longer is replaced.
    reach
        Visits left so long before a cut still matter.
    memory
        How many cuts can be undone.
    """

    pacemaker: int
    lag: int
    most_lag: int
    patience: int
    reach: int
    memory: int


class UnresolvedConflict(NamedTuple):
    """A deadlock: two robots in conflict, and the robots that would each wait for the next."""

    robots: tuple[int, int]
    vertex: VertexId
    tick: Tick
    waiting_cycle: tuple[int, ...]


class CyclicSimulator:
    """Robots that repeat their laps until a state recurs.

    Parameters
    ----------
    laps
        The lap of each robot.
    first_least
        For each robot the least ticks of its very first visit, in which it does not turn.
    horizon
        The window of the simulation.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there.
    rule
        The robot that goes first: the one that would enter a segment first (``first-come``), the
        one listed first (``fixed-order``), or the one that would lose more by waiting
        (``least-loss``).
    losses
        The cost of a tick of waiting for each robot, above 0.
    """

    def __init__(
        self,
        laps: Sequence[Lap],
        first_least: Sequence[Tick],
        horizon: Horizon,
        *,
        headway: Tick,
        books_ahead: bool,
        rule: str,
        losses: Sequence[int],
    ) -> None:
        drive = np.array([ticks for lap in laps for ticks in lap.drive], np.int64)
        self._kernel = _core.CyclicSimulator(
            np.cumsum([0, *map(len, laps)], dtype=np.int32),
            np.array([vertex for lap in laps for vertex in lap.vertices], np.int32),
            np.array([ticks for lap in laps for ticks in lap.leasts()], np.int64),
            drive if books_ahead else np.zeros_like(drive),
            np.array(first_least, np.int64),
            headway=int(headway),
            pacemaker=horizon.pacemaker,
            lag=horizon.lag,
            most_lag=horizon.most_lag,
            patience=horizon.patience,
            reach=horizon.reach,
            memory=horizon.memory,
            rule=KERNEL_RULES.index(rule),
            loss=np.array(losses, np.int64),
        )

    def advance(self, seconds: float | None) -> Literal["open", "repeats", "deadlock"]:
        """Simulate until a state recurs, a deadlock, or time is over; the next call continues.

        Notes
        -----
        Exact and deterministic. Ctrl-C is obeyed.
        """
        return ENDS[self._kernel.advance(seconds)]

    def reset_states(self) -> None:
        """Forget the states seen, to advance beyond one that has recurred."""
        self._kernel.reset_states()

    def set_rule(self, rule: str) -> None:
        """Decide by another rule from now on, and reset the states."""
        self._kernel.set_rule(KERNEL_RULES.index(rule))

    def recurrence(self) -> tuple[int, int]:
        """Return when the recurring state was seen first, and when it recurred [ticks]."""
        return self._kernel.first_seen, self._kernel.cut

    def started(self) -> list[int]:
        """Return how many visits of each robot have started."""
        counts: list[int] = self._kernel.started().tolist()
        return counts

    def waits(self, robot: int) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        """Return the visits of a robot that had to wait, and its waits by then in all [ticks]."""
        return self._kernel.waits(robot)

    def deadlock(self) -> UnresolvedConflict:
        """Return the conflict that `advance` could not resolve."""
        i, j, vertex, tick, cycle = self._kernel.deadlock()
        return UnresolvedConflict((i, j), VertexId(vertex), Tick(tick), tuple(cycle.tolist()))
