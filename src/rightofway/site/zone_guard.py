"""Lanes on which zones keep robots apart."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

import numpy as np

from rightofway.site.roadmap import Roadmap

Ends = tuple[int, int]
"""The two ends of a lane."""


class ZoneGuard:
    """The zones of a roadmap, to find lanes on which they keep robots apart.

    Where there are zones, a drive books its edge and the vertices at both ends.
    """

    def __init__(self, roadmap: Roadmap) -> None:
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
        self._edges = set(zip(tails, roadmap.heads.tolist(), strict=True))
        self._of_vertex = defaultdict[int, set[int]](set)
        self._of_edge = defaultdict[Ends, set[int]](set)
        for number, zone in enumerate(roadmap.zones):
            for vertex in zone.vertices:
                self._of_vertex[vertex].add(number)
            for ends in zone.edges:
                self._of_edge[ends].add(number)

    def are_apart(self, lanes: Iterable[Ends], others: Iterable[Ends]) -> bool:
        """Return whether no two robots drive at once along one of some lanes and one of others.

        A lane is its two ends, whichever ways it is driven.
        """
        booked = list(self._list_bookings(others))
        return all(zones & other for zones in self._list_bookings(lanes) for other in booked)

    def _list_bookings(self, lanes: Iterable[Ends]) -> Iterator[set[int]]:
        """Yield the zones that a drive along each edge of some lanes books."""
        for lane in lanes:
            at_ends = set[int]().union(*(self._of_vertex.get(end, ()) for end in lane))
            for ends in {lane, lane[::-1]} & self._edges:
                yield at_ends.union(self._of_edge.get(ends, ()))
