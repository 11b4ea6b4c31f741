"""Vertices that robots only drive through, and the chains of edges that lead through them.

A robot never stops at a passed vertex. So a *chain* (the edges from one vertex where robots may
stop, through passed vertices, to the next such vertex) is one drive: a robot books all of it from
its begin to its end. Each chain has vertices of its own, which stand for the passed vertices, and
which exclude other robots from all that the chain touches. A robot that stays at such a vertex
therefore loses nothing by staying at the begin of the chain instead, and all searches may treat
the vertices of chains as any other vertex.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import READING, check_work
from rightofway.errors import InputError, quote
from rightofway.site.geometry import VertexId

if TYPE_CHECKING:
    from rightofway.site.roadmap import Roadmap

MOST_STEPS = 100_000
"""Vertices on all ways through passed vertices, at most, with the ways that lead nowhere."""


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
        """How many vertices are drawn; the vertices of chains have larger numbers."""
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


def fold(roadmap: Roadmap) -> Roadmap:
    """Return a roadmap as it is drawn, with edges to passed vertices and without chains.

    No plan may be made on it: nothing keeps robots from a stop at a passed vertex.
    """
    passing = roadmap.passing
    if passing is None or roadmap.heads is passing.heads:
        return roadmap
    n = passing.n_drawn
    return replace(
        roadmap,
        indptr=passing.indptr,
        heads=passing.heads,
        class_of_edge=passing.class_of_edge,
        positions=roadmap.positions[:n],
        labels=None if roadmap.labels is None else roadmap.labels[:n],
        fractions={at: point for at, point in roadmap.fractions.items() if at < n},
        sides=None if roadmap.sides is None else roadmap.sides[:n],
        passing=replace(passing, chains=(), drawn=passing.drawn[:n]),
    )


def unfold(roadmap: Roadmap, passed: Collection[VertexId]) -> Roadmap:
    """Return a roadmap with a chain for each way through passed vertices.

    Raises
    ------
    InputError
        If there are more than `MOST_STEPS` vertices on all ways.
    """
    if not passed:
        return roadmap
    through = frozenset(passed)
    n = roadmap.n_vertices
    chains = list[tuple[VertexId, ...]]()
    drawn, tails, heads, kinds = list(range(n)), list[int](), list[int](), list[int]()
    inside = list[tuple[int, int, int]]()  # edges that leave vertices of chains
    for tail in range(n):
        for edge in _list_edges(roadmap, tail) if tail not in through else ():
            head, kind = int(roadmap.heads[edge]), int(roadmap.class_of_edge[edge])
            if head not in through:
                tails.append(tail)
                heads.append(head)
                kinds.append(kind)
                continue
            for path in _find_paths(roadmap, through, edge, tail, len(drawn) - n):
                first = len(drawn)
                drawn += [int(roadmap.heads[step]) for step in path[:-1]]
                own = [*range(first, len(drawn)), int(roadmap.heads[path[-1]])]
                chains.append(tuple(map(VertexId, (tail, *own))))
                tails.append(tail)
                heads.append(first)
                kinds.append(kind)
                for at, to, step in zip(own[:-1], own[1:], path[1:], strict=True):
                    inside.append((at, to, int(roadmap.class_of_edge[step])))
    for at, to, kind in inside:
        tails.append(at)
        heads.append(to)
        kinds.append(kind)
    stands_for = np.array(drawn, np.int32)
    counts = np.bincount(np.array(tails, np.int64), minlength=len(drawn))
    return replace(
        roadmap,
        indptr=np.concatenate(([0], np.cumsum(counts))).astype(np.int32),
        heads=np.array(heads, np.int32),
        class_of_edge=np.array(kinds, np.int32),
        positions=roadmap.positions[stands_for],
        labels=tuple(roadmap.name(vertex) for vertex in drawn),
        fractions=dict(roadmap.fractions)
        | {at: roadmap.fractions[of] for at, of in enumerate(drawn) if of in roadmap.fractions},
        sides=None if roadmap.sides is None else tuple(roadmap.sides[vertex] for vertex in drawn),
        passing=Passing(
            vertices=through,
            chains=tuple(chains),
            drawn=stands_for,
            indptr=roadmap.indptr,
            heads=roadmap.heads,
            class_of_edge=roadmap.class_of_edge,
        ),
    )


def list_next_stops(roadmap: Roadmap, vertex: int) -> list[int]:
    """Return the vertices where a robot may stop next after a vertex, in the order of its edges."""
    stops = list[int]()
    for edge in _list_edges(roadmap, vertex):
        head = int(roadmap.heads[edge])
        while head >= roadmap.n_drawn and (onward := _list_edges(roadmap, head)):
            head = int(roadmap.heads[onward[0]])  # a vertex of a chain has one edge
        if head < roadmap.n_drawn:
            stops.append(head)
    return list(dict.fromkeys(stops))


def _list_edges(roadmap: Roadmap, tail: int) -> range:
    return range(int(roadmap.indptr[tail]), int(roadmap.indptr[tail + 1]))


def _find_paths(
    roadmap: Roadmap, through: frozenset[VertexId], first: int, begin: int, n_steps: int
) -> Iterator[list[int]]:
    """Yield the edges of each path from an edge through passed vertices, to where robots may stop.

    A path comes to no vertex twice. ``n_steps`` vertices are on other ways already.
    """
    path, open_edges = [first], [iter(_list_edges(roadmap, int(roadmap.heads[first])))]
    visited = {begin, int(roadmap.heads[first])}
    while path:
        edge = next(open_edges[-1], None)
        if edge is None:
            visited.remove(int(roadmap.heads[path.pop()]))
            open_edges.pop()
            continue
        n_steps += 1
        if n_steps > MOST_STEPS:
            name = quote(roadmap.name(int(roadmap.heads[first])))
            message = f"more than {MOST_STEPS} vertices are on the ways through {name} and other"
            message += " vertices with pass (take pass out of some)"
            raise InputError.at("vertices", message)
        check_work(READING)
        head = int(roadmap.heads[edge])
        if head in visited:
            continue
        if head not in through:
            yield [*path, edge]
            n_steps += len(path)
            continue
        visited.add(head)
        path.append(edge)
        open_edges.append(iter(_list_edges(roadmap, head)))
