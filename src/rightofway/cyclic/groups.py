"""Independent groups: robots that can ever have to do with each other, even through others."""

from __future__ import annotations

from collections.abc import Sequence

from rightofway.cyclic.route import CyclicRoute
from rightofway.model import VertexId

__all__ = ["independent_groups"]


def independent_groups(fleet: Sequence[CyclicRoute]) -> list[list[CyclicRoute]]:
    """Part a fleet into groups whose laps share no vertex.

    Returns
    -------
    list
        Groups by their first robots, robots in the order given.
    """
    leader = list(range(len(fleet)))

    def lead(index: int) -> int:
        while leader[index] != index:
            leader[index] = index = leader[leader[index]]
        return index

    first_at: dict[VertexId, int] = {}
    for index, endless in enumerate(fleet):
        for vertex in set(endless.lap.vertices):
            one, other = lead(first_at.setdefault(vertex, index)), lead(index)
            leader[max(one, other)] = min(one, other)
    groups: dict[int, list[CyclicRoute]] = {}
    for index, endless in enumerate(fleet):
        groups.setdefault(lead(index), []).append(endless)
    return list(groups.values())
