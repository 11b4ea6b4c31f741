"""How many edges lie between places, for a whole fleet at once.

Where no straight way is found, a breadth-first search for 256 queries costs little more than for
one: each vertex keeps one bit for each of them, set once it is within reach of that query's source,
and takes over its neighbours' bits in every step.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rightofway.metrics.straight import straight_hops
from rightofway.model import Roadmap

__all__ = ["hops"]

WORD = 64
"""Bits in a word."""

BLOCK = 4 * WORD
"""Queries in a block; four words a vertex stay in the processor's cache on most maps."""

Indices = NDArray[np.int64]


def hops(roadmap: Roadmap, sources: Indices, targets: Indices) -> Indices:
    """Return the least number of edges from each source to its target, -1 where no way leads.

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
    if _leads_back(roadmap):  # then the way home is as long as the way out
        sources, targets = np.minimum(sources, targets), np.maximum(sources, targets)
    queries, query_of = np.unique(sources * roadmap.n_vertices + targets, return_inverse=True)
    sources, targets = np.divmod(queries, roadmap.n_vertices)
    found = straight_hops(roadmap, sources, targets)
    rank, rounds = _by_edges_in(roadmap)
    for block in _blocks(roadmap, np.flatnonzero(found < 0), sources, targets):
        found[block] = _search(
            rounds, roadmap.n_vertices, rank[sources[block]], rank[targets[block]]
        )
    return found[query_of]


def _tails(roadmap: Roadmap) -> Indices:
    return np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))


def _leads_back(roadmap: Roadmap) -> bool:
    """Return whether each edge has one in the other direction."""
    tails, heads = _tails(roadmap), roadmap.heads.astype(np.int64)
    there, back = tails * roadmap.n_vertices + heads, heads * roadmap.n_vertices + tails
    return np.array_equal(np.sort(there), np.sort(back))


def _by_edges_in(roadmap: Roadmap) -> tuple[Indices, list[Indices]]:
    """Return a new number for each vertex, those with most edges in first, and rounds of edges.

    Round k has the tail (by new number) of the k-th edge into each vertex that has so many. Their
    heads are then 0, 1, 2, …, and need no index.
    """
    n_vertices = roadmap.n_vertices
    edges_in = np.bincount(roadmap.heads, minlength=n_vertices)
    rank = np.empty(n_vertices, np.int64)
    rank[np.argsort(-edges_in, kind="stable")] = np.arange(n_vertices)
    tails = rank[_tails(roadmap)]
    heads = rank[roadmap.heads]
    order = np.argsort(heads, kind="stable")
    tails, heads = tails[order], heads[order]
    number = np.arange(len(heads)) - np.searchsorted(heads, heads)
    return rank, [tails[number == k] for k in range(edges_in.max(initial=0))]


def _blocks(
    roadmap: Roadmap, queries: Indices, sources: Indices, targets: Indices
) -> Iterator[Indices]:
    """Yield queries in blocks of about equally long ways, which end at about the same step."""
    gaps = np.abs(roadmap.positions[sources[queries]] - roadmap.positions[targets[queries]])
    order = queries[np.argsort(gaps.sum(axis=1), kind="stable")]
    for begin in range(0, len(order), BLOCK):
        yield order[begin : begin + BLOCK]


def _search(rounds: list[Indices], n_vertices: int, sources: Indices, targets: Indices) -> Indices:
    """Search for all targets of a block, step by step."""
    found = np.full(len(sources), -1)
    pending = np.arange(len(sources))
    word, bit = pending // WORD, np.uint64(1) << (pending % WORD).astype(np.uint64)
    reach = np.zeros((n_vertices, int(word[-1]) + 1), np.uint64)
    np.bitwise_or.at(reach, (sources, word), bit)
    step = 0
    while len(pending):
        arrived = (reach[targets[pending], word[pending]] & bit[pending]) != 0
        found[pending[arrived]] = step
        pending = pending[~arrived]
        grown = _grow(reach, rounds)
        if np.array_equal(grown, reach):
            break
        reach, step = grown, step + 1
    return found


def _grow(reach: NDArray[np.uint64], rounds: list[Indices]) -> NDArray[np.uint64]:
    grown, taken = reach.copy(), np.empty_like(reach)
    for tails in rounds:
        heads = slice(len(tails))
        # Ten times as fast as an index in brackets; "clip" only saves a copy, none is out of range.
        np.take(reach, tails, axis=0, out=taken[heads], mode="clip")
        grown[heads] |= taken[heads]
    return grown
