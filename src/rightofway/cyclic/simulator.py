"""Laps without an end, under a rule that sees two robots: one precedence graph that rolls along.

What is long past is dropped from the graph, and the laps to come are added, so all times are kept
up to date and never found anew.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Lap, Tick, VertexId

__all__ = ["CyclicSimulator", "Horizon", "Standstill"]

ENDS: tuple[Literal["open", "repeats", "deadlock"], ...] = ("open", "repeats", "deadlock")
"""How the kernel tells what came of it."""

KERNEL_RULES = ("first-come", "fixed-order", "least-loss")
"""The rules that the kernel knows, in its order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Horizon:
    """How far robots look ahead and back; all but the first and the last in ticks.

    Attributes
    ----------
    pacemaker
        Cuts are made where this robot is home, at first.
    lag
        What meets less than this after a cut is settled before everything up to there is frozen.
    most_lag
        How long the lag may get where it was too short.
    patience
        How long a pacemaker may stay away.
    reach
        How long before a cut visits may have been left that still matter.
    memory
        How many cuts can be taken back.
    """

    pacemaker: int
    lag: int
    most_lag: int
    patience: int
    reach: int
    memory: int


class Standstill(NamedTuple):
    """A deadlock: two robots that cannot be kept apart, and who would each wait for the next."""

    robots: tuple[int, int]
    vertex: VertexId
    tick: Tick
    circle: tuple[int, ...]


class CyclicSimulator:
    """Robots that repeat their laps until a state comes again.

    Parameters
    ----------
    laps
        What each robot repeats.
    first_least
        For each robot the least ticks of its very first visit, which nobody turns for.
    look
        How far ahead and back.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there.
    rule
        Who goes first: who would enter a segment first (``first-come``), who is listed first
        (``fixed-order``), or who would lose more by waiting for the other one (``least-loss``).
    losses
        What a tick of waiting costs each robot, above 0.
    """

    def __init__(
        self,
        laps: Sequence[Lap],
        first_least: Sequence[Tick],
        look: Horizon,
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
            pacemaker=look.pacemaker,
            lag=look.lag,
            most_lag=look.most_lag,
            patience=look.patience,
            reach=look.reach,
            memory=look.memory,
            rule=KERNEL_RULES.index(rule),
            loss=np.array(losses, np.int64),
        )

    def go_on(self, seconds: float | None) -> Literal["open", "repeats", "deadlock"]:
        """Go on until a state comes again, a deadlock, or time is over; then it can be asked again.

        Notes
        -----
        Exact and deterministic. Ctrl-C is obeyed.
        """
        return ENDS[self._kernel.go_on(seconds)]

    def forget(self) -> None:
        """Forget the states seen, so that it goes on where one came again."""
        self._kernel.forget()

    def follow(self, rule: str) -> None:
        """Decide by another rule from now on; states that were seen are forgotten."""
        self._kernel.follow(KERNEL_RULES.index(rule))

    def came_again(self) -> tuple[int, int]:
        """Return when the state was there first, and when it came again [ticks]."""
        return self._kernel.came_before, self._kernel.cut

    def begun(self) -> list[int]:
        """Return how many visits of each robot have begun."""
        counts: list[int] = self._kernel.begun().tolist()
        return counts

    def waits(self, robot: int) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        """Return which visits of a robot were late, and how long it had waited by then [ticks]."""
        return self._kernel.waits(robot)

    def standstill(self) -> Standstill:
        """Return the deadlock that it ran into."""
        i, j, vertex, tick, circle = self._kernel.deadlock()
        return Standstill((i, j), VertexId(vertex), Tick(tick), tuple(circle.tolist()))
