"""The waits of a plan, read from its tracks alone: robot, place, ticks, robot waited for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.metrics.collisions import Bookings, bookings_of
from rightofway.model import Plan, Scenario, Stays, Tick, Track, Wait, stays_of
from rightofway.model.given import checked_plan
from rightofway.model.resources import Resources
from rightofway.site import Roadmap, VertexId

Visits = NDArray[np.int64]
"""Numbers of visits, counted robot by robot along the tracks."""

NOBODY = -1
"""Stands for the visit of no robot."""


def waits(plan: Plan) -> tuple[Wait, ...]:
    """Return all waits of a plan that keeps the rules, by tick, then by robot.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    """
    scenario, tracks = checked_plan(plan).scenario, plan.tracks
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
    frees = freed_by(scenario, tracks, stays)
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


def freed_by(scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]) -> Visits:
    """Return, for each visit, which visit of another robot ends its booking as this one begins.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    stays
        The parts of their visits.

    Returns
    -------
    ndarray
        Numbers of visits, counted robot by robot along the tracks, or `NOBODY`; int64, shape (n,).
        Visits that a robot with a size elsewhere makes possible have them only as far as a wait is
        explained: from each wait on up to the next visit that has one.
    """
    problem, bookings = scenario.problem, bookings_of(scenario, tracks, stays)
    # Where rotations are forbidden, planners keep one tick between two bookings of a vertex.
    gap = 0 if problem.rotations or problem.headway else 1
    before, after = slice(-1), slice(1, None)
    frees = np.full(len(bookings.robot), NOBODY)
    ends_as_begins = (
        (bookings.vertex[before] == bookings.vertex[after])
        & np.isin(bookings.start[after] - bookings.end[before], (0, gap))
        & (bookings.robot[before] != bookings.robot[after])
    )
    frees[bookings.visit[after][ends_as_begins]] = bookings.visit[before][ends_as_begins]
    resources = problem.resources
    if resources is not None:
        waiting = np.flatnonzero(np.concatenate([stay.waits for stay in stays]) > 0)
        _add_places_apart(scenario.roadmap, resources, bookings, waiting, frees)
    return frees


def _add_places_apart(
    roadmap: Roadmap, resources: Resources, bookings: Bookings, waiting: Visits, frees: Visits
) -> None:
    """Add the visits of robots that were too near, at another vertex or on an edge."""
    order = np.argsort(bookings.visit)
    robot, vertex = bookings.robot[order], bookings.vertex[order]
    start, end = bookings.start[order], bookings.end[order]
    base = resources.size_of[robot] * (resources.n_vertices + resources.n_edges)
    at_vertex = base + vertex
    edge = np.append(roadmap.edges(vertex[:-1], vertex[1:]), -1)
    on_edge = np.where(edge < 0, at_vertex, base + resources.n_vertices + edge)
    by_end = np.argsort(end, kind="stable")
    sorted_ends = end[by_end]
    explained: set[int] = set()
    for wait in waiting[::-1].tolist():
        visit = wait + 1
        while visit < len(robot) and robot[visit] == robot[wait] and visit not in explained:
            explained.add(visit)
            if frees[visit] != NOBODY:
                break
            first, last = np.searchsorted(sorted_ends, (start[visit], start[visit] + 1))
            ended = by_end[first:last]
            ended = ended[robot[ended] != robot[wait]]
            rows = (int(at_vertex[visit]), int(on_edge[visit - 1]))
            excluded = np.concatenate([resources.excluded_by(row) for row in rows])
            near = np.isin(at_vertex[ended], excluded) | np.isin(on_edge[ended], excluded)
            if near.any():
                frees[visit] = ended[near][0]
                break
            visit += 1
