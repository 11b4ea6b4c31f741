"""Where the vertices of a roadmap are drawn: one unit is a cell, or a short edge of the roadmap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Roadmap

__all__ = ["Plane", "plane_of"]

SHORT = 0.1
"""Share of edges that may be shorter than a unit: one tiny edge shall not shrink all robots."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plane:
    """A roadmap laid out for drawing.

    Attributes
    ----------
    points
        Where each vertex is, x to the right and y down [units]; float64, shape (V, 2). On a grid
        these are (column, row).
    width, height
        The drawing spans -0.5 to ``width - 0.5`` and to ``height - 0.5`` [units].
    """

    points: NDArray[np.float64]
    width: float
    height: float


def plane_of(roadmap: Roadmap) -> Plane:
    """Lay out a roadmap."""
    grid = roadmap.grid
    if grid is not None:
        rows, columns = np.divmod(grid.cells, grid.columns)
        points = np.column_stack((columns, rows)).astype(np.float64)
        return Plane(points=points, width=grid.columns, height=grid.rows)
    points = (roadmap.positions - roadmap.positions.min(axis=0)) / _short_edge(roadmap)
    width, height = points.max(axis=0) + 1
    return Plane(points=points, width=float(width), height=float(height))


def _short_edge(roadmap: Roadmap) -> float:
    """Return the drawn length of an edge such that few are shorter."""
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    drawn = np.hypot(*(roadmap.positions[roadmap.heads] - roadmap.positions[tails]).T)
    drawn = drawn[drawn > 0]
    return float(np.quantile(drawn, SHORT)) if len(drawn) else 1.0
