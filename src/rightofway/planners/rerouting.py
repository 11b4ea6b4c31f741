"""Robots rerouted one at a time, where waiting on fixed routes resolves no deadlock."""

from __future__ import annotations

import random
from collections import Counter, deque
from collections.abc import Iterable
from itertools import accumulate

from rightofway.model import Tick, Track
from rightofway.planners.routing import shortest_route
from rightofway.planners.task import Task, planning_problem
from rightofway.search import Booking, Bookings, Distances, earliest_track

__all__ = ["reroute"]

TRIES_PER_ROBOT = 10
"""How often robots are rerouted at most, per robot of the fleet."""

START_HOLD = 4
"""How long the home of a robot without a track is kept free, in drives of its slowest edge."""


class _Reservations:
    """The tracks of some robots of a fleet, and what these tracks book."""

    def __init__(self, task: Task, distances: Distances, tracks: dict[int, Track]) -> None:
        scenario = task.scenario
        self.task = task
        self.distances = distances
        self.itineraries = scenario.problem.itineraries
        self.tracks = tracks
        self.bookings = Bookings(planning_problem(scenario))
        for robot, track in tracks.items():
            self.bookings.add(robot, track)

    def hold_home(self, robot: int) -> None:
        """Book the home of a robot without a track for a while, so that it can leave."""
        itinerary = self.itineraries[robot]
        booked = self.bookings.at(itinerary.home)
        hold = Tick(START_HOLD * max(itinerary.edge_ticks, default=0))
        end = min([hold, *(booking.start for booking in booked)])
        if end > 0:
            self.bookings.book(itinerary.home, Booking(Tick(0), end, robot))

    def place(self, robot: int) -> bool:
        """Give a robot its earliest track among the others, if there is one."""
        self.bookings.release(robot)
        left = self.task.deadline.seconds_left()
        track = earliest_track(robot, self.bookings, self.distances, time_limit=left)
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

    def blockers(self, robot: int) -> set[int]:
        """Return the robots in the way of this one on its shortest route without waits."""
        itinerary = self.itineraries[robot]
        route = shortest_route(itinerary, self.distances)
        enter = accumulate(map(route.least, range(len(route) - 1)), initial=0)
        track = Track.of(route.vertices, list(enter))
        return self.bookings.in_the_way(robot, track)


def reroute(
    task: Task, distances: Distances, tracks: dict[int, Track], deferred: list[int]
) -> list[int] | None:
    """Add a track among the others to ``tracks`` for each robot without one.

    A robot that finds no way evicts the robots in its way, and these follow it in any order. The
    more often a robot fails, the more others are evicted.

    Returns
    -------
    list of int or None
        All robots whose route was changed, in the order of the fleet; None if that failed in a
        bounded number of tries.

    Raises
    ------
    GaveUp
        When time ran out.
    """
    table = _Reservations(task, distances, tracks)
    waiting, changed = deque(deferred), set(deferred)
    failures: Counter[int] = Counter()
    draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
    for robot in deferred:
        table.hold_home(robot)
    for _ in range(TRIES_PER_ROBOT * len(table.itineraries)):
        if not waiting:
            return sorted(changed)
        task.deadline.check("sending robots another way")
        robot = waiting.popleft()
        if table.place(robot):
            continue
        more = draw.sample(sorted(tracks), min(failures[robot], len(tracks)))
        failures[robot] += 1
        evicted = table.evict(table.blockers(robot).union(more))
        draw.shuffle(evicted)
        changed |= set(evicted)
        waiting.extend(evicted if table.place(robot) else [robot, *evicted])
    return None
