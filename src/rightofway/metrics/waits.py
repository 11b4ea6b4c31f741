"""The waits of a plan: robot, place, ticks, and the robot whose right of way they are due to."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.kinds.arguments import checks_arguments
from rightofway.model import Plan, Route, Scenario, Stays, Tick, Track, Wait
from rightofway.native import BookedRows, book_times
from rightofway.precedence import PrecedenceGraph, order_of
from rightofway.precedence.graph import Pairs
from rightofway.site import VertexId

Visits = NDArray[np.int64]
"""Numbers of visits, counted robot by robot along the tracks."""

NOBODY = -1
"""Stands for the visit of no robot."""


@checks_arguments
def waits(plan: Plan) -> tuple[Wait, ...]:
    """Return all waits of a plan that keeps the rules, by tick, then by robot.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    """
    scenario, tracks = plan.scenario, plan.tracks
    return plan.compute_once("waits", lambda: waits_in(scenario, tracks, plan.stays))


def waits_in(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> tuple[Wait, ...]:
    """Return all waits of tracks that keep the rules, given the parts of their visits."""
    lengths = [len(track) for track in tracks]
    waiting = np.concatenate([drop_holds(stay) for stay in stays])
    enter = np.concatenate([track.enter for track in tracks])
    vertex = np.concatenate([track.vertices for track in tracks])
    begin = enter + np.concatenate([stay.dwell for stay in stays])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    frees = find_freeing_visits(scenario, tracks, stays)
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
    for_places = [
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
    ]
    holds = [
        Wait(
            robot=robot,
            vertex=(place := VertexId(int(track.vertices[hold.visit]))),
            tick=hold.tick,
            ticks=hold.ticks,
            towards=place,
            for_robot=hold.for_robot,
        )
        for robot, (track, stay) in enumerate(zip(tracks, stays, strict=True))
        for hold in stay.holds
    ]
    return tuple(sorted([*for_places, *holds], key=lambda wait: (wait.tick, wait.robot)))


def drop_holds(stay: Stays) -> NDArray[np.int64]:
    """Return the waits of each visit of a robot without those for jobs of others; int64."""
    waiting = stay.waits.copy()
    for hold in stay.holds:
        waiting[hold.visit] -= hold.ticks
    return waiting


def find_freeing_visits(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> Visits:
    """Return, for each visit, the visit of another robot whose right of way binds it.

    A right of way binds where the second visit begins to book as soon as the first one, and the
    headway, is over: were the first one later, the second one would be.

    Returns
    -------
    ndarray
        Numbers of visits, counted robot by robot along the tracks, or `NOBODY`; int64, shape (n,).
    """
    rules, (start, end) = (
        scenario.problem.booking_rules,
        book_times(scenario.problem, tracks, np.concatenate([stay.drive for stay in stays])),
    )
    robot = np.repeat(np.arange(len(tracks)), [len(track) for track in tracks])
    first, second = list_rights_of_way(scenario, tracks, stays).T
    # Laps in which robots would rotate keep one tick between two bookings of a vertex.
    gap = rules.keep_apart().end(0) - rules.end(0)
    binds = np.isin(start[second] - end[first], (0, gap)) & (robot[first] != robot[second])
    frees = np.full(len(start), NOBODY)
    frees[second[binds][::-1]] = first[binds][::-1]  # of several, the first in order
    return frees


def list_rights_of_way(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> Pairs:
    """Return which visit goes before which, as the tracks have it, by the second visit.

    Returns
    -------
    ndarray
        Pairs (first, second) of visits; int32, shape (m, 2). None for robots with a size whose
        tracks break the rules, so that no order explains them.
    """
    vertices = [track.vertices for track in tracks]
    rows = BookedRows.of(scenario.problem, vertices)
    if rows is None:
        enter = np.concatenate([track.enter for track in tracks])
        return order_of(np.concatenate(vertices), enter)
    routes = [
        Route(
            vertices=tuple(map(VertexId, track.vertices.tolist())),
            dwell=tuple(map(Tick, stay.dwell.tolist())),
            drive=tuple(map(Tick, [0, *stay.drive[:-1].tolist()])),
        )
        for track, stay in zip(tracks, stays, strict=True)
    ]
    may_last = all((np.diff(track.enter) > 0).all() for track in tracks)
    graph = PrecedenceGraph(routes, rules=scenario.problem.booking_rules, rows=rows)
    if not may_last or not graph.keeps_order([track.enter for track in tracks]):
        return np.empty((0, 2), np.int32)
    rights = graph.list_rights()
    return rights[np.lexsort((rights[:, 0], rights[:, 1]))]
