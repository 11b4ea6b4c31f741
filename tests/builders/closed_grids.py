"""Two robots on every small grid, with one closure: an enumeration."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from math import prod
from typing import Any

from rightofway.model import Closure, Robot, Rules, Scenario, Stop
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.fleets import largest_part

__all__ = ["Axes", "Grid", "count_instances", "list_axes", "list_grids", "make_instance"]

Grid = tuple[str, ...]
Axes = tuple[Sequence[Any], ...]

LONGEST, LATEST = {1: 6, 2: 4}, 8
"""Columns of grids at most, by rows, and the end of the last closure [ticks]."""

INTERVALS = list(combinations(range(LATEST + 1), 2))
OTHERS = list(product((0, 1), (0, 1)))
"""Headway and turning time."""


@cache
def list_grids() -> tuple[Grid, ...]:
    """Return every connected grid that fills its rows and columns, mirrored ones once."""
    grids = set[Grid]()
    for rows, most in LONGEST.items():
        for columns in range(2, most + 1):
            for cells in product(".@", repeat=rows * columns):
                grid = ["".join(cells[row * columns :][:columns]) for row in range(rows)]
                is_full = all("." in line for line in (*grid, *zip(*grid, strict=True)))
                if is_full and _is_connected(grid):
                    mirrored = [line[::-1] for line in grid]
                    grids.add(min(map(tuple, (grid, grid[::-1], mirrored, mirrored[::-1]))))
    return tuple(sorted(grids, key=lambda grid: (len(grid), len(grid[0]), grid)))


def _is_connected(grid: list[str]) -> bool:
    return len(largest_part(make_grid_roadmap(grid))) == "".join(grid).count(".")


def list_axes(grid: Grid) -> Axes:
    """Return all choices on a grid.

    The homes, whether each robot works at the home of the other one, how long each works, the
    occupancy, where trips end, what is closed, and when.
    """
    places = range("".join(grid).count("."))
    pairs = list(product((0, 1), repeat=2))
    works = list(product((0, 4), repeat=2))
    homes = list(combinations(places, 2))
    return homes, pairs, works, ["one", "both"], ["home", "none"], list(places), INTERVALS


def count_instances(axes: Axes) -> int:
    """Return the number of instances with some choices."""
    return prod(map(len, axes))


def make_instance(grid: Grid, axes: Axes, number: int) -> Scenario:
    """Return an instance by its number; headway and turning time change from one to the next."""
    headway, turn = OTHERS[number % len(OTHERS)]
    chosen = []
    for axis in axes:
        number, choice = divmod(number, len(axis))
        chosen.append(axis[choice])
    homes, visits_other, works, occupancy, ends, closed, (begin, end) = chosen
    robots = tuple(
        Robot(
            name=f"R{k + 1}",
            home=VertexId(homes[k]),
            stops=(Stop(at=VertexId(homes[k ^ visits_other[k]]), work=Fraction(works[k])),),
        )
        for k in range(2)
    )
    return Scenario(
        roadmap=make_grid_roadmap(grid),
        robots=robots,
        rules=Rules(occupancy=occupancy, headway=Fraction(headway), turn=Fraction(turn), ends=ends),
        closures=(Closure(at=VertexId(closed), from_=Fraction(begin), until=Fraction(end)),),
    )
