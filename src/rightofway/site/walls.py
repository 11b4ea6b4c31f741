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
from math import ceil

import numpy as np
from numpy.typing import NDArray

from rightofway.site.roadmap import EdgeClass, Grid, Roadmap


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
    in_row = _square_gaps(np.minimum(columns - before, behind - columns))
    gaps = np.minimum(in_row, _square_gaps(np.minimum(rows + 1, grid.rows - rows)))
    for offset in range(1, grid.rows):
        in_column = (2 * offset - 1) ** 2
        if in_column >= (gaps.max() if limit is None else min(limit, gaps.max())):
            break
        np.minimum(gaps[offset:], in_row[:-offset] + in_column, out=gaps[offset:])
        np.minimum(gaps[:-offset], in_row[offset:] + in_column, out=gaps[:-offset])
    return gaps.ravel()[grid.cells]


def _square_gaps(offsets: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the squared gaps between the middles of cells and other cells [half cells]."""
    return np.maximum(2 * offsets - 1, 0) ** 2


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
