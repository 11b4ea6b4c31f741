"""Enters of visits: in a simulation, and in the pattern that repeats after a recurrence."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

from rightofway.cyclic.route import CyclicRoute, GroupContext
from rightofway.model import Tick
from rightofway.precedence import CyclicSchedule

History = Sequence[Sequence[int]]
"""For each robot, the enters of its visits from visit 0 on [ticks]."""

Enters = NDArray[np.int64]
"""The enters of consecutive visits of one robot [ticks]."""


class VisitTimes(Sequence[int]):
    """The enters of a robot's first visits, stored as waits; a sequence of ticks.

    ``late``: the visits with a wait; ``waited``: total waiting up to each of them [ticks].
    """

    __slots__ = ("_begun", "_late", "_route", "_waited")

    def __init__(
        self, route: CyclicRoute, begun: int, late: NDArray[np.int32], waited: NDArray[np.int64]
    ) -> None:
        self._route = route
        self._begun = begun
        self._late = late
        self._waited = np.concatenate(([0], waited))

    def __len__(self) -> int:
        return self._begun

    @overload
    def __getitem__(self, index: int) -> int: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[int, ...]: ...
    def __getitem__(self, index: int | slice) -> int | tuple[int, ...]:
        visits = range(self._begun)[index]
        if isinstance(visits, range):
            return tuple(self.enters(visits).tolist())
        return int(self.enters(range(visits, visits + 1))[0])

    def __iter__(self) -> Iterator[int]:
        return iter(self.enters(range(self._begun)).tolist())

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> Enters:
        return self.enters(range(self._begun)).astype(dtype or np.int64, copy=bool(copy))

    def enters(self, visits: range) -> Enters:
        """Return the enters of some visits [ticks]."""
        if not visits:
            return np.empty(0, np.int64)
        if visits.step != 1:
            numbers = np.arange(visits.start, visits.stop, visits.step)
            waits = np.searchsorted(self._late, numbers, side="right")
            return self._route.compute_undelayed(visits) + self._waited[waits]
        first, stop = np.searchsorted(self._late, (visits.start, visits.stop - 1), side="right")
        sizes = np.diff(self._late[first:stop], prepend=visits.start, append=visits.stop)
        waited: Enters = np.repeat(self._waited[first : stop + 1], sizes)
        return self._route.compute_undelayed(visits) + waited


@dataclass(frozen=True, slots=True, kw_only=True)
class Pattern:
    """A pattern that repeats permanently.

    Attributes
    ----------
    transient
        The first tick from which on positions repeat after one period.
    period
        The least period of all robots [ticks].
    counts
        Laps of each robot per period; 0 if it is permanently stuck.
    history
        The enters of visits, for at least a period after the transient [ticks].
    lengths
        Visits per lap of each robot.
    regular
        For each robot, the first visit from which on enters repeat after one period.
    """

    transient: Tick
    period: Tick
    counts: tuple[int, ...]
    history: tuple[Sequence[int], ...]
    lengths: tuple[int, ...]
    regular: tuple[int, ...]

    @property
    def begins(self) -> int:
        """The tick at which periods begin: the first moving robot is home."""
        first = next(robot for robot, laps in enumerate(self.counts) if laps)
        return self.enter(first, self._find_home(first, self.transient))

    @property
    def n_visits(self) -> int:
        """The number of visits of all robots in a period."""
        return sum(laps * length for laps, length in zip(self.counts, self.lengths, strict=True))

    def enter(self, robot: int, visit: int) -> int:
        """Return the enter of any visit of a robot [ticks]."""
        past = self.history[robot]
        if visit < len(past):
            return past[visit]
        shift = self.counts[robot] * self.lengths[robot]
        periods = -(-(visit + 1 - len(past)) // shift)
        return past[visit - periods * shift] + periods * self.period

    def enters(self, robot: int, visits: range) -> Enters:
        """Return the enters of any consecutive visits of a robot [ticks]."""
        past = np.asarray(self.history[robot], np.int64)
        numbers = np.arange(visits.start, visits.stop)
        shift = self.counts[robot] * self.lengths[robot]
        periods = np.maximum(-(-(numbers + 1 - len(past)) // max(shift, 1)), 0)
        enters: Enters = past[numbers - periods * shift] + periods * self.period
        return enters

    def list_visits(self, robot: int) -> range:
        """Return the numbers of a robot's visits in the first period, from home on."""
        home = self._find_home(robot, self.begins)
        return range(home, home + self.counts[robot] * self.lengths[robot])

    def make_timetable(self, context: GroupContext) -> CyclicSchedule | None:
        """Return one period, counted from `begins`; None if a robot is permanently stuck."""
        if not all(self.counts):
            return None
        return CyclicSchedule(
            robots=context.robots,
            laps=tuple(context.laps),
            counts=self.counts,
            period=self.period,
            enter=tuple(
                self.enters(robot, self.list_visits(robot)) - self.begins
                for robot in range(len(context))
            ),
        )

    def _find_home(self, robot: int, tick: int) -> int:
        """Return the first regular visit home from a tick on."""
        visit = max(bisect_left(self.history[robot], tick), self.regular[robot])
        length = self.lengths[robot]
        return -(-visit // length) * length


def find_pattern(history: History, lengths: Sequence[int], recurrence: tuple[int, int]) -> Pattern:
    """Return the pattern with the least period in a history that ends at a recurrence.

    ``recurrence``: the ticks of two equal states; visits after the first tick repeat after the
    second tick.
    """
    pasts = [np.asarray(past, np.int64) for past in history]
    begins, again = recurrence
    first = [int(np.searchsorted(enter, begins, side="right")) for enter in pasts]
    shifts = [len(enter) - start for enter, start in zip(pasts, first, strict=True)]
    laps = [shift // length for shift, length in zip(shifts, lengths, strict=True)]
    period, most = again - begins, math.gcd(*laps)
    for parts in range(most, 1, -1):
        smaller = [shift // parts for shift in shifts]
        if most % parts == period % parts == 0 and all(
            np.all(enter[start + shift :] == enter[start : len(enter) - shift] + period // parts)
            for enter, start, shift in zip(pasts, first, smaller, strict=True)
        ):
            shifts, period = smaller, period // parts
            break
    regular = [_find_regular(*row, period) for row in zip(pasts, shifts, strict=True)]
    irregular_until = [
        _find_irregular_end(*row, period) for row in zip(pasts, shifts, regular, strict=True)
    ]
    return Pattern(
        transient=Tick(max(irregular_until)),
        period=Tick(period),
        counts=tuple(shift // length for shift, length in zip(shifts, lengths, strict=True)),
        history=tuple(history),
        lengths=tuple(lengths),
        regular=tuple(regular),
    )


def _find_regular(enter: Enters, shift: int, period: int) -> int:
    """Return the first visit from which on enters repeat after one period."""
    if not shift:
        return len(enter) - 1
    [others] = np.nonzero(enter[shift:] != enter[:-shift] + period)
    return int(others[-1]) + 1 if len(others) else 0


def _find_irregular_end(enter: Enters, shift: int, regular: int, period: int) -> int:
    """Return the tick from which on the robot's position repeats after one period."""
    if not shift:
        return int(enter[-1])
    if not regular:
        return 0
    return max(int(enter[regular - 1]), int(enter[regular - 1 + shift]) - period, 0)
