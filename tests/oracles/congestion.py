"""Cheapest paths among others, by relaxing every edge until nothing changes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from tests.oracles.distances import Edge


@dataclass(frozen=True, slots=True, kw_only=True)
class Congestion:
    """What the kernel does, edge by edge; edges in order of where they start, then as they come."""

    n_vertices: int
    edges: Sequence[Edge]
    shares: int
    station: Sequence[int]
    driven: Counter[tuple[int, int]] = field(default_factory=Counter)

    def cost(self, edge: Edge, target: int) -> int:
        """Return what an edge costs a robot on its way to a target."""
        station = self.station[edge.end] if edge.end != target else 0
        return edge.ticks * (self.shares + station + self.driven[edge.end, edge.start])

    def to_go(self, target: int) -> dict[int, int]:
        """Return the least cost from each vertex from which the target can be reached."""
        least = {target: 0}
        for _ in range(self.n_vertices):
            for edge in self.edges:
                if edge.end in least:
                    through = least[edge.end] + self.cost(edge, target)
                    least[edge.start] = min(least.get(edge.start, through), through)
        return least

    def path(self, start: int, target: int) -> list[int]:
        """Return the cheapest path that leaves each vertex by the first edge that it can."""
        least, path = self.to_go(target), [start]
        while path[-1] != target:
            path.append(
                next(
                    edge.end
                    for edge in self.edges
                    if edge.start == path[-1]
                    and edge.end in least
                    and least[path[-1]] == least[edge.end] + self.cost(edge, target)
                )
            )
        return path

    def add(self, path: Sequence[int], oncoming: int) -> None:
        """Have one more robot on a path, and let it cost to go against it."""
        for step in pairwise(path):
            self.driven[step] += oncoming
