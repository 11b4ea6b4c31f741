"""Least times to a target where turns between edges take time: distances over pairs of edges.

A state is the edge that a robot has driven; an arc leads to each edge that follows, and takes the
turn and the drive. Each vertex of the roadmap is one more state, which its last edges lead to.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model.turning import Turning
from rightofway.site import Roadmap, VertexId

LAST = 1
"""Ticks of the arc from an edge to the state of its vertex: the kernel takes no 0."""


class TurningDistances:
    """Distances of one pace and turn rate, from the ticks of each edge, -1 where it is barred."""

    def __init__(self, roadmap: Roadmap, edge_ticks: NDArray[np.int32], turning: Turning) -> None:
        self._indptr, self._edge_ticks = roadmap.indptr, edge_ticks
        self._n_edges, n_vertices = len(roadmap.heads), roadmap.n_vertices
        begins, ends = roadmap.indptr[roadmap.heads], roadmap.indptr[roadmap.heads + 1]
        counts = (ends - begins).astype(np.int64)
        # Of each edge: all edges that leave its head, then the state of its head.
        indptr = np.concatenate(([0], np.cumsum(counts + 1)))
        place = np.arange(indptr[-1]) - np.repeat(indptr[:-1], counts + 1)
        is_last = place == np.repeat(counts, counts + 1)
        before = np.repeat(np.arange(self._n_edges), counts + 1)
        after = np.repeat(begins, counts + 1) + place
        turns = turning.compute_turns_between(before, np.where(is_last, -1, after))
        follows = np.where(is_last, 0, after)
        drives = edge_ticks[follows].astype(np.int64)
        ticks = np.where(drives < 0, -1, drives + turns)
        self._ticks = np.where(is_last, LAST, ticks).astype(np.int32)
        heads = np.where(is_last, self._n_edges + roadmap.heads[before], follows)
        states = np.concatenate((indptr, np.full(n_vertices, indptr[-1])))
        self._kernel = _core.DistanceTables(states.astype(np.int32), heads.astype(np.int32))

    def to(self, target: VertexId) -> NDArray[np.int32]:
        """Return the least ticks from every vertex to a target, -1 without a way; int32[V]."""
        behind = self._kernel.to(self._n_edges + target, self._ticks)[: self._n_edges]
        is_way = (behind >= 0) & (self._edge_ticks >= 0)
        most = np.iinfo(np.int32).max
        ticks = np.where(is_way, self._edge_ticks + behind - LAST, most)
        least = np.full(len(self._indptr) - 1, most, np.int32)
        has_edges = np.flatnonzero(np.diff(self._indptr))
        if len(has_edges):
            least[has_edges] = np.minimum.reduceat(ticks, self._indptr[:-1][has_edges])
        least[target] = 0
        return np.where(least == most, -1, least).astype(np.int32)
