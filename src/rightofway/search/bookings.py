"""Who books which vertex when: the booking table of a set of tracks."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import NamedTuple

from rightofway import _core
from rightofway.model import NEVER, Problem, Tick, Track, edge_ticks

__all__ = ["Booking", "Bookings"]


class Booking(NamedTuple):
    """A vertex is one robot's for ``[start, end)`` [ticks]."""

    start: Tick
    end: Tick
    robot: int


class Bookings:
    """What robots with a track book; no two bookings of a vertex overlap.

    Parameters
    ----------
    problem
        The roads, the robots and the booking rules.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.table = _core.BookingTable(problem.roadmap.n_vertices)
        self._of: defaultdict[int, list[tuple[int, Tick]]] = defaultdict(list)

    def at(self, vertex: int) -> list[Booking]:
        """Return the bookings of a vertex in order of time."""
        return [Booking(Tick(s), Tick(e), robot) for s, e, robot in self.table.at(vertex)]

    def add(self, robot: int, track: Track) -> None:
        """Book all vertices of a track."""
        for vertex, booking in self.of_track(robot, track):
            self.book(vertex, booking)

    def book(self, vertex: int, booking: Booking) -> None:
        """Book one vertex."""
        self.table.book(vertex, *booking)
        self._of[booking.robot].append((vertex, booking.start))

    def release(self, robot: int) -> None:
        """Take back all that a robot has booked."""
        for vertex, start in self._of.pop(robot, ()):
            self.table.erase(vertex, start, robot)

    def of_track(self, robot: int, track: Track) -> Iterator[tuple[int, Booking]]:
        """Yield what a track would book, visit by visit."""
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        for visit, vertex in enumerate(vertices):
            last = visit == len(vertices) - 1
            end = NEVER if last else Tick(enter[visit + 1] + self.problem.headway)
            approach = self._approach(robot, vertices, visit)
            yield vertex, Booking(Tick(enter[visit] - approach), end, robot)

    def _approach(self, robot: int, vertices: list[int], visit: int) -> Tick:
        problem = self.problem
        if visit == 0 or not problem.books_ahead:
            return Tick(0)
        tail, head = vertices[visit - 1 : visit + 1]
        return edge_ticks(problem.roadmap, problem.itineraries[robot], tail, head)

    def in_the_way(self, robot: int, track: Track) -> set[int]:
        """Return the other robots whose bookings a track would overlap."""
        return {
            other.robot
            for vertex, own in self.of_track(robot, track)
            for other in self.at(vertex)
            if other.robot != robot and other.start < own.end and own.start < other.end
        }
