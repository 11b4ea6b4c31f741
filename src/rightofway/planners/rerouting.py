"""Sending robots another way, one at a time, where waiting on fixed routes opens no deadlock."""

from __future__ import annotations

import random
from collections import Counter, deque
from collections.abc import Iterable

from rightofway.model import Tick, Track
from rightofway.planners.routing import shortest_route
from rightofway.planners.task import Task, planning_headway
from rightofway.search import Booking, Bookings, Distances, earliest_track

__all__ = ["reroute"]

TRIES_PER_ROBOT = 10
"""How often robots may be sent another way, per robot of the fleet."""

START_HOLD = 4
"""For how many of its slowest edges the home of a robot without a track is kept free."""


class _Floor:
    """Who has a track, what is booked, and who still waits for a track."""

    def __init__(self, task: Task, distances: Distances, tracks: dict[int, Track]) -> None:
        scenario = task.scenario
        self.task = task
        self.distances = distances
        self.itineraries = scenario.problem.itineraries
        self.tracks = tracks
        self.bookings = Bookings(
            scenario.roadmap,
            headway=planning_headway(scenario),
            books_ahead=scenario.rules.books_ahead,
        )
        for robot, track in tracks.items():
            self.bookings.add(robot, track, self.itineraries[robot])

    def hold_home(self, robot: int) -> None:
        """Keep the home of a robot without a track free for a while, so that it can leave."""
        itinerary = self.itineraries[robot]
        booked = self.bookings.at(itinerary.home)
        hold = Tick(START_HOLD * max(itinerary.edge_ticks, default=0))
        end = min([hold, *(booking.start for booking in booked)])
        if end > 0:
            self.bookings.book(itinerary.home, Booking(Tick(0), end, robot))

    def place(self, robot: int) -> bool:
        """Give a robot its earliest track among the others, if there is one."""
        self.bookings.release(robot)
        itinerary = self.itineraries[robot]
        left = self.task.deadline.seconds_left()
        track = earliest_track(itinerary, self.bookings, self.distances, time_limit=left)
        if track is None:
            self.hold_home(robot)
            return False
        self.tracks[robot] = track
        self.bookings.add(robot, track, itinerary)
        return True

    def evict(self, robots: Iterable[int]) -> list[int]:
        """Take back the tracks of some robots; they need new ones."""
        evicted = sorted(robot for robot in robots if self.tracks.pop(robot, None) is not None)
        for robot in evicted:
            self.bookings.release(robot)
            self.hold_home(robot)
        return evicted

    def blockers(self, robot: int) -> set[int]:
        """Return the robots in the way of this one on its shortest route without waits."""
        itinerary = self.itineraries[robot]
        route = shortest_route(itinerary, self.distances)
        enter = [0]
        for visit in range(len(route) - 1):
            enter.append(enter[-1] + route.least(visit))
        track = Track.of(route.vertices, enter)
        return self.bookings.in_the_way(robot, track, itinerary)


def reroute(
    task: Task, distances: Distances, tracks: dict[int, Track], aside: list[int]
) -> list[int] | None:
    """Give robots without a track one among the others; add them to ``tracks``.

    A robot that finds no way takes back the tracks of those in its way, and they follow it in any
    order. The more often it fails, the more others make room.

    Returns
    -------
    list of int or None
        All robots whose way was changed, in the order of the fleet; None if that did not work out
        in a bounded number of tries.

    Raises
    ------
    GaveUp
        When time ran out.
    """
    floor = _Floor(task, distances, tracks)
    waiting, changed = deque(aside), set(aside)
    failures: Counter[int] = Counter()
    draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
    for robot in aside:
        floor.hold_home(robot)
    for _ in range(TRIES_PER_ROBOT * len(floor.itineraries)):
        if not waiting:
            return sorted(changed)
        task.deadline.check("sending robots another way")
        robot = waiting.popleft()
        if floor.place(robot):
            continue
        more = draw.sample(sorted(tracks), min(failures[robot], len(tracks)))
        failures[robot] += 1
        evicted = floor.evict(floor.blockers(robot).union(more))
        draw.shuffle(evicted)
        changed |= set(evicted)
        waiting.extend(evicted if floor.place(robot) else [robot, *evicted])
    return None
