"""Chains of a roadmap: a drive through passed vertices for each way through them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

import numpy as np

from rightofway.deadline import READING, check_work
from rightofway.errors import InputError, quote
from rightofway.site.geometry import VertexId
from rightofway.site.passing import Passing
from rightofway.site.roadmap import Roadmap

MOST_STEPS = 100_000
"""Vertices on all ways through passed vertices, at most, with the ways that lead nowhere."""


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
