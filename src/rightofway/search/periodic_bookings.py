"""Bookings on a circle as long as the period, and the next robot's way round it."""

from __future__ import annotations

from collections import defaultdict
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Lap, Tick, VertexId
from rightofway.search.round_trip import RoundTrip

__all__ = ["PeriodicBookings"]

_Round = tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]


class PeriodicBookings:
    """Robots that repeat their laps in one period, and where there is room for one more.

    Parameters
    ----------
    n_vertices
        How many vertices the roadmap has.
    period
        After how many ticks everything comes again.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there (``occupancy: both``).
    """

    def __init__(self, n_vertices: int, period: Tick, *, headway: Tick, books_ahead: bool) -> None:
        self.period = period
        self._kernel = _core.PeriodicBookings(n_vertices, int(period), int(headway), books_ahead)
        self._users: defaultdict[int, set[int]] = defaultdict(set)
        self._laps: dict[int, Lap] = {}

    def add(self, robot: int, lap: Lap, count: int, enter: NDArray[np.int64]) -> None:
        """Book the visits of a robot's laps in one period.

        Raises
        ------
        ValueError
            If it is there already, or a booking overlaps another robot's.
        """
        self._kernel.add(robot, *_round(lap, count), enter)
        self._laps[robot] = lap
        for vertex in lap.vertices:
            self._users[vertex].add(robot)

    def remove(self, robot: int) -> None:
        """Take back all that a robot has booked."""
        self._kernel.remove(robot)
        for vertex in self._laps.pop(robot).vertices:
            self._users[vertex].discard(robot)

    def search(
        self, lap: Lap, count: int, phase: int, *, time_limit: float | None = None
    ) -> NDArray[np.int64] | None:
        """Return when a robot can begin each visit of so many laps in one period, or None.

        Notes
        -----
        Complete for this lap, but from a home that nobody else visits: then it stays there until
        the phase, and None says nothing about others.
        """
        enter = self._kernel.search(*_round(lap, count), phase, time_limit)
        return None if enter is None else enter - enter[0] // int(self.period) * int(self.period)

    def find_way(
        self, tour: RoundTrip, phase: int, *, time_limit: float | None = None
    ) -> tuple[Lap, NDArray[np.int64]] | None:
        """Return a way for one lap in a period, and when each visit can begin, or None.

        Notes
        -----
        Complete among all ways, but as `search` from a home that nobody else visits. From this
        phase, no way is home again earlier.
        """
        found = self._kernel.find_way(
            tour.roadmap.indptr,
            tour.roadmap.heads,
            tour.roadmap.length_class,
            tour.pace,
            int(tour.home),
            np.array([stage.vertex for stage in tour.stages], np.int32),
            np.array([stage.work for stage in tour.stages], np.int64),
            np.array([stage.turn for stage in tour.stages], np.int64),
            list(tour.tables),
            phase,
            time_limit,
        )
        if found is None:
            return None
        vertices, dwell, drive, enter = found
        lap = Lap(
            vertices=tuple(map(VertexId, vertices.tolist())),
            dwell=tuple(map(Tick, dwell.tolist())),
            drive=tuple(map(Tick, drive.tolist())),
        )
        return lap, enter - enter[0] // int(self.period) * int(self.period)

    def in_the_way(self, lap: Lap) -> set[int]:
        """Return the robots that visit the place where the last search, for this lap, got stuck."""
        return self._users[lap.vertices[(self._kernel.reached + 1) % len(lap)]]

    def along(self, lap: Lap) -> set[int]:
        """Return the robots that visit any place of a lap."""
        return set().union(*(self._users[vertex] for vertex in lap.vertices))


@lru_cache(maxsize=1 << 14)
def _round(lap: Lap, count: int) -> _Round:
    return (
        np.array(lap.vertices * count, np.int32),
        np.array(lap.dwell * count, np.int64),
        np.array(lap.drive * count, np.int64),
    )
