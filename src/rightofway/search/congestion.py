"""Routes that keep clear of the others, chosen one robot at a time.

Waiting cannot pass a robot that stands or works on one's route, and of two robots that come head-on
one waits for the whole segment. So it costs more to enter a place where another robot has its home
or a stop, and to drive against robots whose route is chosen already.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import mean
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.kinds.table import require_index
from rightofway.model import Itinerary, Problem
from rightofway.native import bind_native, find_vertices_near
from rightofway.search.distances import Distances, Path
from rightofway.site import VertexId

SHARES = 16
"""In how many shares a tick is counted, if all robots cost the same."""

STATION = 1 / 8
"""To pass another robot's home or stop costs as much as an eighth of a middling trip more.

The expected wait at another robot's home or stop grows with the length of trips.
"""

ONCOMING = 1 / 4
"""To meet a robot head-on on an edge costs as much as a quarter of it more."""

FINE_SHARES = 1 << 12
"""The same for laps, where the cost depends on the frequency of each robot."""

OFTEN_AT_STATION = 150
"""Ticks that passing a robot costs if that robot is at its place all the time."""

OFTEN_ONCOMING = 34
"""Times the edge that driving against a robot costs if one comes every tick."""


class Congestion:
    """Congestion costs of vertices and edges, given the routes chosen so far.

    Parameters
    ----------
    problem
        The roads, and how fast robots drive.
    distances
        Tables of the roadmap; they guide the search.
    shares
        In how many shares a tick is counted.
    station
        The extra cost of entering each vertex; int64, shape (V,) [shares per tick].
    oncoming
        For each robot the extra cost of driving against it [shares per tick].
    """

    def __init__(
        self,
        problem: Problem,
        distances: Distances,
        *,
        shares: int,
        station: NDArray[np.int64],
        oncoming: Sequence[int],
    ) -> None:
        self.problem = problem
        self.distances = distances
        self._oncoming = oncoming
        self._kernel = _core.Congestion(bind_native(problem), shares, station)

    @classmethod
    def of_trips(cls, problem: Problem, distances: Distances) -> Self:
        """Begin for one trip of each robot: a robot that is in the way once is in the way."""
        robots, station = problem.itineraries, np.zeros(problem.roadmap.n_vertices, np.int64)
        cost = int(
            STATION
            * SHARES
            * mean(_count_edges_of_trip(distances, itinerary) for itinerary in robots)
        )
        for robot, itinerary in enumerate(robots):
            places = [itinerary.home, *(stage.vertex for stage in itinerary.stages)]
            for place in places:
                station[find_vertices_near(problem.resources, robot, place)] = cost
        oncoming = [int(ONCOMING * SHARES)] * len(robots)
        return cls(problem, distances, shares=SHARES, station=station, oncoming=oncoming)

    @classmethod
    def of_laps(cls, problem: Problem, distances: Distances) -> Self:
        """Begin for laps: costs from the frequency of robots, and the shares of laps at stops."""
        station, oncoming = np.zeros(problem.roadmap.n_vertices, np.int64), []
        for itinerary in problem.itineraries:
            lap = max(_count_ticks_of_lap(distances, itinerary), 1)
            for stage in itinerary.stages:
                stays = stage.work + stage.turn + 1
                station[stage.vertex] += OFTEN_AT_STATION * FINE_SHARES * stays // lap
            oncoming.append(OFTEN_ONCOMING * FINE_SHARES // lap)
        return cls(problem, distances, shares=FINE_SHARES, station=station, oncoming=oncoming)

    def find_path(self, robot: int, start: VertexId, target: VertexId) -> Path:
        """Return a cheapest path; the target can be reached.

        Of several cheapest paths, it takes the one that leaves each vertex by the first edge; if no
        robot is in the way, this is the path of `Distances`.
        """
        self.distances.checkpoint()
        require_index("robot", robot, len(self.problem.itineraries))
        to_go = self.distances.to(target, self.problem.itineraries[robot].edge_costs)
        route = self._kernel.path(robot, start, target, to_go)
        return tuple(VertexId(vertex) for vertex in route.tolist())

    def add(self, robot: int, path: Path) -> None:
        """Have a robot on a path."""
        oncoming = self._oncoming[require_index("robot", robot, len(self._oncoming))]
        self._kernel.add(np.array(path, np.int32), oncoming)


def _count_edges_of_trip(distances: Distances, itinerary: Itinerary) -> float:
    """Return about how many edges it is from home to the first stop."""
    ticks = itinerary.edge_ticks
    ticks_to_stop = int(distances.to(itinerary.stages[0].vertex, ticks)[itinerary.home])
    all_ticks = distances.compute_edge_ticks(ticks)
    return ticks_to_stop / float(all_ticks[all_ticks > 0].mean()) if ticks_to_stop else 0.0


def _count_ticks_of_lap(distances: Distances, itinerary: Itinerary) -> int:
    """Return how long a lap takes at least [ticks]."""
    place, ticks = itinerary.home, 0
    for stage in itinerary.stages:
        ticks += int(distances.to(stage.vertex, itinerary.edge_ticks)[place])
        ticks += stage.work + stage.turn
        place = stage.vertex
    return ticks
