"""Roadmaps of grids: a vertex for each free cell, edges to the cells beside it."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.kinds.numbers import Number
from rightofway.kinds.table import POSITIVE
from rightofway.site.geometry import Frame, Point

if TYPE_CHECKING:
    pass

from rightofway.site.roadmap import EdgeClass, Grid, Roadmap

FREE = frozenset(".GS")
"""Grid characters that a robot may stand on; every other one is blocked."""

EAST_SOUTH_WEST_NORTH = ((0, 1), (1, 0), (0, -1), (-1, 0))
"""Steps in (row, column), in the order that decides between equally short paths."""


def make_grid_roadmap(
    lines: Sequence[str],
    *,
    cell_size: Number = 1,
    y_up: bool = False,
    origin: Point | None = None,
    yaw: Fraction = Fraction(0),
) -> Roadmap:
    """Make the roadmap of a grid: a vertex for each free cell, edges to the four next to it.

    Parameters
    ----------
    lines
        The rows, all of one length. ``.``, ``G`` and ``S`` are free, everything else is blocked.
    cell_size
        Side of a cell, and so the length of every edge [length unit].
    y_up
        Whether y grows upwards in the site's frame; the first row is the upper one in any case.
    origin
        The lower left corner of the grid in the site's frame [length unit]. By default (0, 0) is
        the corner of the grid that has the least x and y.
    yaw
        Angle by which the grid is turned about the origin, from the site's x to its y [rad].

    Raises
    ------
    InputError
        For an empty or ragged grid, one without a free cell, or a cell size that is not positive.
    """
    _check_lines(lines)
    size = POSITIVE.read_at("cell_size", cell_size)
    free = np.array([[character in FREE for character in line] for line in lines])
    if not free.any():
        raise InputError.at("", f"no free cell in {free.size} ({_describe_meant(lines)})")
    rows, columns = free.shape
    cells = np.flatnonzero(free).astype(np.int32)
    vertex_at = np.full(rows * columns, -1, np.int32)
    vertex_at[cells] = np.arange(len(cells), dtype=np.int32)
    neighbours = _find_neighbours(vertex_at.reshape(rows, columns), free)
    present = neighbours >= 0
    cells.flags.writeable = vertex_at.flags.writeable = False
    y, x = np.divmod(cells, columns)
    return Roadmap(
        indptr=np.concatenate(([0], np.cumsum(present.sum(axis=1)))).astype(np.int32),
        heads=neighbours[present],
        class_of_edge=np.zeros(int(present.sum()), np.int32),
        edge_classes=(EdgeClass(length=size),),
        positions=np.column_stack((x, y)).astype(np.float64) * float(size),
        grid=Grid(rows=rows, columns=columns, cell_size=size, cells=cells, vertex_at=vertex_at),
        frame=_make_grid_frame(rows * size, size, y_up=y_up, origin=origin, yaw=yaw),
    )


def _make_grid_frame(
    height: Fraction, size: Fraction, *, y_up: bool, origin: Point | None, yaw: Fraction
) -> Frame:
    """Return the frame of a grid: the point (0, 0) of its plane is the centre of its first cell."""
    left, bottom = origin or (Fraction(0), Fraction(0) if y_up else height)
    corner = Frame(x=left, y=bottom, y_up=y_up, yaw=yaw)
    x, y = corner.to_site((size / 2, size / 2 - height))
    return Frame(x=x, y=y, y_up=y_up, yaw=yaw)


def _check_lines(lines: Sequence[str]) -> None:
    is_list = isinstance(lines, Sequence) and not isinstance(lines, str)
    if not is_list or not all(isinstance(line, str) for line in lines):
        raise InputError.at("", f"{quote(lines)} is no list of rows (give a list of text)")
    if not lines or not lines[0]:
        raise InputError.at("", "the grid is empty (give at least one row of one cell)")
    spaced = [line.rstrip() for line in lines]
    if all(set(line[1::2]) <= {" "} and " " not in line[::2] for line in spaced) and any(
        " " in line for line in spaced
    ):
        message = f"{quote(lines[0])} has spaces between cells (write {quote(spaced[0][::2])})"
        raise InputError.at("", message)
    width = len(lines[0])
    for row, line in enumerate(lines):
        if len(line) != width:
            message = f"{len(line)} cells, but row 0 has {width} (make all rows equally long)"
            raise InputError.at(row, message)


def _describe_meant(lines: Sequence[str]) -> str:
    """Return how to write a grid that has no free cell."""
    characters = sorted(set("".join(lines)))
    if set(characters) <= set("01"):
        return "write . for free and @ for blocked, not 0 and 1"
    others = [character for character in characters if character not in "@#TOWX"]
    if len(others) == 1 and len(characters) > 1:
        return f"free cells are . G S; {quote(others[0])} is blocked here: write . for it"
    return "free cells are . G S, all other characters are blocked"


def _find_neighbours(vertex_at: NDArray[np.int32], free: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Return the vertex east, south, west and north of each vertex, -1 for none; shape (V, 4)."""
    framed = np.pad(vertex_at, 1, constant_values=-1)
    rows, columns = vertex_at.shape
    return np.column_stack(
        [
            framed[1 + down : 1 + down + rows, 1 + right : 1 + right + columns][free]
            for down, right in EAST_SOUTH_WEST_NORTH
        ]
    )
