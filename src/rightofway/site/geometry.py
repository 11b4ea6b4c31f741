"""Points: in the site's frame, where users give them, and in the plane that is drawn; distances."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import NewType

from rightofway.errors import InputError
from rightofway.kinds.numbers import COORDINATE_DIGITS, DIGITS

VertexId = NewType("VertexId", int)
"""The number of a vertex."""

Point = tuple[Fraction, Fraction]
"""x and y [length unit]."""

COARSE, FINE = Fraction(1, 1_000), Fraction(1, 1_000_000)
"""Steps of lengths that are rounded up [length unit]: in general, and for distances below 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """The position of the drawn plane in the frame of the site.

    Attributes
    ----------
    x, y
        The plane's point (0, 0) in the site's frame [length unit].
    y_up
        Whether y grows upwards on the site; in the plane it grows downwards.
    yaw
        Angle by which the plane is turned about its point (0, 0), from the site's x to its y [rad].
    """

    x: Fraction = Fraction(0)
    y: Fraction = Fraction(0)
    y_up: bool = False
    yaw: Fraction = Fraction(0)

    def to_site(self, point: Point) -> Point:
        """Return the point of the site at a point of the plane."""
        x, y = point
        if self.y_up:
            y = -y
        if self.yaw:
            cos, sin = self._turn()
            x, y = cos * x - sin * y, sin * x + cos * y
        return self.x + x, self.y + y

    def to_plane(self, point: Point) -> Point:
        """Return the point of the plane at a point of the site."""
        x, y = point[0] - self.x, point[1] - self.y
        if self.yaw:
            cos, sin = self._turn()
            square = cos**2 + sin**2  # nearly 1: both are rounded
            x, y = (cos * x + sin * y) / square, (cos * y - sin * x) / square
        return x, -y if self.y_up else y

    def _turn(self) -> Point:
        """Return cosine and sine of the yaw, to 1e-12."""
        cos, sin = (round(f(self.yaw) * 10**12) for f in (math.cos, math.sin))
        return Fraction(cos, 10**12), Fraction(sin, 10**12)


MOST_BITS, MOST_BITS_OF_ONE = 2**30, 2**14
"""Bits of all positions of a roadmap in whole multiples of one length at most (128 MB), and of one.
All denominators up to 10 000 fit into one position."""

MILLION, FIFTEEN_DIGITS, LARGEST_PART = 10**6, 10**15, 10**COORDINATE_DIGITS


def read_shortest(point: tuple[float, float]) -> Point:
    """Return a point given in floating point; a coordinate is its shortest decimal."""
    return Fraction(repr(point[0])), Fraction(repr(point[1]))


def find_fractions(
    points: Iterable[tuple[float | Fraction, float | Fraction]],
) -> dict[int, Point]:
    """Return the points, by number, of which some coordinate is no shortest decimal: 1/3, say.

    Of all others, floating point keeps the exact position.

    Raises
    ------
    InputError
        If a coordinate has too many digits for a file, or points in whole multiples of one length
        take more than `MOST_BITS` or `MOST_BITS_OF_ONE`.
    """
    scale, fractions, number = 1, dict[int, Point](), -1
    for number, point in enumerate(points):
        if all(map(_is_shortest_decimal, point)):
            continue
        x, y = (Fraction(repr(float(c))) if isinstance(c, float) else c for c in point)
        fractions[number] = x, y
        if max(abs(x.numerator), x.denominator, abs(y.numerator), y.denominator) > LARGEST_PART:
            raise InputError.at("vertices", "a position has too many digits (give decimals)")
        scale = lcm(scale, x.denominator, y.denominator)
        _refuse_large_scale(scale, len(fractions))
    _refuse_large_scale(scale if fractions else 1, number + 1)
    return fractions


def _refuse_large_scale(scale: int, n_points: int) -> None:
    """Refuse points that only a very short length measures all, which would fill the memory."""
    n_bits = scale.bit_length()
    if n_bits > MOST_BITS_OF_ONE or 2 * n_points * n_bits > MOST_BITS:
        message = f"the denominators of {n_points} positions have too large a common multiple"
        raise InputError.at("vertices", f"{message} (give decimals)")


def _is_shortest_decimal(number: float | Fraction) -> bool:
    """Return whether a number is the shortest decimal that prints its floating-point number."""
    if isinstance(number, float):
        return True
    # Fifteen digits always come back; nearly all coordinates have no more.
    millionths, rest = divmod(MILLION, number.denominator)
    if rest == 0 and abs(number.numerator) * millionths < FIFTEEN_DIGITS:
        return True
    return Fraction(repr(float(number))) == number


def measure_squared_distance(tail: Point, head: Point) -> Fraction:
    """Return the square of the straight distance of two points.

    Parameters
    ----------
    tail, head
        The points.
    """
    return (tail[0] - head[0]) ** 2 + (tail[1] - head[1]) ** 2


def choose_rounding_step(squares: Iterable[Fraction]) -> Fraction:
    """Return the step to which the lengths of a map are rounded up.

    Parameters
    ----------
    squares
        The squared distance of the ends of each edge whose length is not given.

    Returns
    -------
    Fraction
        1/1000, or 1/1000000 if a distance is below 1 [length unit].
    """
    return FINE if any(0 < square < 1 for square in squares) else COARSE


def measure_straight_length(square: Fraction, step: Fraction = COARSE) -> Fraction:
    """Return the length of a straight edge, rounded up to a step if it is no fraction.

    Parameters
    ----------
    square
        The squared distance of its ends.
    step
        The step [length unit].

    Raises
    ------
    InputError
        If the ends are at one position, or the length has too many digits.

    Examples
    --------
    >>> measure_straight_length(Fraction(25)), measure_straight_length(Fraction(2))
    (Fraction(5, 1), Fraction(283, 200))
    """
    if square == 0:
        raise InputError.at("", "has no length, its ends are at one position (give a length)")
    # Whole numbers throughout: a map may have a million lengths, and fractions are slow.
    above, below = square.numerator, square.denominator
    whole, part = math.isqrt(above), math.isqrt(below)
    root = Fraction(whole, part)
    if whole * whole != above or part * part != below or _count_digits(root) > DIGITS:
        steps = -(-above * step.denominator**2 // (below * step.numerator**2))  # rounded up
        whole = math.isqrt(steps)
        root = Fraction((whole + (whole * whole < steps)) * step.numerator, step.denominator)
    if _count_digits(root) > DIGITS:
        about = f"about {math.sqrt(square):.4g}"
        message = f"the straight distance, {about}, has too many digits (give a length)"
        raise InputError.at("", message)
    return root


def _count_digits(number: Fraction) -> int:
    """Return the most digits of numerator and denominator; those of 10**n count as n."""
    return len(str(max(number.numerator, number.denominator) - 1))
