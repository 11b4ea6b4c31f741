"""MSER: mean lap times of a simulation in which no state recurred, without its warm-up.

All robots start at once, and the effect of the start lasts for some laps. Time is divided into
slots of the longest lap, and the ends of laps of all robots are counted per slot. The warm-up ends
at the slot with the least marginal standard error of the remaining counts, and at half of the time
at the latest.

References
----------
White, *An effective truncation heuristic for bias reduction in simulation output*, Simulation 69,
1997.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.pattern import History
from rightofway.cyclic.route import CyclicRoute
from rightofway.model import Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredLaps:
    """Measured mean lap times, not proven for the long run."""

    warm_up: Tick  # earlier laps are left out
    laps: tuple[int, ...]  # number of measured laps of each robot
    means: tuple[Fraction | None, ...]  # the mean lap time of each robot [ticks]; None without laps


def find_homes(routes: Sequence[CyclicRoute], history: History) -> list[NDArray[np.int64]]:
    """Return for each robot the enters of its visits home, from visit 0 on [ticks]."""
    rows = zip(routes, history, strict=True)
    return [np.asarray(past[:: len(route)], np.int64) for route, past in rows]


def measure(routes: Sequence[CyclicRoute], history: History) -> MeasuredLaps:
    """Measure the mean lap time of each robot.

    A robot without a whole lap since the warm-up is represented by its last lap. The unfinished lap
    counts, too, once it is longer than the mean of the finished laps: a robot may stand still for
    ever, which finished laps do not show.
    """
    homes = find_homes(routes, history)
    slot, until = max(route.lap.duration for route in routes), max(past[-1] for past in history)
    warm_up = find_warm_up(homes, slot, until)
    laps, means = [], []
    for home in homes:
        first = min(int(np.searchsorted(home, warm_up)), max(len(home) - 2, 0))
        n = len(home) - 1 - first
        laps.append(n)
        finished, all_laps = int(home[-1] - home[first]), int(until - home[first])
        means.append(max(Fraction(finished, n), Fraction(all_laps, n + 1)) if n else None)
    return MeasuredLaps(warm_up=Tick(warm_up), laps=tuple(laps), means=tuple(means))


def find_warm_up(homes: Sequence[NDArray[np.int64]], slot: int, until: int) -> int:
    """Return the tick at the end of the warm-up; laps that end by a given tick are known."""
    n_slots = until // slot
    if not n_slots:
        return 0
    ends = np.concatenate([home[1:] for home in homes]) // slot
    ended = np.bincount(ends[ends < n_slots], minlength=n_slots).astype(np.float64)
    left = np.arange(n_slots, 0, -1)
    sums, squares = (np.cumsum(part[::-1])[::-1] for part in (ended, ended**2))
    errors = (squares - sums**2 / left) / left**2
    return int(np.argmin(errors[: n_slots // 2 + 1])) * slot
