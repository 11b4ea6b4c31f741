"""Rerouting: robots without a track find one among the others, which may have to make way."""

from __future__ import annotations

import random
from collections import Counter, deque
from collections.abc import Iterable

from rightofway.facts import Fact
from rightofway.model import Tick, Track
from rightofway.repair.plan_request import PlanRequest
from rightofway.repair.routing import find_shortest_track
from rightofway.search import Booking, Bookings, Distances, find_earliest_track

REROUTING = Fact("rerouting")

TRIES_PER_ROBOT = 10
"""The largest number of rerouted robots, per robot of the fleet."""

START_HOLD = 4
"""Time for which the home of a robot without a track stays free, in drives of its slowest edge."""


class _Reservations:
    """The tracks of some robots of a fleet, and their bookings."""

    def __init__(
        self, request: PlanRequest, distances: Distances, tracks: dict[int, Track]
    ) -> None:
        scenario = request.scenario
        self.request = request
        self.distances = distances
        self.itineraries = scenario.problem.itineraries
        self.tracks = tracks
        self.bookings = Bookings(scenario.problem)
        for robot, track in tracks.items():
            self.bookings.add(robot, track)

    def hold_home(self, robot: int) -> None:
        """Book the home of a robot without a track for a while, so that it can leave."""
        itinerary = self.itineraries[robot]
        row = self.bookings.get_vertex_row(robot, itinerary.home)
        booked = [booking for booking in self.bookings.list_bookings(row) if booking.robot != robot]
        hold = Tick(START_HOLD * max(itinerary.edge_ticks, default=0))
        end = min([hold, *(booking.start for booking in booked)])
        if end > 0:
            self.bookings.book(row, Booking(Tick(0), end, robot))

    def place(self, robot: int) -> bool:
        """Give a robot its earliest track among the others, if there is one."""
        self.bookings.release(robot)
        left = self.request.deadline.measure_seconds_left()
        track = find_earliest_track(robot, self.bookings, self.distances, time_limit=left)
        if track is None:
            self.hold_home(robot)
            return False
        self.tracks[robot] = track
        self.bookings.add(robot, track)
        return True

    def evict(self, robots: Iterable[int]) -> list[int]:
        """Remove the tracks of some robots; return those that had one."""
        evicted = sorted(robot for robot in robots if self.tracks.pop(robot, None) is not None)
        for robot in evicted:
            self.bookings.release(robot)
            self.hold_home(robot)
        return evicted

    def find_blockers(self, robot: int) -> set[int]:
        """Return the robots in the way of this one on its shortest route without waits.

        With closures: on its best track among them.
        """
        itinerary = self.itineraries[robot]
        track = None
        if self.bookings.problem.closures is not None:
            alone = Bookings(self.bookings.problem)
            track = find_earliest_track(robot, alone, self.distances)
        if track is None:
            track = find_shortest_track(self.bookings.problem.roadmap, itinerary, self.distances)
        return self.bookings.find_blockers(robot, track)


def reroute(
    request: PlanRequest, distances: Distances, tracks: dict[int, Track], deferred: list[int]
) -> dict[int, int | None] | None:
    """Add a track among the others to ``tracks`` for each robot without one.

    A robot that finds no way evicts the robots in its way, and these follow it in any order. The
    more often a robot fails, the more others are evicted.

    Returns
    -------
    dict or None
        All robots that were planned again, and the robot that each had to make way for first, None
        for the deferred ones; None if that failed in a bounded number of tries.

    Raises
    ------
    GaveUp
        When time ran out.
    """
    table = _Reservations(request, distances, tracks)
    waiting, made_way = deque(deferred), dict[int, int | None].fromkeys(deferred)
    failures: Counter[int] = Counter()
    draw = random.Random(request.seed)  # noqa: S311 (no secret depends on it)
    for robot in deferred:
        table.hold_home(robot)
    for _ in range(TRIES_PER_ROBOT * len(table.itineraries)):
        if not waiting:
            return made_way
        request.deadline.check(REROUTING)
        robot = waiting.popleft()
        if table.place(robot):
            continue
        more = draw.sample(sorted(tracks), min(failures[robot], len(tracks)))
        failures[robot] += 1
        evicted = table.evict(table.find_blockers(robot).union(more))
        draw.shuffle(evicted)
        made_way = dict.fromkeys(evicted, robot) | made_way
        waiting.extend(evicted if table.place(robot) else [robot, *evicted])
    return None
