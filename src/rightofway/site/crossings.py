"""Lanes that others cross, or that pass vertices, far from their own ends.

A robot books a whole lane while it drives along it. Where robots have a size, a lane that others
cross far from its ends is closed to them for much longer than the robot needs for the crossing. So
lanes like this are cut into pieces, unless a map says how.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import check_work
from rightofway.site.nearness import Lines, PointGrid

PIECE_IN_DISTANCES = 3
"""Length of a piece, in least distances of two robots: shorter pieces block a crossing hardly less,
because a robot that drives along a piece has booked both of its ends, too."""

MOST_PIECES, MOST_CUTS = 8, 50_000
"""Pieces that a lane, and all lanes together, are cut into where a map does not say how, at most:
else pieces are longer. The eighth part of a lane is booked for an eighth of the time."""

TIE = 1e-6
"""A crossing is far from an end if it is farther than the distance by this part: drawings that are
moved are rounded differently, and keep their pieces."""

SLACK = 1e-9
"""Part of the extent of a drawing that rounding can move a line by."""

LINES_AT_ONCE = 256

PARTS = (64, 8, 1)
"""Lines are compared with every 64th other first, those that none of them crosses with every 8th,
the rest with all: where thousands cross a lane, a few say it."""

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def choose_spacing(lengths: Sequence[Fraction], distance: Fraction) -> Fraction:
    """Return the length of the pieces that crossed lanes of some lengths are cut into.

    It is `PIECE_IN_DISTANCES` times the distance, doubled until all lanes that are longer make no
    more than `MOST_CUTS` pieces; a lane makes `MOST_PIECES` at most.

    Examples
    --------
    >>> choose_spacing([Fraction(5), Fraction(20)], Fraction(1))
    Fraction(3, 1)
    """
    spacing = PIECE_IN_DISTANCES * distance
    whole = np.array([float(length) for length in lengths])
    while True:
        counts = np.minimum(np.ceil(whole / float(spacing)), MOST_PIECES)
        if counts[counts > 1].sum() <= MOST_CUTS:
            return spacing
        spacing *= 2


def find_crossed(
    begin: Floats, end: Floats, points: Floats, wanted: Bools, distance: float
) -> Bools:
    """Return which straight lines, shape (n, 2) at both ends, are met far from these ends.

    A line is met where another one crosses it, and where a point, of shape (m, 2), is nearer to it
    than the distance. Far from an end is farther than the distance. Lines that are not wanted are
    crossed by others only.
    """
    is_met = np.zeros(len(begin), bool)
    left = np.flatnonzero(wanted)
    if not len(left):
        return is_met
    slack = SLACK * float(np.abs(points).max())
    far = distance * (1 + TIE)
    step = end - begin
    lengths = np.hypot(*step.T)

    def meet(line: NDArray[np.int64], share: Floats) -> None:
        at = share * lengths[line]
        is_met[line[(at > far) & (lengths[line] - at > far)]] = True

    lines = Lines(begin[left], end[left])
    vertices = PointGrid(points, distance + lines.piece / 2 + slack)
    for some in _batches(len(left)):
        line, point = lines.find_near_points(vertices, some, distance * (1 - TIE))
        line = left[line]
        to_point = points[point] - begin[line]
        meet(line, (to_point * step[line]).sum(axis=1) / lengths[line] ** 2)
    for part in PARTS:
        left = np.flatnonzero(wanted & ~is_met)
        # A part may have lines that are left, too: no line crosses itself.
        others = np.arange(0, len(begin), part) if part > 1 else np.flatnonzero(~wanted | is_met)
        number = np.concatenate((left, others))
        lines = Lines(begin[number], end[number])
        first = len(left) if part > 1 else 0
        middles = PointGrid(lines.middles[lines.first[first] :], lines.piece + 2 * slack)
        for some in _batches(len(left)):
            pair = lines.find_crossing(middles, some, slack, first)
            line, other = number[pair[0]], number[pair[1]]
            between = begin[other] - begin[line]
            turn = _cross(step[line], step[other])
            is_parallel = turn == 0
            turn[is_parallel] = 1.0
            along_line = _cross(between, step[other]) / turn
            along_other = _cross(between, step[line]) / turn
            inside = ~is_parallel & (along_line > 0) & (along_line < 1)
            inside &= (along_other > 0) & (along_other < 1)
            meet(line[inside], along_line[inside])
            meet(other[inside], along_other[inside])
    return is_met & wanted


def _batches(count: int) -> Iterator[slice]:
    for first in range(0, count, LINES_AT_ONCE):
        check_work("finding lanes that cross")
        yield slice(first, min(first + LINES_AT_ONCE, count))


def _cross(first: Floats, other: Floats) -> Floats:
    product: Floats = first[:, 0] * other[:, 1] - first[:, 1] * other[:, 0]
    return product
