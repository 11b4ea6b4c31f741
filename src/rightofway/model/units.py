"""Exact numbers as users write them, integer ticks, and how the one becomes the other.

A *tick* is the only unit of time inside the program. What users write (speeds, lengths, times) are
exact fractions of their own units; `choose_clock` finds the tick that makes every duration of a
scenario a whole number.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import TYPE_CHECKING, NewType

from rightofway.errors import shown

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = [
    "COORDINATE_DIGITS",
    "DIGITS",
    "MAX_TICKS_OF_SHORTEST",
    "NEVER",
    "PATTERN",
    "Clock",
    "Number",
    "Tick",
    "VertexId",
    "choose_clock",
    "exact",
    "written",
]

Tick = NewType("Tick", int)
VertexId = NewType("VertexId", int)

NEVER = Tick(2**62)
"""The tick of what never happens, such as the end of a booking that never ends."""

Number = int | float | str | Decimal | Fraction
"""A number as users write it: ``2``, ``0.5``, ``"1/3"``; never rounded, see `exact`."""

MAX_TICKS_OF_SHORTEST = 1000
"""The shortest duration of a fleet is at most this many ticks long."""

DIGITS = 18
"""Numerator and denominator of a speed, a length or a time have at most that many digits."""

COORDINATE_DIGITS = 400
"""The same for coordinates and the tick: any decimal that stands for a float fits in."""

PATTERN = r"[+-]?([0-9]+/[0-9]+|([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?)"
"""How a number may be written as text; a dialect that JSON Schema understands too."""

_NUMBER = re.compile(PATTERN.replace("([eE][+-]?[0-9]+)", "([eE](?P<exponent>[+-]?[0-9]+))"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """How long a tick is.

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

    def ticks(self, duration: Fraction) -> Tick:
        """Return the least number of ticks that lasts at least ``duration`` [time unit]."""
        return Tick(math.ceil(duration / self.tick))

    def time(self, ticks: int) -> Fraction:
        """Return how long ``ticks`` last [time unit]."""
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
    positive = {duration for duration in durations if duration > 0}
    if not positive:
        return Clock(tick=Fraction(1))
    tick = _greatest_common_divisor(positive)
    shortest = min(positive)
    if shortest / tick > MAX_TICKS_OF_SHORTEST:
        return Clock(tick=shortest / MAX_TICKS_OF_SHORTEST, exact=False)
    return Clock(tick=tick)


def _greatest_common_divisor(fractions: Iterable[Fraction]) -> Fraction:
    numerators, denominators = zip(*((f.numerator, f.denominator) for f in fractions), strict=True)
    return Fraction(math.gcd(*numerators), math.lcm(*denominators))


def exact(value: object, *, digits: int = DIGITS) -> Fraction:
    """Return the number that was written, exactly.

    Parameters
    ----------
    value
        A whole number, a decimal, a fraction, or text like ``0.1``, ``2e-3``, ``1/3``. A float
        counts as the shortest decimal that stands for it.
    digits
        The most digits of numerator and denominator.

    Raises
    ------
    ValueError
        For anything else: words, true and false, NaN, infinity, 1/0, and numbers out of range.
    """
    if isinstance(value, Rational) and not isinstance(value, bool):
        return _in_range(Fraction(int(value.numerator), int(value.denominator)), value, digits)
    text = str(value) if isinstance(value, str | Decimal | float) else ""
    match = _NUMBER.fullmatch(text)
    if not match:
        raise ValueError(f"{shown(value)} is not a number (write it like 3, 0.5 or 1/3)")
    if _is_huge(text, match["exponent"] or "0"):
        raise _out_of_range(value, digits)
    try:
        return _in_range(Fraction(text), value, digits)
    except ZeroDivisionError:
        raise ValueError(f"{shown(value)} divides by zero (give another denominator)") from None


def _is_huge(text: str, exponent: str) -> bool:
    """Return whether computing the number could take long: 1e999999999 would fill the memory."""
    most = 2 * COORDINATE_DIGITS
    return len(text) > most or abs(int(exponent)) > most


def _in_range(number: Fraction, value: object, digits: int) -> Fraction:
    if max(abs(number.numerator), number.denominator) > 10**digits:
        raise _out_of_range(value, digits)
    return number


def _out_of_range(value: object, digits: int) -> ValueError:
    return ValueError(
        f"{shown(value)} is out of range (give at most {digits} digits before and after the point)"
    )


def written(number: Fraction) -> int | str:
    """Return a fraction as documents have it: a whole number, or text like ``1/3``."""
    return number.numerator if number.denominator == 1 else str(number)
