"""Ways on which every edge leads as far towards the target as any edge can: no way is shorter.

Most ways through halls and warehouses are like that, and to walk one, for a whole fleet at once,
takes a fraction of a search.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Roadmap

__all__ = ["straight_hops"]

SLACK = 1e-7
"""The part of an edge that rounding may hide; all edges of a way together hide less than one."""

Indices = NDArray[np.int64]
Gaps = NDArray[np.float64]
"""How far it is along each axis; shape (n, 2)."""

MANNERS: tuple[Callable[[Gaps], Gaps], ...] = (
    lambda gaps: np.maximum(gaps[:, 0], gaps[:, 1]),
    lambda gaps: gaps[:, 0],
    lambda gaps: gaps[:, 1],
)
"""Of which gap to leave least: the wider one, the one along the first axis, or along the second."""


def straight_hops(roadmap: Roadmap, sources: Indices, targets: Indices) -> Indices:
    """Return the least number of edges from sources to targets, -1 where no straight way is found.

    Parameters
    ----------
    roadmap
        The graph.
    sources, targets
        From where to where; vertex ids; int64, shape (n,).

    Returns
    -------
    ndarray
        int64, shape (n,).
    """
    found = np.full(len(sources), -1)
    reach = _reach(roadmap)
    rounding = 8 * np.spacing(np.abs(roadmap.positions).max())
    if reach * SLACK <= rounding:  # as where all vertices lie at one point
        return found
    for manner in MANNERS:
        pending = np.flatnonzero(found < 0)
        found[pending] = _walk(
            roadmap, sources[pending], targets[pending], reach * (1 - SLACK), manner
        )
    return found


def _reach(roadmap: Roadmap) -> float:
    """Return how far the longest edge leads, along both axes together."""
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    gaps = np.abs(roadmap.positions[tails] - roadmap.positions[roadmap.heads])
    return float(gaps.sum(axis=1).max(initial=0))


def _walk(
    roadmap: Roadmap,
    sources: Indices,
    targets: Indices,
    reach: float,
    manner: Callable[[Gaps], Gaps],
) -> Indices:
    """Walk from all sources at once; return how many edges it took, -1 for who got stuck."""
    at, found = sources.copy(), np.full(len(sources), -1)
    walking, step = np.arange(len(sources)), 0
    while len(walking):
        there = at[walking] == targets[walking]
        found[walking[there]] = step
        walking = walking[~there]
        head = _next(roadmap, at[walking], roadmap.positions[targets[walking]], reach, manner)
        goes_on = head >= 0
        walking, step = walking[goes_on], step + 1
        at[walking] = head[goes_on]
    return found


def _next(
    roadmap: Roadmap, at: Indices, goal: Gaps, reach: float, manner: Callable[[Gaps], Gaps]
) -> Indices:
    """Return the best neighbour that is nearer by the reach of an edge, -1 where there is none."""
    limit = np.abs(roadmap.positions.take(at, axis=0) - goal).sum(axis=1) - reach
    edge, end = roadmap.indptr[at].astype(np.int64), roadmap.indptr[at + 1]
    best, left = np.full(len(at), -1), np.full(len(at), np.inf)
    for _ in range(int((end - edge).max(initial=0))):
        head = roadmap.heads[np.minimum(edge, end - 1)]
        gaps = np.abs(roadmap.positions.take(head, axis=0) - goal)
        rest = np.where((edge < end) & (gaps[:, 0] + gaps[:, 1] <= limit), manner(gaps), np.inf)
        best, left = np.where(rest < left, head, best), np.minimum(rest, left)
        edge += 1
    return best
