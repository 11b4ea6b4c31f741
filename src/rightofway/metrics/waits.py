"""Who waits where, how long and for whom: read from the plan alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rightofway.metrics.bookings import bookings_of
from rightofway.metrics.stays import Stays, stays_of
from rightofway.model import Plan, Scenario, Tick, Track, VertexId

__all__ = ["Wait", "waits", "waits_in"]


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
    return waits_in(plan.scenario, plan.tracks, stays_of(plan.scenario, plan.tracks))


def waits_in(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> tuple[Wait, ...]:
    """Return all waits of tracks that keep the rules, where it is known what their visits are for.

    Parameters
    ----------
    scenario
        The fleet.
    tracks, stays
        One of both for each robot.
    """
    bookings = bookings_of(scenario, tracks, stays)
    places = zip(bookings.vertex.tolist(), bookings.end.tolist(), strict=True)
    frees = dict(zip(places, bookings.robot.tolist(), strict=True))
    books_both = scenario.rules.occupancy == "both"
    found = (
        wait
        for robot, (track, stay) in enumerate(zip(tracks, stays, strict=True))
        for wait in _waits(robot, track, stay, frees, books_both=books_both)
    )
    return tuple(sorted(found, key=lambda wait: (wait.tick, wait.robot)))


def _waits(
    robot: int,
    track: Track,
    stay: Stays,
    frees: Mapping[tuple[int, int], int],
    *,
    books_both: bool,
) -> Iterator[Wait]:
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
