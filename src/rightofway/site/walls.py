"""Robots wider than a cell beside the walls of a grid.

A robot of radius r at the centre of a free cell reaches into a blocked cell, or over the border of
the grid, where that is nearer than r. A drive between two cells comes no nearer to any blocked cell
than its ends do.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from heapq import heappop, heappush
from math import ceil, isqrt

import numpy as np
from numpy.typing import NDArray

from rightofway.site.roadmap import EdgeClass, Grid, Roadmap

ROUNDED = Fraction(1, 1000)
"""Room beside walls is rounded down to this [length unit]."""


@lru_cache(maxsize=8)
def reaches_walls(roadmap: Roadmap, radius: Fraction) -> NDArray[np.bool_]:
    """Return at which vertices a robot reaches into a blocked cell or over the border.

    Returns
    -------
    ndarray
        Booleans, shape (V,). Discs may touch walls.
    """
    grid = roadmap.grid
    assert grid is not None, "only grids have walls"
    reach = ceil((2 * radius / grid.cell_size) ** 2)
    reaches: NDArray[np.bool_] = measure_gaps(grid, reach) < reach
    return reaches


def measure_gaps(grid: Grid, limit: int | None = None) -> NDArray[np.int64]:
    """Return the squared distance from each vertex to the nearest wall or border [half cells].

    It is exact below the limit, and the limit or more elsewhere.
    """
    blocked = grid.vertex_at.reshape(grid.rows, grid.columns) < 0
    columns, rows = np.arange(grid.columns), np.arange(grid.rows)[:, None]
    before = np.maximum.accumulate(np.where(blocked, columns, -1), axis=1)
    behind = np.where(blocked, columns, grid.columns)[:, ::-1]
    behind = np.minimum.accumulate(behind, axis=1)[:, ::-1]
    in_row = _measure_square_gaps(np.minimum(columns - before, behind - columns))
    gaps = np.minimum(in_row, _measure_square_gaps(np.minimum(rows + 1, grid.rows - rows)))
    for offset in range(1, grid.rows):
        in_column = (2 * offset - 1) ** 2
        if in_column >= (gaps.max() if limit is None else min(limit, gaps.max())):
            break
        np.minimum(gaps[offset:], in_row[:-offset] + in_column, out=gaps[offset:])
        np.minimum(gaps[:-offset], in_row[offset:] + in_column, out=gaps[:-offset])
    return gaps.ravel()[grid.cells]


def _measure_square_gaps(offsets: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the squared gaps between the middles of cells and other cells [half cells]."""
    return np.maximum(2 * offsets - 1, 0) ** 2


def find_narrowest(roadmap: Roadmap, start: int, goal: int) -> tuple[Fraction, int] | None:
    """Return the largest radius for which walls leave a way, and the narrowest vertex of that way.

    The radius is rounded down to `ROUNDED` [length unit]; None where no way leads there at all.
    """
    grid = roadmap.grid
    assert grid is not None, "only grids have walls"
    gaps = measure_gaps(grid).tolist()
    indptr, heads = roadmap.indptr.tolist(), roadmap.heads.tolist()
    waiting, narrowest = [(-gaps[start], start)], {start: start}
    while waiting:  # the widest place first
        _, vertex = heappop(waiting)
        if vertex == goal:
            place = narrowest[goal]
            square = gaps[place] * (grid.cell_size / ROUNDED / 2) ** 2
            return isqrt(square.numerator // square.denominator) * ROUNDED, place
        for head in heads[indptr[vertex] : indptr[vertex + 1]]:
            if head not in narrowest:
                place = narrowest[vertex]
                narrowest[head] = head if gaps[head] < gaps[place] else place
                heappush(waiting, (-gaps[narrowest[head]], head))
    return None


def clear_of_walls(roadmap: Roadmap, radii: Collection[Fraction]) -> Roadmap:
    """Return the same grid with edges barred for robots that would reach into walls."""
    grid = roadmap.grid
    assert grid is not None, "only grids have walls"
    wide = sorted({radius for radius in radii if 2 * radius > grid.cell_size})
    if not wide:
        return roadmap
    fits = sum((~reaches_walls(roadmap, radius)).astype(np.int32) for radius in wide)
    return replace(
        roadmap,
        class_of_edge=np.asarray(fits, np.int32)[roadmap.heads],
        edge_classes=tuple(
            EdgeClass(length=grid.cell_size, max_radius=radius)
            for radius in (grid.cell_size / 2, *wide[:-1], None)
        ),
    )
