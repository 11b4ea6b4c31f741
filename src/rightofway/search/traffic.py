"""Routes that keep clear of the others, chosen one robot at a time.

Waiting cannot pass a robot that stands or works on one's route, and of two robots that come head-on
one waits for the whole segment. So it costs more to enter a place where another robot has its home
or a stop, and to drive against robots whose route is chosen already.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import mean

import numpy as np

from rightofway import _core
from rightofway.model import Itinerary, Tick, VertexId
from rightofway.search.distances import Distances, Path

__all__ = ["Traffic"]

STATION = _core.Traffic.SHARES // 8
"""To pass another robot's home or stop costs as much as an eighth of a middling trip more.

Who has to wait for a robot to come or go waits the longer, the longer their trips are.
"""

ONCOMING = _core.Traffic.SHARES // 4
"""To meet a robot head-on on an edge costs as much as a quarter of it more."""


class Traffic:
    """The routes chosen so far, and what they make others cost.

    Parameters
    ----------
    distances
        Tables of the roadmap; they guide the search.
    itineraries
        Of all robots; their homes and stops are what to keep clear of.
    """

    def __init__(self, distances: Distances, itineraries: Sequence[Itinerary]) -> None:
        self.distances = distances
        is_station = np.zeros(distances.roadmap.n_vertices, np.uint8)
        for itinerary in itineraries:
            is_station[[itinerary.home, *(stage.vertex for stage in itinerary.stages)]] = 1
        self._kernel = _core.Traffic(
            distances.roadmap.indptr,
            distances.roadmap.heads,
            is_station,
            int(STATION * mean(_edges_of_trip(distances, one) for one in itineraries)),
            ONCOMING,
        )

    def path(self, start: VertexId, target: VertexId, edge_ticks: tuple[Tick, ...]) -> Path:
        """Return a cheapest path; the target can be reached.

        Of several, it takes the one that leaves each vertex by the first edge; where nobody is in
        the way that is the path of `Distances`.
        """
        to_go = self.distances.to(target, edge_ticks)
        ticks = self.distances.ticks_of_edges(edge_ticks)
        found = self._kernel.path(start, target, ticks, to_go)
        return tuple(VertexId(vertex) for vertex in found.tolist())

    def add(self, path: Path) -> None:
        """Have one more robot on a path."""
        self._kernel.add(np.array(path, np.int32))


def _edges_of_trip(distances: Distances, itinerary: Itinerary) -> float:
    """Return about how many edges it is from home to the first stop."""
    ticks = itinerary.edge_ticks
    way = int(distances.to(itinerary.stages[0].vertex, ticks)[itinerary.home])
    return way / float(distances.ticks_of_edges(ticks).mean()) if way else 0.0
