"""Pairs of points and straight lines that are near each other, found in a grid of cells.

A point looks for others in its own cell and the eight around it. A line stands there as the points
in the middle of its pieces, so that one grid serves points and lines. Positions are rounded
numbers; a caller adds the error of rounding to the distance, and decides exactly.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["Lines", "PointGrid"]

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

PIECES_OF_A_LINE = 4
"""Pieces into which a line of mean length is cut: more are more points, fewer are more pairs."""

MOST_CELLS = 2**20
"""Cells along an axis, at most, so that the number of a cell fits 64 bits."""

MARGIN = 1 + 1e-6
"""Cells are this much wider than the distance: more than rounding moves a point among them."""


class PointGrid:
    """Points in square cells, for the pairs that are within one distance.

    Parameters
    ----------
    points
        Positions; shape (n, 2).
    distance
        The distance, not negative.
    """

    def __init__(self, points: Floats, distance: float) -> None:
        self.points, self.distance = points, distance
        self._least = points.min(axis=0, initial=np.inf)
        extent = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
        self._side = MARGIN * max(distance, extent / MOST_CELLS) or 1.0
        columns, rows = self._find_cells(points)
        self._width = int(columns.max(initial=0)) + 3  # a column is free on both sides
        numbers = rows * self._width + columns
        self._order = np.argsort(numbers, kind="stable")
        self._numbers = numbers[self._order]

    def _find_cells(self, points: Floats) -> tuple[Ints, Ints]:
        columns, rows = np.floor((points - self._least) / self._side).astype(np.int64).T
        return columns, rows

    def find_near(self, points: Floats) -> tuple[Ints, Ints]:
        """Return pairs within the distance: indices of given points, and of those of the grid.

        Parameters
        ----------
        points
            Positions between those of the grid; shape (m, 2).
        """
        columns, rows = self._find_cells(points)
        of_cell = (np.arange(-1, 2)[:, None] + rows) * self._width + columns
        begin = np.searchsorted(self._numbers, of_cell - 1).ravel()
        counts = np.searchsorted(self._numbers, of_cell + 1, side="right").ravel() - begin
        first = np.repeat(begin - (np.cumsum(counts) - counts), counts)
        other = self._order[first + np.arange(counts.sum())]
        point = np.repeat(np.tile(np.arange(len(points)), 3), counts)
        x, y = (points[point] - self.points[other]).T
        near = x * x + y * y <= self.distance**2
        return point[near], other[near]


class Lines:
    """Straight lines, and the points in the middle of their pieces.

    Parameters
    ----------
    begin, end
        Positions of their ends; shape (n, 2).
    """

    def __init__(self, begin: Floats, end: Floats) -> None:
        self.begin, self.end = begin, end
        lengths = np.hypot(*(end - begin).T)
        self.piece = float(lengths.mean()) / PIECES_OF_A_LINE if len(begin) else 0.0
        counts = np.maximum(np.ceil(lengths / (self.piece or 1.0)), 1).astype(np.int64)
        self.first = np.concatenate(([0], np.cumsum(counts)))
        self.line_of = np.repeat(np.arange(len(begin)), counts)
        share = (np.arange(self.first[-1]) - self.first[self.line_of] + 0.5) / counts[self.line_of]
        step = (end - begin)[self.line_of]
        self.middles = begin[self.line_of] + share[:, None] * step

    def find_near_points(self, grid: PointGrid, some: slice, distance: float) -> tuple[Ints, Ints]:
        """Return pairs of some lines and points that are within a distance.

        Parameters
        ----------
        grid
            The points; its distance is greater by half a piece, at least.
        some
            The lines to look at.
        distance
            The distance.
        """
        line, point = self._find_pairs(grid, some, len(grid.points))
        step, to_point = (self.end - self.begin)[line], grid.points[point] - self.begin[line]
        square = np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
        share = np.clip((step * to_point).sum(axis=1) / square, 0, 1)
        near = np.hypot(*(to_point - share[:, None] * step).T) <= distance
        return line[near], point[near]

    def find_crossing(self, grid: PointGrid, some: slice, slack: float) -> tuple[Ints, Ints]:
        """Return pairs of some lines with later ones that cross or touch, and few more.

        Parameters
        ----------
        grid
            The middles of the pieces; its distance is a piece and the slack, at least.
        some
            The lines to look at.
        slack
            The distance by which rounding can move a line.
        """
        point, middle = self._find_pairs(grid, some, len(grid.points))
        of_middle = self.line_of[middle]
        later = of_middle > point
        point, other = point[later], of_middle[later]
        point, other = np.divmod(np.unique(point * len(self.begin) + other), len(self.begin))
        apart = self._is_beside(point, other, slack) | self._is_beside(other, point, slack)
        return point[~apart], other[~apart]

    def _is_beside(self, first: Ints, other: Ints, slack: float) -> NDArray[np.bool_]:
        """Return where both ends of a line lie on one side of another, beyond the slack."""
        (x, y), (begin_x, begin_y), (end_x, end_y) = (
            (ends[of] - self.begin[other]).T
            for ends, of in ((self.end, other), (self.begin, first), (self.end, first))
        )
        begin, end = x * begin_y - y * begin_x, x * end_y - y * end_x
        beyond = slack * np.hypot(x, y)
        beside: NDArray[np.bool_] = (np.minimum(begin, end) > beyond) | (
            np.maximum(begin, end) < -beyond
        )
        return beside

    def _find_pairs(self, grid: PointGrid, some: slice, n_points: int) -> tuple[Ints, Ints]:
        """Return the pairs of some lines and points of a grid that are near one of their pieces."""
        begin, stop, _ = some.indices(len(self.begin))
        pieces = slice(self.first[begin], self.first[stop])
        piece, point = grid.find_near(self.middles[pieces])
        line = self.line_of[pieces][piece]
        return np.divmod(np.unique(line * n_points + point), n_points)
