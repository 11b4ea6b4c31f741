"""Lanes that a scenario draws as Bézier curves: their length, and the straight pieces of them.

Robots are points on a curve that is one edge; its length is the curve's own. Robots with a size
need shapes that they can be near to, so their curves are cut into straight pieces.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby
from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.io.layouts.draft import MICRO
from rightofway.io.layouts.nurbs import make_bezier
from rightofway.site import Point
from rightofway.site.spacing import measure_lengths_along

ERROR = Fraction(1, 2000)
"""The largest distance of pieces from their curve, relative to the way along its control points."""


class LaneCurve(NamedTuple):
    """A curve between two vertices.

    Attributes
    ----------
    controls
        Its control points between the ends [length unit].
    points
        The ends of its straight pieces, without those of the curve [length unit].
    length
        How long the pieces are together, each rounded up [length unit].
    error
        How far at most the pieces are from the curve [length unit].
    """

    controls: tuple[Point, ...]
    points: tuple[Point, ...]
    length: Fraction
    error: Fraction

    def reverse(self) -> LaneCurve:
        """Return the curve driven back."""
        return self._replace(controls=self.controls[::-1], points=self.points[::-1])


def make_lane_curve(tail: Point, controls: Sequence[Point], head: Point) -> LaneCurve:
    """Return the Bézier curve between two points.

    Raises
    ------
    InputError
        If the curve cannot be cut into pieces.
    """
    whole = _convert_to_floats([tail, *controls, head])
    whole_length = float(np.hypot(*np.diff(whole, axis=0).T).sum())
    error = Fraction(ceil(whole_length * float(ERROR) * MICRO), MICRO)
    try:
        ends = make_bezier(whole).cut_pieces(float(error))
    except ValueError as fault:
        raise InputError.at("", f"{fault} (move its control points nearer to its ends)") from None
    points = [at for at, _ in groupby([tail, *_round_points(ends[1:-1]), head])]
    return LaneCurve(
        controls=tuple(controls),
        points=tuple(points[1:-1]),
        length=sum(measure_lengths_along(points), Fraction(0)),
        error=error,
    )


def make_points_along(
    curve: LaneCurve, tail: Point, head: Point, spacing: Fraction
) -> tuple[Point, ...]:
    """Return points on a curve, as far apart along it as equal pieces of at most a spacing are."""
    whole = make_bezier(_convert_to_floats([tail, *curve.controls, head]))
    return tuple(_round_points(whole.cut(ceil(curve.length / spacing))[1:-1]))


def _convert_to_floats(points: Sequence[Point]) -> NDArray[np.float64]:
    return np.array([[float(x), float(y)] for x, y in points])


def _round_points(points: NDArray[np.float64]) -> list[Point]:
    """Return points to a millionth of a length unit."""
    return [(Fraction(round(x * MICRO), MICRO), Fraction(round(y * MICRO), MICRO))
            for x, y in points.tolist()]  # fmt: skip
