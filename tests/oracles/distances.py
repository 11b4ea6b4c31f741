"""Distances to one target, by Dijkstra's algorithm without a heap."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence


class Edge(NamedTuple):
    """A one-way street."""

    start: int
    end: int
    ticks: int


def distances_to(target: int, n_vertices: int, edges: Sequence[Edge]) -> list[int]:
    """Return the least ticks from each vertex to the target, -1 where no way leads there."""
    best = {target: 0}
    settled: dict[int, int] = {}
    while best.keys() - settled.keys():
        nearest = min(best.keys() - settled.keys(), key=lambda v: (best[v], v))
        settled[nearest] = best[nearest]
        for edge in edges:
            if edge.end == nearest:
                through = best[nearest] + edge.ticks
                best[edge.start] = min(best.get(edge.start, through), through)
    return [settled.get(v, -1) for v in range(n_vertices)]


def first_shortest_path(
    start: int, target: int, n_vertices: int, edges: Sequence[Edge]
) -> list[int]:
    """Return the path that takes the first edge on a shortest path at each vertex, or none."""
    to_go = distances_to(target, n_vertices, edges)
    if to_go[start] < 0:
        return []
    path = [start]
    while path[-1] != target:
        at = path[-1]
        path.append(
            next(
                edge.end
                for edge in edges
                if edge.start == at and to_go[edge.end] == to_go[at] - edge.ticks
            )
        )
    return path
