"""Who books which vertex when: the booking table of a set of tracks."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from rightofway.model import Itinerary, Roadmap, Tick, Track

__all__ = ["FOREVER", "Booking", "Bookings"]

FOREVER = Tick(2**62)
"""The end of a booking that never ends."""


class Booking(NamedTuple):
    """A vertex is one robot's for ``[start, end)`` [ticks]."""

    start: Tick
    end: Tick
    robot: int


@dataclass(slots=True)
class Bookings:
    """What robots with a track book, by vertex and in order of time.

    Parameters
    ----------
    roadmap
        The graph that robots drive on.
    headway
        Ticks that a vertex stays booked after it was left.
    books_ahead
        Whether a robot books a vertex from when it starts to drive there (``occupancy: both``).
    """

    roadmap: Roadmap
    headway: Tick
    books_ahead: bool
    _at: dict[int, list[Booking]] = field(default_factory=dict)
    _of: dict[int, list[tuple[int, Booking]]] = field(default_factory=dict)

    def at(self, vertex: int) -> list[Booking]:
        """Return the bookings of a vertex in order of time; they do not overlap."""
        return self._at.get(vertex, [])

    def add(self, robot: int, track: Track, itinerary: Itinerary) -> None:
        """Book all vertices of a track."""
        for vertex, booking in self.of_track(robot, track, itinerary):
            self.book(vertex, booking)

    def book(self, vertex: int, booking: Booking) -> None:
        """Book one vertex."""
        insort(self._at.setdefault(vertex, []), booking)
        self._of.setdefault(booking.robot, []).append((vertex, booking))

    def remove(self, robot: int) -> None:
        """Give back all that a robot has booked."""
        for vertex, booking in self._of.pop(robot, ()):
            here = self._at[vertex]
            del here[bisect_left(here, booking)]

    def of_track(
        self, robot: int, track: Track, itinerary: Itinerary
    ) -> Iterator[tuple[int, Booking]]:
        """Yield what a track would book, visit by visit."""
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        for visit, vertex in enumerate(vertices):
            last = visit == len(vertices) - 1
            end = FOREVER if last else Tick(enter[visit + 1] + self.headway)
            approach = self._approach(vertices, visit, itinerary)
            yield vertex, Booking(Tick(enter[visit] - approach), end, robot)

    def _approach(self, vertices: list[int], visit: int, itinerary: Itinerary) -> Tick:
        if visit == 0 or not self.books_ahead:
            return Tick(0)
        edge = self.roadmap.edge(vertices[visit - 1], vertices[visit])
        assert edge is not None, "a track follows edges"
        return itinerary.edge_ticks[self.roadmap.length_class[edge]]

    def in_the_way(self, robot: int, track: Track, itinerary: Itinerary) -> set[int]:
        """Return the other robots whose bookings a track would overlap."""
        return {
            other.robot
            for vertex, own in self.of_track(robot, track, itinerary)
            for other in self.at(vertex)
            if other.robot != robot and other.start < own.end and own.start < other.end
        }
