"""A timetable that repeats: laps, how often each is made in a period, and when its visits begin."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Lap, Tick

__all__ = ["CyclicSchedule", "unrolled"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CyclicSchedule:
    """When the robots of a group are where, period after period.

    Attributes
    ----------
    robots
        The numbers of the group's robots in their scenario.
    laps
        What each of them repeats.
    counts
        How many laps each makes in a period; at least 1.
    period
        After how many ticks everything comes again.
    enter
        For each robot the ticks at which its visits of one period begin: ``counts * len(lap)`` of
        them, int64, strictly rising, the first at home in ``[0, period)`` and all before the first
        plus the period. The visit after the last is the first, a period later.
    """

    robots: tuple[int, ...]
    laps: tuple[Lap, ...]
    counts: tuple[int, ...]
    period: Tick
    enter: tuple[NDArray[np.int64], ...]


def unrolled(timetable: CyclicSchedule, times: int) -> CyclicSchedule:
    """Return the same timetable, with so many of its periods as one."""
    period = int(timetable.period)
    shifts = np.arange(times, dtype=np.int64)[:, None] * period
    return replace(
        timetable,
        counts=tuple(count * times for count in timetable.counts),
        period=Tick(period * times),
        enter=tuple((enter + shifts).ravel() for enter in timetable.enter),
    )
