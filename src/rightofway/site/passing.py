"""Vertices that robots only drive through, and the chains of edges that lead through them.

A robot never stops at a passed vertex. So a *chain* (the edges from one vertex where robots may
stop, through passed vertices, to the next such vertex) is one drive: a robot books all of it from
its begin to its end. Each chain has vertices of its own, which stand for the passed vertices, and
which exclude other robots from all that the chain touches. A robot that stays at such a vertex
therefore loses nothing by staying at the begin of the chain instead, and all searches may treat
the vertices of chains as any other vertex.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.site.geometry import VertexId


@dataclass(frozen=True, kw_only=True, eq=False)
class Passing:
    """The passed vertices of a roadmap and its chains.

    Attributes
    ----------
    vertices
        The passed vertices as they are drawn; no edge of the roadmap leads to them.
    chains
        For each chain the vertex where it begins, its own vertices, and the vertex where it ends.
    drawn
        For each vertex of the roadmap the vertex that it stands for: only the vertices of chains
        stand for others; int32, shape (V,).
    indptr, heads, class_of_edge
        The edges as they are drawn, as those of `Roadmap`.
    """

    vertices: frozenset[VertexId]
    chains: tuple[tuple[VertexId, ...], ...]
    drawn: NDArray[np.int32]
    indptr: NDArray[np.int32]
    heads: NDArray[np.int32]
    class_of_edge: NDArray[np.int32]
    _by_way: dict[tuple[int, ...], tuple[VertexId, ...]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        by_way = {tuple(self.drawn[list(chain)].tolist()): chain for chain in self.chains}
        object.__setattr__(self, "_by_way", by_way)

    @property
    def n_drawn(self) -> int:
        """Number of drawn vertices; the vertices of chains have larger numbers."""
        return len(self.indptr) - 1

    def is_equal(self, other: Passing | None) -> bool:
        """Return whether passed vertices and edges are drawn alike."""
        return (
            other is not None
            and self.vertices == other.vertices
            and np.array_equal(self.indptr, other.indptr)
            and np.array_equal(self.heads, other.heads)
            and np.array_equal(self.class_of_edge, other.class_of_edge)
        )

    def is_drawn(self, tail: int, head: int) -> bool:
        """Return whether an edge is drawn from one vertex to another."""
        is_known = max(tail, head) < self.n_drawn
        return is_known and head in self.heads[self.indptr[tail] : self.indptr[tail + 1]]

    def list_pairs(self, tail: int, head: int) -> list[tuple[int, int]]:
        """Return the ends of all edges that stand for a drawn edge, or for an edge of chains."""
        return self._pairs.get((tail, head), [(tail, head)])

    @cached_property
    def _pairs(self) -> dict[tuple[int, int], list[tuple[int, int]]]:
        pairs: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for chain in self.chains:
            for tail, head in pairwise(chain):
                drawn = int(self.drawn[tail]), int(self.drawn[head])
                pairs.setdefault(drawn, []).append((tail, head))
        return pairs

    def unfold_route(self, vertices: Sequence[int]) -> list[VertexId]:
        """Return a route with the vertices of chains in place of passed vertices.

        Passed vertices that are on no chain with their neighbours stay as they are.
        """
        route = list(map(VertexId, vertices))
        begin = 0
        while begin < len(route):
            end = begin + 1
            while end < len(route) and route[end] in self.vertices:
                end += 1
            chain = self._by_way.get(tuple(route[begin : end + 1]))
            if chain is not None:
                route[begin : end + 1] = chain
            begin = end
        return route

    @cached_property
    def copies(self) -> dict[int, list[VertexId]]:
        """The vertices of chains that stand for each passed vertex."""
        copies: dict[int, list[VertexId]] = {}
        for chain in self.chains:
            for vertex in chain[1:-1]:
                copies.setdefault(int(self.drawn[vertex]), []).append(vertex)
        return copies

    @cached_property
    def chains_at(self) -> dict[int, list[int]]:
        """The chains that each vertex is on, by number; ends are on their chains, too."""
        chains: dict[int, list[int]] = {}
        for number, chain in enumerate(self.chains):
            for vertex in chain:
                chains.setdefault(vertex, []).append(number)
        return chains
