"""MSER: mean lap times of a simulation in which no state recurred, without its warm-up.

All robots set out at once, and it takes some laps until that has no effect any more. Time is
divided into slots as long as the longest lap, and the laps of all robots that end in each slot are
counted. The warm-up ends where the marginal standard error of the remaining counts is least, and at
half of the time at the latest.

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
    """Mean lap times that were measured, not proven to hold in the long run."""

    warm_up: Tick  # laps that began before this tick are left out
    laps: tuple[int, ...]  # the number of laps of each robot that its mean is of
    means: tuple[Fraction | None, ...]  # the mean lap time of each robot [ticks]; None without laps


def homes_of(routes: Sequence[CyclicRoute], history: History) -> list[NDArray[np.int64]]:
    """Return for each robot the enters of its visits home; the first is visit 0 [ticks]."""
    rows = zip(routes, history, strict=True)
    return [np.asarray(past[:: len(route)], np.int64) for route, past in rows]


def measure(routes: Sequence[CyclicRoute], history: History) -> MeasuredLaps:
    """Measure the mean lap time of each robot.

    A robot that made no whole lap since the warm-up is represented by its last lap. The unfinished
    lap counts as well as soon as it takes longer than the mean of the others: a robot may stand
    still for ever, which no finished lap would show.
    """
    homes = homes_of(routes, history)
    slot, until = max(route.lap.duration for route in routes), max(past[-1] for past in history)
    warm_up = warm_up_of(homes, slot, until)
    laps, means = [], []
    for home in homes:
        first = min(int(np.searchsorted(home, warm_up)), max(len(home) - 2, 0))
        n = len(home) - 1 - first
        laps.append(n)
        finished, all_laps = int(home[-1] - home[first]), int(until - home[first])
        means.append(max(Fraction(finished, n), Fraction(all_laps, n + 1)) if n else None)
    return MeasuredLaps(warm_up=Tick(warm_up), laps=tuple(laps), means=tuple(means))


def warm_up_of(homes: Sequence[NDArray[np.int64]], slot: int, until: int) -> int:
    """Return the tick at which the warm-up is over, where all laps that end by a tick are known."""
    n_slots = until // slot
    if not n_slots:
        return 0
    ends = np.concatenate([home[1:] for home in homes]) // slot
    ended = np.bincount(ends[ends < n_slots], minlength=n_slots).astype(np.float64)
    left = np.arange(n_slots, 0, -1)
    sums, squares = (np.cumsum(part[::-1])[::-1] for part in (ended, ended**2))
    errors = (squares - sums**2 / left) / left**2
    return int(np.argmin(errors[: n_slots // 2 + 1])) * slot
