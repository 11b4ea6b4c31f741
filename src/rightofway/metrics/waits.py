"""Who waits where, how long and for whom: read from the plan alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from rightofway.metrics.bookings import bookings_of
from rightofway.metrics.stays import Stays, stays_of
from rightofway.model import Plan, Tick, VertexId

__all__ = ["Wait", "waits"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Wait:
    """A robot stands still with nothing to do.

    Attributes
    ----------
    robot
        Who, by index.
    vertex
        Where.
    tick
        When it begins: the robot has worked and turned, and might drive on [ticks].
    ticks
        How long it lasts [ticks].
    towards
        The vertex where the robot goes next.
    for_robot
        The robot that frees that vertex at the very tick from which this one books it: this one
        waits for it. None if nobody does: then it waits for what comes later on its way.
    """

    robot: int
    vertex: VertexId
    tick: Tick
    ticks: Tick
    towards: VertexId
    for_robot: int | None


def waits(plan: Plan) -> tuple[Wait, ...]:
    """Return all waits of a plan that keeps the rules, by tick, then by robot."""
    scenario, tracks = plan.scenario, plan.tracks
    stays = stays_of(scenario, tracks)
    bookings = bookings_of(scenario, tracks, stays)
    places = zip(bookings.vertex.tolist(), bookings.end.tolist(), strict=True)
    frees = dict(zip(places, bookings.robot.tolist(), strict=True))
    found = (
        wait for robot in range(len(tracks)) for wait in _waits(plan, robot, stays[robot], frees)
    )
    return tuple(sorted(found, key=lambda wait: (wait.tick, wait.robot)))


def _waits(
    plan: Plan, robot: int, stay: Stays, frees: Mapping[tuple[int, int], int]
) -> Iterator[Wait]:
    track = plan.tracks[robot]
    books_both = plan.scenario.rules.occupancy == "both"
    for visit in np.flatnonzero(stay.waits > 0).tolist():
        vertex, towards = map(VertexId, track.vertices[visit : visit + 2].tolist())
        approach = stay.drive[visit] if books_both else 0
        freed_by = frees.get((towards, int(track.enter[visit + 1] - approach)))
        yield Wait(
            robot=robot,
            vertex=vertex,
            tick=Tick(int(track.enter[visit] + stay.dwell[visit])),
            ticks=Tick(int(stay.waits[visit])),
            towards=towards,
            for_robot=None if freed_by == robot else freed_by,
        )
