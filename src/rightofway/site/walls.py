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

from rightofway.site.roadmap import EdgeClass, Roadmap


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
    reach = 2 * radius / grid.cell_size  # in half cells, as are gaps
    steps = max(ceil((reach - 1) / 2), 0)
    blocked = np.pad(
        grid.vertex_at.reshape(grid.rows, grid.columns) < 0, steps, constant_values=True
    )
    is_wall = np.zeros((grid.rows, grid.columns), bool)
    for down in range(-steps, steps + 1):
        for right in range(-steps, steps + 1):
            gaps = (max(2 * abs(offset) - 1, 0) for offset in (down, right))
            if sum(gap**2 for gap in gaps) < reach**2:
                top, left = steps + down, steps + right
                is_wall |= blocked[top : top + grid.rows, left : left + grid.columns]
    reaches: NDArray[np.bool_] = is_wall.ravel()[grid.cells]
    return reaches


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
