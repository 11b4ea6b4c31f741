"""The paper's way in: a floor with walls and tables, cut into cells by node clustering.

References
----------
Oleiwi, *Optimum path planning for multi mobile robots with speed of work achievement as
constrain*: "node clustering" makes the cells so small that every robot drives a whole number of
them in a unit of time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, InputFault

MAX_CELLS = 1_000_000
"""More cells than this are refused, unless a scenario raises the limit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Obstacle:
    """A rectangle that robots cannot enter, sides parallel to the floor's.

    Attributes
    ----------
    name
        For messages and the map; may be empty.
    x, y
        Its corner with the least x and y [length unit].
    width, height
        Its size [length unit], positive.
    """

    name: str
    x: Fraction
    y: Fraction
    width: Fraction
    height: Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Floor:
    """A rectangular floor with obstacles.

    Attributes
    ----------
    width, height
        Its size [length unit], positive.
    obstacles
        Walls, tables, machines; may overlap each other and the border.

    Raises
    ------
    InputError
        For a size that is not positive, or an obstacle that lies outside.
    """

    width: Fraction
    height: Fraction
    obstacles: tuple[Obstacle, ...] = ()

    def __post_init__(self) -> None:
        faults = list(_find_floor_faults(self))
        if faults:
            raise InputError(faults)


def _find_floor_faults(floor: Floor) -> Iterator[InputFault]:
    if floor.width <= 0 or floor.height <= 0:
        yield InputFault(
            "size", f"[{floor.width}, {floor.height}] is not positive (give two lengths)"
        )
        return
    for index, obstacle in enumerate(floor.obstacles):
        place = ("obstacles", index, "rect")
        if obstacle.width <= 0 or obstacle.height <= 0:
            size = f"{obstacle.width} by {obstacle.height}"
            yield InputFault(place, f"is {size}, not positive (give [x, y, width, height])")
        elif not (
            -obstacle.width < obstacle.x < floor.width
            and -obstacle.height < obstacle.y < floor.height
        ):
            yield InputFault(place, "lies outside the floor (move it, or take it out)")


def compute_node_length(speeds: Iterable[Fraction]) -> Fraction:
    """Return the cell size of node clustering: the least ``1 / v`` of the fleet.

    Parameters
    ----------
    speeds
        The speeds of the fleet [length units per time unit], above 0.

    Examples
    --------
    >>> compute_node_length([Fraction(1), Fraction(2)])
    Fraction(1, 2)
    """
    fleet = tuple(speeds)
    if not fleet or min(fleet) <= 0:
        raise InputError.at("speeds", "give the speed of at least one robot, each above 0")
    return min(1 / speed for speed in fleet)


def compute_steps_per_unit(speed: Fraction, length: Fraction) -> Fraction:
    """Return the number of cells that a robot drives in a time unit: ``speed / length``.

    Parameters
    ----------
    speed
        The speed of a robot [length units per time unit].
    length
        The cell size [length units].

    Examples
    --------
    >>> [int(compute_steps_per_unit(Fraction(v), Fraction(1, 2))) for v in (1, 2)]
    [2, 4]
    """
    return speed / length


def cluster(floor: Floor, cell_size: Fraction, *, max_cells: int = MAX_CELLS) -> tuple[str, ...]:
    """Return the rows of a floor's `free_cells`: ``.`` for free, ``@`` for blocked.

    Parameters
    ----------
    floor, cell_size, max_cells
        As for `free_cells`.
    """
    free = free_cells(floor, cell_size, max_cells=max_cells)
    return tuple("".join(row) for row in np.where(free, ".", "@"))


def free_cells(
    floor: Floor, cell_size: Fraction, *, max_cells: int = MAX_CELLS, key: str = "cell_size"
) -> NDArray[np.bool_]:
    """Cut a floor into square cells.

    Returns
    -------
    ndarray
        Which cells are free: those that no obstacle covers any part of; bool, shape (rows,
        columns).

    Raises
    ------
    InputError
        If no cell fits in, or more than ``max_cells`` do.
    """
    if cell_size <= 0:
        raise InputError.at(key, f"{cell_size} is not positive (give a length above 0)")
    columns, rows = floor.width // cell_size, floor.height // cell_size
    if not rows * columns:
        message = (
            f"{cell_size} is longer than the floor (give at most {min(floor.width, floor.height)})"
        )
        raise InputError.at(key, message)
    if rows * columns > max_cells:
        message = (
            f"cells of {cell_size} make {columns} x {rows} = {rows * columns} cells, more than"
            f" {max_cells} (give a larger {key}, speeds closer together, or raise max_cells)"
        )
        raise InputError.at(key, message)
    free = np.ones((rows, columns), np.bool_)
    for obstacle in floor.obstacles:
        across = _find_covered(obstacle.x, obstacle.width, cell_size)
        down = _find_covered(obstacle.y, obstacle.height, cell_size)
        free[down, across] = False
    return free


def _find_covered(start: Fraction, length: Fraction, cell_size: Fraction) -> slice:
    first = math.floor(start / cell_size)
    return slice(max(first, 0), max(math.ceil((start + length) / cell_size), 0))
