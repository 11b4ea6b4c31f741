"""The waits of a plan, read from its tracks alone: robot, place, ticks, robot waited for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.metrics.collisions import Bookings, bookings_of
from rightofway.model import Plan, Scenario, Stays, Tick, Track, VertexId, Wait, stays_of

NOBODY = -1
"""Stands for the visit of no robot."""


def waits(plan: Plan) -> tuple[Wait, ...]:
    """Return all waits of a plan that keeps the rules, by tick, then by robot.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    """
    scenario, tracks = plan.scenario, plan.tracks
    return plan.once("waits", lambda: waits_in(scenario, tracks, stays_of(scenario, tracks)))


def waits_in(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> tuple[Wait, ...]:
    """Return all waits of tracks that keep the rules, given the parts of their visits."""
    lengths = [len(track) for track in tracks]
    waiting = np.concatenate([stay.waits for stay in stays])
    enter = np.concatenate([track.enter for track in tracks])
    vertex = np.concatenate([track.vertices for track in tracks])
    begin = enter + np.concatenate([stay.dwell for stay in stays])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    frees = freed_by(bookings_of(scenario, tracks, stays))
    visit = np.flatnonzero(waiting > 0)
    visit = visit[np.lexsort((robot[visit], begin[visit]))]
    columns = (
        robot[visit],
        vertex[visit],
        begin[visit],
        waiting[visit],
        vertex[visit + 1],
        np.where(frees == NOBODY, NOBODY, robot[frees])[visit + 1],
    )
    return tuple(
        Wait(
            robot=robot,
            vertex=VertexId(vertex),
            tick=Tick(tick),
            ticks=Tick(ticks),
            towards=VertexId(towards),
            for_robot=None if for_robot == NOBODY else for_robot,
        )
        for robot, vertex, tick, ticks, towards, for_robot in zip(
            *(column.tolist() for column in columns), strict=True
        )
    )


def freed_by(bookings: Bookings) -> NDArray[np.int64]:
    """Return, for each visit, which visit of another robot ends its booking as this one begins.

    Parameters
    ----------
    bookings
        All bookings of a fleet.

    Returns
    -------
    ndarray
        Numbers of visits, counted robot by robot along the tracks, or `NOBODY`; int64, shape (n,).
    """
    before, after = slice(-1), slice(1, None)
    frees = np.full(len(bookings.robot), NOBODY)
    ends_as_begins = (
        (bookings.vertex[before] == bookings.vertex[after])
        & (bookings.end[before] == bookings.start[after])
        & (bookings.robot[before] != bookings.robot[after])
    )
    frees[bookings.visit[after][ends_as_begins]] = bookings.visit[before][ends_as_begins]
    return frees
