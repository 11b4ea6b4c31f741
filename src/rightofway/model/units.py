"""Integer ticks, exact fractions and how the one becomes the other.

A *tick* is the only unit of time inside the program. What users write (speeds, lengths, times) are
exact fractions of their own units; `choose_clock` finds the tick that makes every duration of a
scenario a whole number.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NewType

from rightofway.kinds.table import TIME_LIMIT

if TYPE_CHECKING:
    from collections.abc import Iterable

Tick = NewType("Tick", int)

NEVER = Tick(2**62)
"""The tick of events that never happen, such as the end of a permanent booking."""

MAX_TICKS_OF_SHORTEST = 1000
"""The shortest duration of a fleet is at most this many ticks long."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """The length of a tick.

    Attributes
    ----------
    tick
        Length of one tick [the scenario's time unit].
    exact
        Whether every duration of the fleet is a whole number of ticks. If not, durations are
        rounded up, so that no robot is asked to go faster than it can.
    """

    tick: Fraction
    exact: bool = True

    def count_ticks(self, duration: Fraction) -> Tick:
        """Return the least number of ticks that lasts at least ``duration`` [time unit]."""
        # The quotient rounded up, in whole numbers: a map may have a million durations.
        above = duration.numerator * self.tick.denominator
        return Tick(-(-above // (duration.denominator * self.tick.numerator)))

    def convert_to_time(self, ticks: int) -> Fraction:
        """Return the duration of ``ticks`` [time unit]."""
        return ticks * self.tick


def choose_clock(durations: Iterable[Fraction]) -> Clock:
    """Return the clock with the largest tick that makes every duration exact.

    Parameters
    ----------
    durations
        All durations of a fleet [time unit]; zeros do not count.

    Notes
    -----
    Where the shortest duration would be longer than `MAX_TICKS_OF_SHORTEST` ticks, the tick is that
    fraction of it and the clock is not exact. Without any positive duration the tick is one unit.
    """
    # Fractions are slow to hash and to compare, and a map may have a million durations.
    ratios = {
        (duration.numerator, duration.denominator)
        for duration in durations
        if duration.numerator > 0
    }
    if not ratios:
        return Clock(tick=Fraction(1))
    # The greatest common divisor of fractions in lowest terms.
    numerators, denominators = map(set, zip(*ratios, strict=True))
    tick = Fraction(math.gcd(*numerators), math.lcm(*denominators))
    least = min(above / below for above, below in ratios)
    shortest = min(Fraction(*ratio) for ratio in ratios if ratio[0] / ratio[1] == least)
    if shortest / tick > MAX_TICKS_OF_SHORTEST:
        return Clock(tick=shortest / MAX_TICKS_OF_SHORTEST, exact=False)
    return Clock(tick=tick)


def require_time_limit(seconds: float | None) -> float | None:
    """Return a time limit that a caller gave [s]; None for no limit, also above every float.

    Parameters
    ----------
    seconds
        A time limit [s]; None for no limit.

    Raises
    ------
    InputError
        If it is negative or no number.
    """
    return TIME_LIMIT.read_at("time_limit", seconds)
