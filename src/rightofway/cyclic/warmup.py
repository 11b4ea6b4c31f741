"""How long laps take where no state came again: means of what was seen, without the warm-up.

All robots set out at once, and it takes some laps until they have met each other often enough to
forget that. How many laps of all robots end in each slot, as long as the longest lap, says when:
the warm-up is what has to be left out for the mean of the rest to be known best, by its marginal
standard error, and never more than half.

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

__all__ = ["Measured", "measure"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """Means of the laps that were seen, not proven to be those of the long run.

    Attributes
    ----------
    warm_up
        Laps that began before this tick are left out.
    laps
        Of how many laps of each robot the mean is; 0 if it made none.
    means
        How long a lap of each robot takes on average [ticks]; None if it made none.
    """

    warm_up: Tick
    laps: tuple[int, ...]
    means: tuple[Fraction | None, ...]


def measure(group: Sequence[CyclicRoute], history: History) -> Measured:
    """Measure the laps of a group.

    Parameters
    ----------
    group
        The endless routes of its robots.
    history
        When their visits began.

    Notes
    -----
    A robot that made no whole lap since the warm-up is told by its last one. The lap that it is on
    counts as well as soon as it takes longer than the others: a robot may stand for ever, which no
    lap that ended would show.
    """
    homes = [
        np.array(past[:: len(endless.lap)], np.int64)
        for endless, past in zip(group, history, strict=True)
    ]
    slot, until = max(endless.lap.duration for endless in group), max(past[-1] for past in history)
    warm_up = warm_up_of(homes, slot, until)
    firsts = [min(int(np.searchsorted(home, warm_up)), max(len(home) - 2, 0)) for home in homes]
    laps = [len(home) - 1 - first for home, first in zip(homes, firsts, strict=True)]
    return Measured(
        warm_up=Tick(warm_up),
        laps=tuple(laps),
        means=tuple(
            max(Fraction(int(home[-1] - home[first]), n), Fraction(int(until - home[first]), n + 1))
            if n
            else None
            for home, first, n in zip(homes, firsts, laps, strict=True)
        ),
    )


def warm_up_of(homes: Sequence[NDArray[np.int64]], slot: int, until: int) -> int:
    """Return the tick at which the warm-up is over.

    Parameters
    ----------
    homes
        For each robot when it was at home; first at the beginning.
    slot
        How long slots are [ticks].
    until
        All laps that ended by then are known [ticks].
    """
    n_slots = until // slot
    if not n_slots:
        return 0
    ends = np.concatenate([home[1:] for home in homes]) // slot
    ended = np.bincount(ends[ends < n_slots], minlength=n_slots).astype(np.float64)
    left = np.arange(n_slots, 0, -1)
    sums, squares = (np.cumsum(part[::-1])[::-1] for part in (ended, ended**2))
    errors = (squares - sums**2 / left) / left**2
    return int(np.argmin(errors[: n_slots // 2 + 1])) * slot
