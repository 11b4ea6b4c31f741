"""Curves cut into straight pieces: NURBS, as trajectories of LIF and VDA 5050 are, and Béziers.

References
----------
L. Piegl, W. Tiller, *The NURBS Book*, 2nd edition, Springer, 1997: section 2.2 (basis functions)
and section 4.2 (rational curves).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

CHORD_ERROR = 0.005
"""The largest distance of the pieces from their curve [m]."""

MARGIN = 0.8
"""Part of the chord error that the samples may have: the curve goes on between them."""

SAMPLES = 400
"""Points of a curve that are looked at, for each part without a corner."""

MAX_PIECES = 200
"""The most pieces of a part without a corner; a curve that needs more cannot be meant."""

MAX_DEGREE, MAX_POINTS = 10, 1000

BLOCK = 100_000
"""Points of a curve that are worked out at once."""

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Nurbs:
    """A curve.

    Attributes
    ----------
    degree
        1 for straight lines between the control points.
    knots
        Not decreasing, as many as control points and degree together, and one more.
    points
        Control points [m]; float64, shape (n, 2).
    weights
        Their weights, positive; float64, shape (n,).

    Raises
    ------
    ValueError
        If these do not fit to each other.
    """

    degree: int
    knots: NDArray[np.float64]
    points: Points
    weights: NDArray[np.float64]

    def __post_init__(self) -> None:
        n, knots, p = len(self.points), self.knots, self.degree
        fits = 1 <= p <= MAX_DEGREE and p < n <= MAX_POINTS and len(knots) == n + p + 1
        if not fits or (np.diff(knots) < 0).any() or knots[p] >= knots[n]:
            raise ValueError("degree, knots and control points do not fit to each other")
        if (self.weights <= 0).any():
            raise ValueError("a weight is not positive")

    def compute_points(self, parameters: NDArray[np.float64]) -> Points:
        """Return the points of the curve at some parameters; shape (m, 2)."""
        if len(parameters) > BLOCK:  # or the functions of all of them would fill the memory
            blocks = range(0, len(parameters), BLOCK)
            return np.concatenate([self.compute_points(parameters[k : k + BLOCK]) for k in blocks])
        knots, n = self.knots, len(self.points)
        span = np.clip(np.searchsorted(knots, parameters, side="right") - 1, self.degree, n - 1)
        basis = np.zeros((len(parameters), len(knots) - 1))
        basis[np.arange(len(parameters)), span] = 1.0
        for p in range(1, self.degree + 1):
            left, right = knots[p:-1] - knots[: -p - 1], knots[p + 1 :] - knots[1:-p]
            rise = _divide(parameters[:, None] - knots[: -p - 1], left)
            fall = _divide(knots[p + 1 :] - parameters[:, None], right)
            basis = rise * basis[:, :-1] + fall * basis[:, 1:]
        weighted = basis * self.weights
        points: Points = weighted @ self.points / weighted.sum(axis=1)[:, None]
        return points

    def reverse(self) -> Nurbs:
        """Return the curve driven back."""
        knots = self.knots[0] + self.knots[-1] - self.knots[::-1]
        return replace(self, knots=knots, points=self.points[::-1], weights=self.weights[::-1])

    def cut_pieces(self, chord_error: float = CHORD_ERROR) -> Points:
        """Return the ends of straight pieces that stay within a chord error; shape (m, 2).

        Between corners, which are knots as often as the degree, pieces are equally long. A curve
        and the same curve driven back have the same ends.

        Raises
        ------
        ValueError
            If that takes too many pieces.
        """
        if tuple(self.points[0]) > tuple(self.points[-1]):
            return self.reverse().cut_pieces(chord_error)[::-1]
        inside = self.knots[self.degree : len(self.points) + 1]
        values, times = np.unique(inside, return_counts=True)
        ends = (values == inside[0]) | (values == inside[-1]) | (times >= self.degree)
        samples = [self.compute_points(inside[:1])]
        for begin, end in pairwise(values[ends].tolist()):
            samples.append(
                _cut(self.compute_points(np.linspace(begin, end, SAMPLES)), chord_error)[1:]
            )
        return np.concatenate(samples)

    def cut(self, count: int) -> Points:
        """Return the ends of some pieces that are equally long along the curve."""
        first, last = self.knots[self.degree], self.knots[len(self.points)]
        samples = self.compute_points(np.linspace(first, last, max(SAMPLES, 20 * count)))
        return _find_ends(samples, _measure_along(samples), count)[1]


def make_bezier(points: Points) -> Nurbs:
    """Return a Bézier curve as a NURBS of one part."""
    knots = np.repeat([0.0, 1.0], len(points))
    return Nurbs(degree=len(points) - 1, knots=knots, points=points, weights=np.ones(len(points)))


def _divide(top: Points, bottom: NDArray[np.float64]) -> Points:
    """Return a quotient that is 0 where the divisor is 0."""
    safe = np.where(bottom > 0, bottom, 1.0)
    return np.where(bottom > 0, top / safe, 0.0)


def _cut(samples: Points, chord_error: float) -> Points:
    """Return ends of the fewest pieces of equal length that are near to all samples."""
    along = _measure_along(samples)
    for count in range(1, MAX_PIECES + 1):
        cuts, ends = _find_ends(samples, along, count)
        piece = np.clip(np.searchsorted(cuts, along, side="right") - 1, 0, count - 1)
        if _measure_deviation(samples, ends[piece], ends[piece + 1]) <= MARGIN * chord_error:
            return ends
    raise ValueError(f"the curve needs more than {MAX_PIECES} pieces")


def _measure_along(samples: Points) -> NDArray[np.float64]:
    """Return how far along its samples each point of a curve is."""
    parameters: NDArray[np.float64] = np.concatenate(
        ([0.0], np.cumsum(np.hypot(*np.diff(samples, axis=0).T)))
    )
    return parameters


def _find_ends(samples: Points, along: Points, count: int) -> tuple[Points, Points]:
    """Return where pieces of equal length end: how far along, and the points."""
    cuts = np.linspace(0.0, along[-1], count + 1)
    return cuts, np.column_stack([np.interp(cuts, along, axis) for axis in samples.T])


def _measure_deviation(points: Points, begin: Points, end: Points) -> float:
    """Return the largest distance of points from their pieces."""
    chord = end - begin
    square = np.maximum((chord**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip(((points - begin) * chord).sum(axis=1) / square, 0, 1)
    return float(np.hypot(*(points - begin - share[:, None] * chord).T).max())
