"""A picture of where robots may be, cut into square cells.

A cell is free if a robot that drives along the middle of cells keeps its radius from everything
that is not free. Such a robot has half a cell of room inside free cells, so obstacles grow only by
what its radius is above that.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, isqrt

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.site.clustering import MAX_CELLS
from rightofway.site.drawing import Picture
from rightofway.site.geometry import Point

FREE, UNKNOWN, OCCUPIED = 0, 1, 2
"""The state of a pixel."""

FAR = 60_000
"""Distances beyond this are treated as equal [pixels]."""

STRIP = 256
"""Rows that are worked on at once."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Occupancy:
    """A picture of where robots may be.

    Attributes
    ----------
    pixels
        `FREE`, `UNKNOWN` or `OCCUPIED`; the first row is the upper one; uint8, shape (rows,
        columns).
    resolution
        Side of a pixel [m].
    origin
        The lower left corner of the picture in the site's frame [m].
    yaw
        Angle by which the picture is turned about its origin, counterclockwise [rad].
    picture
        The file of the picture, and where it lies [m].
    notes
        Mendings and omissions of the reader, a fact each.
    """

    pixels: NDArray[np.uint8]
    resolution: Fraction
    origin: Point = (Fraction(0), Fraction(0))
    yaw: Fraction = Fraction(0)
    picture: Picture | None = None
    notes: tuple[Fact, ...] = ()

    def cut_cells(
        self, size: Fraction, *, radius: Fraction = Fraction(0), unknown_is_free: bool = False
    ) -> tuple[str, ...]:
        """Return the rows of `free_cells`, the upper one first: ``.`` for free, ``@`` for blocked.

        Parameters
        ----------
        size, radius, unknown_is_free
            As for `free_cells`.
        """
        free = self.free_cells(size, radius=radius, unknown_is_free=unknown_is_free)
        return tuple("".join(row) for row in np.where(free[::-1], ".", "@"))

    def free_cells(
        self,
        size: Fraction,
        *,
        radius: Fraction = Fraction(0),
        unknown_is_free: bool = False,
        max_cells: int = MAX_CELLS,
        key: str = "cell_size",
    ) -> NDArray[np.bool_]:
        """Cut the picture into cells, from its lower left corner on.

        Parameters
        ----------
        size
            Side of a cell [m].
        radius
            Radius of the largest robot [m].
        unknown_is_free
            Whether robots may be where nothing is known.
        max_cells
            The most cells to make.
        key
            The name of the size of the cells in messages.

        Returns
        -------
        ndarray
            Which cells are free, the lower row first; bool, shape (rows, columns). What is left at
            the upper and right border is not used.

        Raises
        ------
        InputError
            If there is no whole cell or no free one, there are too many, or one is below a pixel.
        """
        height, width = self.pixels.shape
        rows, columns = (int(side * self.resolution // size) for side in (height, width))
        if size < self.resolution:
            message = f"a cell of {float(size)} m is below a pixel of {float(self.resolution)} m"
            raise InputError.at(key, f"{message} (give a larger one)")
        if not rows or not columns:
            message = f"a cell of {float(size)} m is larger than the map (give a smaller one)"
            raise InputError.at(key, message)
        if rows * columns > max_cells:
            message = f"{rows * columns} cells, more than {max_cells} (give a larger one)"
            raise InputError.at(key, message)
        blocked = self.pixels == OCCUPIED if unknown_is_free else self.pixels != FREE
        growth = (radius - size / 2) / self.resolution
        if growth > 0:
            blocked = widen_blocked(blocked, growth, outside=not unknown_is_free)
        blocked = blocked[::-1]  # from the origin on
        step = size / self.resolution
        across = [(int(k * step), ceil((k + 1) * step)) for k in range(max(rows, columns))]
        strips = np.array([blocked[begin:end].any(axis=0) for begin, end in across[:rows]])
        cut = np.array([strips[:, begin:end].any(axis=1) for begin, end in across[:columns]])
        if cut.all():
            remedy = "give a smaller one"
            message = f"no cell of {float(size)} m is free all over"
            if growth > 0:
                message = f"no cell of {float(size)} m has room for a radius of {float(radius)} m"
                remedy += ", or smaller robots"
            raise InputError.at(key, f"{message} ({remedy})")
        return ~cut.T


@dataclass(frozen=True, slots=True, kw_only=True)
class CellMap:
    """A map that is drawn in cells already.

    Attributes
    ----------
    lines
        The rows, the upper one first: ``.``, ``G`` and ``S`` are free, all else is blocked.
    """

    lines: tuple[str, ...]


def widen_blocked(blocked: NDArray[np.bool_], by: Fraction, *, outside: bool) -> NDArray[np.bool_]:
    """Return the pixels that have a point nearer than a distance to a blocked pixel.

    Returns
    -------
    ndarray
        Blocked pixels; bool, shape (rows, columns).
    """
    framed = np.pad(blocked, 1, constant_values=outside)
    rows = len(framed)
    gap = np.empty(framed.shape, np.uint16)
    for begin in range(0, rows, STRIP):  # a strip at a time needs little memory
        gap[begin : begin + STRIP] = np.minimum(
            _measure_gap_in_row(framed[begin : begin + STRIP]), FAR
        )
    result = framed.copy()
    for down in range(min(ceil(by) + 1, rows)):
        between = max(down - 1, 0)
        rest = by**2 - between**2
        if rest <= 0:
            break
        # The largest whole number of pixels in between whose square is below the rest.
        widest = isqrt(ceil(rest) - 1)
        near = gap <= min(widest + 1, FAR - 1)
        result[down:] |= near[: rows - down]
        result[: rows - down] |= near[down:]
    return result[1:-1, 1:-1]


def _measure_gap_in_row(blocked: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Return how many pixels each pixel is from the nearest blocked one in its row; int32."""
    columns = np.arange(blocked.shape[1], dtype=np.int32)
    far = np.int32(2 * FAR)
    before = np.maximum.accumulate(np.where(blocked, columns, -far), axis=1)
    gap = columns - before
    after = np.minimum.accumulate(np.where(blocked, columns, far)[:, ::-1], axis=1)[:, ::-1]
    return np.minimum(gap, after - columns, out=gap)
