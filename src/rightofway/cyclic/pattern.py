"""What repeats: from which tick on, how long, and when who is where in it."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.route import CyclicRoute
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule

__all__ = ["History", "Pattern", "pattern_of"]

History = Sequence[Sequence[int]]
"""For each robot the ticks at which its visits began, from visit 0 on."""

Enters = NDArray[np.int64]
"""The same of one robot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pattern:
    """A pattern that repeats for ever.

    Attributes
    ----------
    transient
        The first tick from which on every robot is where it will be a period later.
    period
        The least number of ticks after which everything comes again.
    counts
        How many laps each robot makes in a period; 0 if it stands still for ever.
    history
        When visits began, for at least a period after the transient.
    lengths
        How many visits a lap of each robot has.
    regular
        For each robot the number of the visit from which on all begin again a period later.
    """

    transient: Tick
    period: Tick
    counts: tuple[int, ...]
    history: tuple[Sequence[int], ...]
    lengths: tuple[int, ...]
    regular: tuple[int, ...]

    @property
    def begins(self) -> int:
        """The tick from which on periods are counted.

        The first robot of the group (that moves at all) comes home there.
        """
        first = next(robot for robot, laps in enumerate(self.counts) if laps)
        return self.enter(first, self._home(first, self.transient))

    def enter(self, robot: int, visit: int) -> int:
        """Return when any visit of a robot begins, as far ahead as you like [ticks]."""
        past = self.history[robot]
        if visit < len(past):
            return past[visit]
        shift = self.counts[robot] * self.lengths[robot]
        periods = -(-(visit + 1 - len(past)) // shift)
        return past[visit - periods * shift] + periods * self.period

    def enters(self, robot: int, visits: range) -> Enters:
        """Return when visits one behind the other begin, as far ahead as you like [ticks]."""
        past = np.asarray(self.history[robot], np.int64)
        numbers = np.arange(visits.start, visits.stop)
        shift = self.counts[robot] * self.lengths[robot]
        periods = np.maximum(-(-(numbers + 1 - len(past)) // max(shift, 1)), 0)
        enters: Enters = past[numbers - periods * shift] + periods * self.period
        return enters

    def visits(self, robot: int) -> range:
        """Return the numbers of a robot's visits in the first period, from home on."""
        home = self._home(robot, self.begins)
        return range(home, home + self.counts[robot] * self.lengths[robot])

    def timetable(self, group: Sequence[CyclicRoute]) -> CyclicSchedule | None:
        """Return its timetable, counted from `begins`; None if a robot stands still for ever."""
        if not all(self.counts):
            return None
        return CyclicSchedule(
            robots=tuple(endless.robot for endless in group),
            laps=tuple(endless.lap for endless in group),
            counts=self.counts,
            period=self.period,
            enter=tuple(
                self.enters(robot, self.visits(robot)) - self.begins for robot in range(len(group))
            ),
        )

    def _home(self, robot: int, tick: int) -> int:
        """Return the first visit home from a tick on, that is regular."""
        visit = max(bisect_left(self.history[robot], tick), self.regular[robot])
        length = self.lengths[robot]
        return -(-visit // length) * length


def pattern_of(history: History, lengths: Sequence[int], known: tuple[int, int]) -> Pattern:
    """Return the least pattern of a history.

    Parameters
    ----------
    history
        When visits began; all up to the later one of two ticks.
    lengths
        How many visits a lap of each robot has.
    known
        Two ticks of which it is known that everything after the one comes again after the other.
    """
    pasts = [np.asarray(past, np.int64) for past in history]
    shifts, period = _least(pasts, lengths, known)
    regular = tuple(
        _regular(enter, shift, period) for enter, shift in zip(pasts, shifts, strict=True)
    )
    return Pattern(
        transient=Tick(max(map(_last_exception, pasts, shifts, regular, [period] * len(pasts)))),
        period=Tick(period),
        counts=tuple(shift // length for shift, length in zip(shifts, lengths, strict=True)),
        history=tuple(history),
        lengths=tuple(lengths),
        regular=regular,
    )


def _least(
    pasts: Sequence[Enters], lengths: Sequence[int], known: tuple[int, int]
) -> tuple[list[int], int]:
    """Return by how many visits each robot goes on in the least period, and the period."""
    begins, again = known
    first = [int(np.searchsorted(enter, begins, side="right")) for enter in pasts]
    shifts = [len(enter) - start for enter, start in zip(pasts, first, strict=True)]
    laps = [shift // length for shift, length in zip(shifts, lengths, strict=True)]
    period, most = again - begins, math.gcd(*laps)
    for parts in range(most, 1, -1):
        smaller = [shift // parts for shift in shifts]
        if most % parts == period % parts == 0 and all(
            _repeats(enter[start:], shift, period // parts)
            for enter, start, shift in zip(pasts, first, smaller, strict=True)
        ):
            return smaller, period // parts
    return shifts, period


def _repeats(enter: Enters, shift: int, period: int) -> bool:
    return bool(np.all(enter[shift:] == enter[: len(enter) - shift] + period))


def _regular(enter: Enters, shift: int, period: int) -> int:
    """Return the first visit from which on all begin again a period later."""
    if not shift:
        return len(enter) - 1
    [others] = np.nonzero(enter[shift:] != enter[:-shift] + period)
    return int(others[-1]) + 1 if len(others) else 0


def _last_exception(enter: Enters, shift: int, regular: int, period: int) -> int:
    """Return from when on the robot is where it will be a period later."""
    if not shift:
        return int(enter[-1])
    if not regular:
        return 0
    return max(int(enter[regular - 1]), int(enter[regular - 1 + shift]) - period, 0)
