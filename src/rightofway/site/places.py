"""Places as users write them, found on the roadmap; or a sentence on the obstacle there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeGuard

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, InputFault, is_printable, quote
from rightofway.kinds.numbers import read_coordinate, read_exact
from rightofway.kinds.table import is_whole
from rightofway.site.geometry import Point, VertexId, measure_squared_distance
from rightofway.site.roadmap import Grid, Roadmap, UnknownVertex
from rightofway.units import Units, write_decimal


@dataclass(frozen=True, slots=True)
class Spot:
    """A point of the site, ``{x: 1.2, y: 0.8}`` [length unit]."""

    x: Fraction
    y: Fraction

    def __str__(self) -> str:
        return f"{{x: {_write_coordinate(self.x)}, y: {_write_coordinate(self.y)}}}"


Place = str | tuple[int, int] | Spot
"""``N<k>`` (row-major number) or a vertex name; (row, column); or a point of the site."""

LONGEST_NUMBER = 18
"""Digits that a cell's number may have."""

ON_BORDER = 1e-9
"""Distance from a border at which a point is on it [smallest squares]."""

SHORT = Fraction(1, 1000)
"""To this step a message rounds a point of a cell [length unit]."""

DECIMALS = 20
"""A coordinate with more decimals is written as a fraction."""


def as_place(value: object, roadmap: Roadmap | None = None) -> Place:
    """Return a value of a document as a place.

    Raises
    ------
    InputError
        If it has not the shape of a place.
    """
    if isinstance(value, str) and is_printable(value):
        return value
    if is_cell(value):
        row, column = value
        return int(row), int(column)
    if isinstance(value, Mapping):
        return _read_spot(value)
    raise InputError.at("", f"{quote(value)} is no place ({_describe_meant(value, roadmap)})")


def is_cell(value: object) -> TypeGuard[tuple[int, int]]:
    """Return whether a value is a pair of whole numbers: row and column."""
    return isinstance(value, list | tuple) and len(value) == 2 and all(map(is_whole, value))  # noqa: PLR2004


def _read_spot(value: Mapping[object, object]) -> Spot:
    faults = [
        InputFault("", f"{quote(key)} is no coordinate (give {{x: 1.2, y: 0.8}})")
        for key in value
        if key not in {"x", "y"}
    ]
    coordinates = {"x": Fraction(0), "y": Fraction(0)}
    for key in coordinates:
        if key not in value:
            faults.append(InputFault(key, "is missing (give {x: 1.2, y: 0.8})"))
            continue
        try:
            coordinates[key] = read_coordinate(value[key])
        except ValueError as error:
            faults.append(InputFault(key, str(error)))
    if faults:
        raise InputError(faults)
    return Spot(**coordinates)


def _describe_meant(value: object, roadmap: Roadmap | None) -> str:
    """Return the place that the user may have meant by a value that is none."""
    labels = roadmap.labels if roadmap else None
    if is_whole(value) and str(value) in (labels or ()):
        return f"did you mean the vertex '{value}'? write it in quotes"
    if is_whole(value) and labels is None and not str(value).startswith("-"):
        return f"did you mean N{value}?"
    if isinstance(value, list | tuple) and len(value) == 2:  # noqa: PLR2004 - x and y
        try:
            return f"for a point write {Spot(*map(read_exact, value))}"
        except ValueError:
            pass
    return f"give {list_kinds_of_places(roadmap)}"


def list_kinds_of_places(roadmap: Roadmap | None) -> str:
    """Return how places of a roadmap may be written; None for any roadmap."""
    if roadmap is None:
        return "N<k>, [row, column], {x, y} or a vertex name"
    return "N<k>, [row, column] or {x, y}" if roadmap.grid else "the name of a vertex, or {x, y}"


def find_vertex_at(
    roadmap: Roadmap,
    place: Place,
    *,
    units: Units | None = None,
    what_blocks: Callable[[int, int], str] | None = None,
) -> VertexId:
    """Return the vertex at a place.

    Raises
    ------
    InputError
        If the place is outside the map, blocked, or not known; with the place and a remedy.

    Notes
    -----
    On a grid, a point belongs to the cell that holds it. A point on the border of two cells belongs
    to the right or, in the drawing, the lower one; one on the border of the map to the cell inside.
    On a drawn roadmap, a point is the vertex at this very point; on one whose vertices are squares,
    the square that holds it, by the same rule.
    """
    grid = roadmap.grid
    if grid is None:
        if isinstance(place, Spot):
            return _find_vertex_at_point(place, roadmap, units or Units())
        return _find_named(place, roadmap)
    if isinstance(place, Spot):
        row, column = _find_cell_at(place, roadmap, grid)
    else:
        row, column = place if isinstance(place, tuple) else _read_numbered(place, grid)
    if not (0 <= row < grid.rows and 0 <= column < grid.columns):
        raise InputError.at(
            "",
            f"{_name_place(place)} is outside the map ({_describe_limits(place, roadmap, grid)})",
        )
    vertex = int(grid.vertex_at[row * grid.columns + column])
    if vertex >= 0:
        return VertexId(vertex)
    obstacle = what_blocks(row, column) if what_blocks else "a wall"
    if isinstance(place, Spot):
        near = _find_nearest(place, roadmap)
        nearest = _describe_with_distance(near, place, roadmap, units or Units())
        at = f" lies in N{row * grid.columns + column}, row {row}, column {column}, which"
        free = f"the nearest free cell is {nearest}"
    else:
        at = "" if isinstance(place, tuple) else f", row {row}, column {column},"
        free = f"{_free_cell(row, column, grid)} is free"
    raise InputError.at("", f"{_name_place(place)}{at} is blocked by {obstacle} ({free})")


def _find_named(place: str | tuple[int, int], roadmap: Roadmap) -> VertexId:
    if isinstance(place, tuple):
        message = f"{_name_place(place)} needs a grid, and this is a roadmap (give a vertex name)"
        raise InputError.at("", message)
    try:
        return roadmap.get_place(place)
    except UnknownVertex as error:
        raise InputError.at("", error.faults[0].message) from None


def _read_numbered(place: str, grid: Grid) -> tuple[int, int]:
    number = place[1:]
    if not (place.startswith("N") and number.isascii() and number.isdecimal()):
        meant = f"N{place.lstrip('nN')}"
        is_meant = meant[1:].isascii() and meant[1:].isdecimal()
        hint = f"did you mean {meant}?" if is_meant else "give N<k>, [row, column] or {x, y}"
        raise InputError.at("", f"{quote(place)} is no place on a grid ({hint})")
    if len(number) > LONGEST_NUMBER or int(number) >= grid.rows * grid.columns:
        last = grid.rows * grid.columns - 1
        raise InputError.at("", f"{quote(place)} is outside the map (cells are N0 to N{last})")
    return divmod(int(number), grid.columns)


def _find_cell_at(spot: Spot, roadmap: Roadmap, grid: Grid) -> tuple[int, int]:
    """Return row and column of the cell that holds a point; also of cells outside the map."""
    x, y = roadmap.frame.to_plane((spot.x, spot.y))
    half = Fraction(1, 2)  # the plane's (0, 0) is the centre of the first cell
    right, down = x / grid.cell_size + half, y / grid.cell_size + half
    return (
        grid.rows - 1 if down == grid.rows else int(down // 1),
        grid.columns - 1 if right == grid.columns else int(right // 1),
    )


def _describe_limits(place: Place, roadmap: Roadmap, grid: Grid) -> str:
    """Return which places a grid has."""
    if not isinstance(place, Spot):
        return f"rows are 0 to {grid.rows - 1}, columns 0 to {grid.columns - 1}"
    size, half = grid.cell_size, Fraction(1, 2)
    corners = [
        roadmap.frame.to_site(((column - half) * size, (row - half) * size))
        for row in (0, grid.rows)
        for column in (0, grid.columns)
    ]
    (left, *_, right), (low, *_, high) = (sorted(axis) for axis in zip(*corners, strict=True))
    ends = [write_decimal(end, 3) for end in (left, right, low, high)]
    return f"x is {ends[0]} to {ends[1]}, y {ends[2]} to {ends[3]}"


def _find_vertex_at_point(spot: Spot, roadmap: Roadmap, units: Units) -> VertexId:
    x, y = roadmap.frame.to_plane((spot.x, spot.y))
    if roadmap.sides is not None:
        return _find_square_at(spot, roadmap, roadmap.drawn_sides, units)
    vertices = np.flatnonzero((roadmap.positions == (float(x), float(y))).all(axis=1)).tolist()
    if len(vertices) == 1:
        return VertexId(vertices[0])
    if vertices:
        names = ", ".join(repr(roadmap.name(vertex)) for vertex in vertices)
        raise InputError.at("", f"{spot} is the point of {names} (give one of these names)")
    near = _describe_with_distance(_find_nearest(spot, roadmap), spot, roadmap, units)
    raise InputError.at("", f"no vertex is at {spot} (the nearest is {near})")


def _find_square_at(
    spot: Spot, roadmap: Roadmap, sides: NDArray[np.float64], units: Units
) -> VertexId:
    x, y = roadmap.frame.to_plane((spot.x, spot.y))
    away = np.abs(roadmap.positions - (float(x), float(y))).max(axis=1)
    vertices = np.flatnonzero(away <= sides / 2 + ON_BORDER * sides.min())
    if len(vertices):
        return VertexId(
            int(max(vertices, key=lambda vertex: tuple(roadmap.positions[vertex, ::-1])))
        )
    near = _describe_with_distance(_find_nearest(spot, roadmap), spot, roadmap, units)
    raise InputError.at("", f"{spot} is in no free cell (the nearest has its middle at {near})")


def _find_nearest(spot: Spot, roadmap: Roadmap) -> int:
    """Return the vertex nearest to a point."""
    x, y = roadmap.frame.to_plane((spot.x, spot.y))
    gaps = roadmap.positions - (float(x), float(y))
    return int(np.argmin(np.hypot(gaps[:, 0], gaps[:, 1])))


def _describe_with_distance(vertex: int, spot: Spot, roadmap: Roadmap, units: Units) -> str:
    """Return a vertex with its point and its distance from a point."""
    point: Point = roadmap.get_point(vertex)
    away = float(measure_squared_distance(point, (spot.x, spot.y))) ** 0.5
    name = roadmap.name(vertex) if roadmap.grid else repr(roadmap.name(vertex))
    if (
        _find_smallest_side(roadmap) > 4 * SHORT
    ):  # a point near the middle of a cell lies in it, too
        point = round(point[0] / SHORT) * SHORT, round(point[1] / SHORT) * SHORT
    return f"{name} at {Spot(*point)}, {units.write_length(away)} away"


def _find_smallest_side(roadmap: Roadmap) -> Fraction:
    """Return the side of the smallest cell, 0 for vertices that are points."""
    if roadmap.grid is not None:
        return roadmap.grid.cell_size
    return Fraction(0) if roadmap.sides is None else min(roadmap.sides)


def _name_place(place: Place) -> str:
    return f"[{quote(place[0])}, {quote(place[1])}]" if isinstance(place, tuple) else str(place)


def _free_cell(row: int, column: int, grid: Grid) -> str:
    """Return the name of the free cell nearest to a cell."""
    rows, columns = np.divmod(grid.cells, grid.columns)
    nearest_vertex = int(np.argmin(np.abs(rows - row) + np.abs(columns - column)))
    return f"N{int(grid.cells[nearest_vertex])}"


def _write_coordinate(coordinate: Fraction) -> str:
    """Return a coordinate exactly."""
    text = write_decimal(coordinate, DECIMALS)
    return text if Fraction(text) == coordinate else str(coordinate)
