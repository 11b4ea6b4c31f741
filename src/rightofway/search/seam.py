"""Bookings around the seam of a circle, and how a robot gets through it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Lap, Tick, VertexId

__all__ = ["Seam"]

_Visits = tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]


class Seam:
    """Robots around the seam of a circle, on a line of time.

    Parameters
    ----------
    n_vertices
        How many vertices the roadmap has.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there (``occupancy: both``).
    """

    def __init__(self, n_vertices: int, *, headway: Tick, books_ahead: bool) -> None:
        self._kernel = _core.Seam(n_vertices, int(headway), books_ahead)

    def add(
        self, robot: int, lap: Lap, visits: range, enter: NDArray[np.int64], leave: int
    ) -> None:
        """Book some visits of a robot, numbered from its first lap on; the last ends at `leave`."""
        place = np.arange(visits.start, visits.stop) % len(lap)
        vertex, dwell, drive = _arrays(lap)
        begins = np.ascontiguousarray(enter)
        self._kernel.add(robot, vertex[place], dwell[place], drive[place], begins, int(leave))

    def remove(self, robot: int, lap: Lap) -> None:
        """Take back all that a robot has booked."""
        self._kernel.remove(robot, _arrays(lap)[0])

    def connect(
        self, lap: Lap, count: int, begins: int, until: int, leave: int
    ) -> NDArray[np.int64] | None:
        """Return when the visits of so many laps can begin, the visit home after them included.

        Parameters
        ----------
        lap, count
            What to do.
        begins
            When the robot comes home before that [ticks].
        until, leave
            By when it has to be home again, and until when it stays there then [ticks].
        """
        return self._kernel.connect(*_laps(lap, count), int(begins), int(until), int(leave))

    def stuck(self, lap: Lap, begins: int, until: int) -> tuple[VertexId, set[int]]:
        """Return the place where the last search, for this lap, got stuck, and who uses it."""
        vertex = lap.vertices[(self._kernel.reached + 1) % len(lap)]
        return vertex, set(self._kernel.users(vertex, int(begins), int(until)).tolist())


@lru_cache(maxsize=1 << 14)
def _arrays(lap: Lap) -> _Visits:
    return (
        np.array(lap.vertices, np.int32),
        np.array(lap.dwell, np.int64),
        np.array(lap.drive, np.int64),
    )


@lru_cache(maxsize=1 << 14)
def _laps(lap: Lap, count: int) -> _Visits:
    """Return so many laps and the visit home after them."""
    vertex, dwell, drive = _arrays(lap)
    place = np.append(np.arange(len(lap) * count) % len(lap), 0)
    return vertex[place], dwell[place], drive[place]
