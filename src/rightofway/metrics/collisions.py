"""What would happen if nobody waited: the paper's planned rows, and where they collide."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from rightofway.metrics.bookings import Bookings, bookings_of
from rightofway.model import NEVER, Plan, Scenario, Tick, Track, VertexId, stays_of

__all__ = ["Collision", "collisions", "free_running"]


def free_running(plan: Plan) -> tuple[Track, ...]:
    """Return tracks of the same routes and work, without any wait."""
    return tuple(
        Track(
            vertices=track.vertices,
            enter=np.append(0, np.cumsum((stay.dwell + stay.drive)[:-1])),
        )
        for track, stay in zip(plan.tracks, stays_of(plan.scenario, plan.tracks), strict=True)
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Collision:
    """Two robots book one vertex at the same time.

    Attributes
    ----------
    robots
        The two, by index, the smaller first.
    vertex
        Where.
    start, end
        From when to when [ticks]; an end of None is never.
    """

    robots: tuple[int, int]
    vertex: VertexId
    start: Tick
    end: Tick | None


def collisions(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Collision, ...]:
    """Return where bookings of any tracks overlap, by start, then by robots.

    Notes
    -----
    The paper's list counts the ticks of these intervals one by one.
    """
    bookings = bookings_of(scenario, tracks, stays_of(scenario, tracks))
    found = _overlaps(bookings)
    return tuple(sorted(found, key=lambda each: (each.start, each.robots, each.vertex)))


def _overlaps(bookings: Bookings) -> Iterator[Collision]:
    """Go through the bookings, vertex by vertex, with those that have not ended yet."""
    going_on: list[tuple[int, int, int]] = []
    columns = (bookings.vertex, bookings.start, bookings.end, bookings.robot)
    for vertex, start, end, robot in zip(*(column.tolist() for column in columns), strict=True):
        going_on = [one for one in going_on if one[0] == vertex and one[1] > start]
        for _, until, other in going_on:
            if other != robot:
                yield _collision((robot, other), vertex, start, min(end, until))
        going_on.append((vertex, end, robot))


def _collision(robots: tuple[int, int], vertex: int, start: int, end: int) -> Collision:
    return Collision(
        robots=(min(robots), max(robots)),
        vertex=VertexId(vertex),
        start=Tick(start),
        end=None if end == NEVER else Tick(end),
    )
