"""Positions of drawn vertices: in the plane of the map, and in one line next to a time axis."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.site import Roadmap

SHORT = 0.1
"""Share of edges that may be shorter than a unit, so that one tiny edge does not shrink robots."""

MAX_ROBOTS = 6
MAX_VERTICES = 40
"""Beyond these, the lines of all robots in one diagram can no longer be distinguished."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plane:
    """A roadmap laid out for drawing from -0.5 to ``width - 0.5`` and ``height - 0.5`` [units]."""

    points: NDArray[np.float64]  # of each vertex, x right and y down [units]; shape (V, 2)
    width: float
    height: float
    unit: float  # [length unit]
    corner: tuple[float, float]  # of the roadmap's plane, drawn at (0, 0) [length unit]


def lay_out_roadmap(roadmap: Roadmap) -> Plane:
    """Lay out a roadmap; one unit is a (smallest) cell, or a short edge of the roadmap."""
    roadmap = roadmap.fold()
    grid = roadmap.grid
    if grid is not None:
        rows, columns = np.divmod(grid.cells, grid.columns)
        points = np.column_stack((columns, rows)).astype(np.float64)
        return Plane(
            points=points,
            width=grid.columns,
            height=grid.rows,
            unit=float(grid.cell_size),
            corner=(0.0, 0.0),
        )
    if roadmap.sides is not None:
        unit, half = float(min(roadmap.sides)), roadmap.drawn_sides[:, None] / 2
        left, top = (roadmap.positions - half).min(axis=0) + unit / 2
        width, height = (roadmap.positions + half).max(axis=0) - (left, top) + unit / 2
        return Plane(
            points=(roadmap.positions - (left, top)) / unit,
            width=float(width / unit),
            height=float(height / unit),
            unit=unit,
            corner=(float(left), float(top)),
        )
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    drawn = np.hypot(*(roadmap.positions[roadmap.heads] - roadmap.positions[tails]).T)
    drawn = drawn[drawn > 0]
    unit = float(np.quantile(drawn, SHORT)) if len(drawn) else 1.0
    left, top = roadmap.positions.min(axis=0)
    points = (roadmap.positions - (left, top)) / unit
    width, height = points.max(axis=0) + 1
    return Plane(
        points=points,
        width=float(width),
        height=float(height),
        unit=unit,
        corner=(float(left), float(top)),
    )


def make_edge_length(roadmap: Roadmap) -> Callable[[int, int], float]:
    """Return the function from the ends of an edge to its length [length unit]; 0 without one."""
    roadmap = roadmap.fold()

    def length(tail: int, head: int) -> float:
        edge = None if tail == head else roadmap.find_edge(tail, head)
        return 0.0 if edge is None else float(roadmap.get_edge_class(edge).length)

    return length


def order_in_line(
    routes: Sequence[Sequence[int]], distance: Callable[[int, int], float]
) -> dict[int, float]:
    """Order the vertices of all routes so that every robot passes its own nearly in order.

    Returns
    -------
    dict
        The place along the line [length unit] of every visited vertex, in increasing order; empty
        where there are too many robots or vertices for one line.

    Notes
    -----
    The first route gives the places, each new vertex as far beyond the one before as its edge is
    long. Each further route is laid along the vertices it shares with those before: forwards or
    backwards, in proportion between them, at its own length beyond.
    """
    if len(routes) > MAX_ROBOTS or len(set().union(*routes)) > MAX_VERTICES:
        return {}
    places: dict[int, float] = {}
    for route in routes:
        steps = {head: distance(tail, head) for tail, head in reversed(list(pairwise(route)))}
        once = list(dict.fromkeys(route))
        laid = np.cumsum([0.0, *(steps[vertex] for vertex in once[1:])]).tolist()
        anchors = [index for index, vertex in enumerate(once) if vertex in places]
        if anchors:
            at = [places[once[anchor]] for anchor in anchors]
            along = [laid[anchor] for anchor in anchors]
            ahead = 1 if at[-1] >= at[0] else -1
            between = np.interp(laid, along, at).tolist()
            laid = [
                place + ahead * (min(laid_place - along[0], 0) + max(laid_place - along[-1], 0))
                for laid_place, place in zip(laid, between, strict=True)
            ]
        for vertex, place in zip(once, laid, strict=True):
            places.setdefault(vertex, place)
    return dict(sorted(places.items(), key=lambda item: (item[1], item[0])))
