"""Safe interval path planning: the earliest track of one robot among the bookings of the others.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rightofway import _core
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.kinds.table import require_index
from rightofway.model import NEVER, Problem, Tick, Track, compute_drives_along
from rightofway.native import ANYWHERE, bind_native, list_excluded, list_native_stages
from rightofway.search.distances import Distances

STOPPED = 2

NOBODY = -1
"""The robot that books what is closed."""


class Booking(NamedTuple):
    """A booking of a vertex by a robot for ``[start, end)`` [ticks]."""

    start: Tick
    end: Tick
    robot: int


class Bookings:
    """Bookings of robots with a track, and closures; no two bookings of a vertex overlap.

    Robots with a size book rows of `Resources`, a vertex or an edge; a booking marks all rows from
    which it excludes other robots.

    Parameters
    ----------
    problem
        The roads, the robots and the booking rules.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.resources = problem.resources
        self._n_vertices, closed = problem.roadmap.n_vertices, problem.closures
        self._books_edges = closed is not None and closed.close_edges
        n_rows = self._n_vertices + self._books_edges * problem.roadmap.n_edges
        if not self.resources.are_points:
            n_rows = self.resources.n_rows
            self._books_edges = True
        self.table = _core.BookingTable(n_rows)
        # Bookings of robots with a size may overlap in a row from which both exclude others.
        self._put = self.table.book if self.resources.are_points else self.table.mark
        if closed is not None:
            arrays = (closed.row, closed.start, closed.end)
            for row, start, end in zip(*(array.tolist() for array in arrays), strict=True):
                self.table.mark(row, start, end, NOBODY)
        self._of: defaultdict[int, list[tuple[int, Tick]]] = defaultdict(list)

    def list_bookings(self, row: int) -> list[Booking]:
        """Return the bookings of a vertex in order of time; with sizes, the marks of a row."""
        return [Booking(Tick(s), Tick(e), robot) for s, e, robot in self.table.at(row)]

    def get_vertex_row(self, robot: int, vertex: int) -> int:
        """Return the row that a robot books at a vertex; for points the vertex itself."""
        return self.resources.get_vertex_row(robot, vertex)

    def add(self, robot: int, track: Track) -> None:
        """Book all vertices of a track."""
        require_index("robot", robot, len(self.problem.itineraries))
        for row, booking in self.make_bookings(robot, track):
            self.book(row, booking)

    def book(self, row: int, booking: Booking) -> None:
        """Book one vertex, or mark the rows that one row excludes."""
        for mark in list_excluded(self.resources, row):
            self._put(mark, *booking)
            self._of[booking.robot].append((mark, booking.start))

    def release(self, robot: int) -> None:
        """Take back all that a robot has booked."""
        for row, start in self._of.pop(robot, ()):
            self.table.erase(row, start, robot)

    def make_bookings(self, robot: int, track: Track) -> Iterator[tuple[int, Booking]]:
        """Yield the bookings of a track, visit by visit."""
        problem, rules, enter = self.problem, self.problem.booking_rules, track.enter
        vertices, first_row = track.vertices.tolist(), self.get_vertex_row(robot, 0)
        drives = compute_drives_along(problem.roadmap, problem.itineraries[robot], vertices)
        drives_in = np.array([0, *drives], np.int64)
        starts, ends = rules.start(enter, drives_in).tolist(), rules.end(enter[1:]).tolist()
        for vertex, start, end in zip(vertices, starts, [*ends, NEVER], strict=True):
            yield first_row + vertex, Booking(start, end, robot)
        if not self._books_edges:
            return
        edges = problem.roadmap.find_edges(track.vertices[:-1], track.vertices[1:]).tolist()
        begins = (enter - drives_in)[1:].tolist()
        for edge, start, end in zip(edges, begins, ends, strict=True):
            yield first_row + self._n_vertices + edge, Booking(start, end, robot)

    def find_blockers(self, robot: int, track: Track) -> set[int]:
        """Return the other robots whose bookings a track would overlap."""
        return {
            other.robot
            for row, own in self.make_bookings(robot, track)
            for other in self.list_bookings(row)
            if other.robot not in {robot, NOBODY}
            and other.start < own.end
            and own.start < other.end
        }


def find_earliest_track(
    robot: int,
    bookings: Bookings,
    distances: Distances,
    *,
    time_limit: float | None = None,
) -> Track | None:
    """Find the track of one robot that overlaps no booking and completes first, surcharges added.

    Parameters
    ----------
    robot
        Which robot; it can reach every stage.
    bookings
        The bookings of the other robots.
    distances
        Tables for the lower bounds that guide the search.
    time_limit
        When to stop [s].

    Returns
    -------
    Track or None
        None if it is proven that there is no such track.

    Raises
    ------
    GaveUp
        If time ran out.
    InputError
        For an unknown robot, or distances of another roadmap.

    Notes
    -----
    Complete and optimal for one robot among fixed bookings, and deterministic.
    """
    problem = bookings.problem
    if distances.roadmap is not problem.roadmap and distances.roadmap != problem.roadmap:
        raise InputError.at("distances", "are of another roadmap than the bookings")
    itinerary = problem.itineraries[require_index("robot", robot, len(problem.itineraries))]
    tables = [
        distances.to(stage.vertex, itinerary.edge_ticks)
        if stage.vertex != ANYWHERE
        else np.zeros(problem.roadmap.n_vertices, np.int32)
        for stage in list_native_stages(itinerary)
    ]
    end, vertices, enter = _core.earliest_track(
        bind_native(problem), robot, bookings.table, tables, time_limit
    )
    if end == STOPPED:
        raise GaveUp(Fact("time over for one robot"))
    return Track(vertices=vertices, enter=enter) if len(vertices) else None
