"""Places as users write them, found on the roadmap; or a sentence on what is there instead."""

from __future__ import annotations

from collections.abc import Callable
from numbers import Integral

import numpy as np

from rightofway.errors import InputError, is_printable, nearest, shown
from rightofway.model.roadmap import Grid, Roadmap
from rightofway.model.units import VertexId

Place = str | tuple[int, int]
"""``N<k>`` (row-major number) or a vertex name; or (row, column)."""

LONGEST_NUMBER = 18
"""Digits that a cell's number may have."""


def as_place(value: object) -> Place | None:
    """Return a value of a document as a place, or None if it has not the shape of one."""
    if isinstance(value, str) and is_printable(value):
        return value
    if isinstance(value, list | tuple) and len(value) == 2 and all(map(_is_whole, value)):  # noqa: PLR2004 - row and column
        row, column = value
        return int(row), int(column)
    return None


def _is_whole(value: object) -> bool:
    return isinstance(value, Integral) and not isinstance(value, bool)


def vertex_at(
    roadmap: Roadmap, place: Place, *, what_blocks: Callable[[int, int], str] | None = None
) -> VertexId:
    """Return the vertex at a place.

    Parameters
    ----------
    roadmap
        The map.
    place
        The place: ``N<k>`` or (row, column) on a grid, a vertex name on other roadmaps.
    what_blocks
        Names what blocks the cell (row, column) of a grid, for the message.

    Raises
    ------
    InputError
        If the place is outside the map, blocked, or not known; with the place and a remedy.
    """
    grid = roadmap.grid
    if grid is None:
        return _named(place, roadmap)
    row, column = place if isinstance(place, tuple) else _numbered(place, grid)
    if not (0 <= row < grid.rows and 0 <= column < grid.columns):
        limits = f"rows are 0 to {grid.rows - 1}, columns 0 to {grid.columns - 1}"
        raise InputError.at("", f"{_written(place)} is outside the map ({limits})")
    vertex = int(grid.vertex_at[row * grid.columns + column])
    if vertex < 0:
        at = "" if isinstance(place, tuple) else f", row {row}, column {column},"
        what = what_blocks(row, column) if what_blocks else "a wall"
        free = f"{_free_cell(row, column, grid)} is free"
        raise InputError.at("", f"{_written(place)}{at} is blocked by {what} ({free})")
    return VertexId(vertex)


def _named(place: Place, roadmap: Roadmap) -> VertexId:
    if isinstance(place, tuple):
        message = f"{_written(place)} needs a grid, and this is a roadmap (give a vertex name)"
        raise InputError.at("", message)
    try:
        return roadmap.vertex(place)
    except KeyError:
        near = nearest(place, roadmap.labels or ())
        hint = f"did you mean {near!r}?" if near else "give one of the map's vertices"
        raise InputError.at("", f"no vertex is named {shown(place)} ({hint})") from None


def _numbered(place: str, grid: Grid) -> tuple[int, int]:
    number = place[1:]
    if not (place.startswith("N") and number.isascii() and number.isdecimal()):
        message = f"{shown(place)} is no place on a grid (give N<k> or [row, column])"
        raise InputError.at("", message)
    if len(number) > LONGEST_NUMBER or int(number) >= grid.rows * grid.columns:
        last = grid.rows * grid.columns - 1
        raise InputError.at("", f"{shown(place)} is outside the map (cells are N0 to N{last})")
    return divmod(int(number), grid.columns)


def _written(place: Place) -> str:
    return place if isinstance(place, str) else f"[{shown(place[0])}, {shown(place[1])}]"


def _free_cell(row: int, column: int, grid: Grid) -> str:
    """Return the name of the free cell nearest to a cell."""
    rows, columns = np.divmod(grid.cells, grid.columns)
    nearest_vertex = int(np.argmin(np.abs(rows - row) + np.abs(columns - column)))
    return f"N{int(grid.cells[nearest_vertex])}"
