"""Parts of completion times: alone + detours + making room + waiting = completion.

Waits have a cause: the next visit on the route that a right of way binds, which begins as soon as
the visit of another robot that goes first is over. Were the wait shorter, the robot would wait
there. Waits that
follow each other behind one robot, along vertices that both visit in the same order, are joined.

Drives that make room are those that a last-exit decomposition of the route cuts out: between two
stops, from each vertex on, everything up to the robot's last visit of that vertex.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import require_one_for_each
from rightofway.metrics.collisions import BookedPlaces, list_bookings
from rightofway.metrics.measure import measure
from rightofway.metrics.waits import NOBODY, drop_holds, find_freeing_visits
from rightofway.model import (
    Itinerary,
    Loss,
    LostTime,
    Plan,
    Scenario,
    Stays,
    Tick,
    Track,
    compute_least_dwell,
)
from rightofway.model.turning import Turning
from rightofway.site import VertexId

MOST_AHEAD = 32
"""The largest distance of a robot with a size behind the one that it follows [vertices]."""

Bound = tuple[int, int, int]
"""Visits: one in which a robot waits, the next of its visits that another robot's leaving makes
possible, and that robot's visit; the last two are `NOBODY` for a wait without a cause."""


@checks_arguments
def compute_lost_time(plan: Plan) -> tuple[LostTime, ...]:
    """Return the losses of each robot to others: how much, where and for which robot.

    Parameters
    ----------
    plan
        A plan that keeps the rules; of others, the numbers are claims of the tracks.

    Returns
    -------
    tuple of LostTime
        One for each robot; the sum of its parts is the robot's completion time exactly.

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next.
    """
    return plan.compute_once("lost time", lambda: _measure_lost_time(plan))


def _measure_lost_time(plan: Plan) -> tuple[LostTime, ...]:
    scenario, tracks, alone = plan.scenario, plan.tracks, measure(plan).alone
    stays = plan.stays
    drive = np.concatenate([stay.drive for stay in stays])
    bookings = list_bookings(scenario, tracks, drive)
    losses: defaultdict[int, list[Loss]] = defaultdict(list)
    for loss in join_waits(scenario, tracks, stays):
        losses[loss.robot].append(loss)
    fleet = []
    for robot, (track, stay) in enumerate(zip(tracks, stays, strict=True)):
        own = losses[robot]
        waiting = sum(loss.ticks for loss in own)
        driven = stay.completion - alone[robot] - waiting  # beyond the shortest trip
        itinerary = scenario.problem.itineraries[robot]
        turning = int((stay.dwell - stay.turns).sum()) - _compute_least_dwell_of_trip(itinerary)
        room = list(_find_room_made(robot, track, stay, bookings, turning)) if driven else []
        if itinerary.turning is not None:
            edges = scenario.roadmap.find_edges(track.vertices[:-1], track.vertices[1:])
            room = list(_add_turns(room, track, stay, itinerary.turning, edges))
        making_room = sum(loss.ticks for loss in room)
        lost = LostTime(
            robot=robot,
            alone=alone[robot],
            detours=Tick(driven - making_room),
            making_room=Tick(making_room),
            waiting=Tick(waiting),
            losses=tuple(sorted([*own, *room], key=lambda loss: (loss.tick, -loss.end))),
        )
        fleet.append(lost)
    return tuple(fleet)


def join_waits(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> tuple[Loss, ...]:
    """Return all waits of tracks, those behind one robot joined, by robot, then by tick.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    stays
        The parts of their visits.
    """
    require_one_for_each(scenario.robots, tracks=tracks, stays=stays)
    return tuple(_join_waits(scenario, tracks, stays))


def _join_waits(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> Iterator[Loss]:
    lengths = np.array([len(track) for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    waiting = np.concatenate([drop_holds(stay) for stay in stays])
    yield from _list_holds(tracks, stays)
    enter = np.concatenate([track.enter for track in tracks])
    begin = (enter + np.concatenate([stay.dwell for stay in stays])).tolist()
    vertex = [
        VertexId(vertex) for vertex in np.concatenate([track.vertices for track in tracks]).tolist()
    ]
    frees = find_freeing_visits(scenario, tracks, stays)
    visits = np.flatnonzero(waiting > 0)
    bound = _find_next_bound(frees, robot)[visits + 1]
    joined: list[Bound] = []  # visits: of the wait, bound by the other robot, its own
    for visit, own in zip(visits.tolist(), bound.tolist(), strict=True):
        wait = (visit, own, NOBODY if own == NOBODY else int(frees[own]))
        if joined and not _go_together(joined[-1], wait, vertex, robot):
            yield _join_wait(joined, robot, vertex, begin, waiting)
            joined = []
        joined.append(wait)
    if joined:
        yield _join_wait(joined, robot, vertex, begin, waiting)


def _list_holds(tracks: Sequence[Track], stays: Sequence[Stays]) -> Iterator[Loss]:
    """Yield the waits at stops for jobs of other robots."""
    for robot, (track, stay) in enumerate(zip(tracks, stays, strict=True)):
        for hold in stay.holds:
            place = VertexId(int(track.vertices[hold.visit]))
            yield Loss(
                kind="waits for job",
                robot=robot,
                for_robot=hold.for_robot,
                vertex=place,
                until_vertex=place,
                towards=place,
                freed=None,
                tick=hold.tick,
                end=Tick(hold.tick + hold.ticks),
                ticks=hold.ticks,
                count=1,
            )


def _find_next_bound(frees: NDArray[np.int64], robot: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return, for each visit, the first from it on that another robot's leaving makes possible."""
    last = len(frees)
    bound = np.where(frees == NOBODY, last, np.arange(last))
    following = np.minimum.accumulate(bound[::-1])[::-1]
    is_own = robot[np.minimum(following, last - 1)] == robot
    return np.where((following < last) & is_own, following, NOBODY)


def _go_together(
    before: Bound,
    wait: Bound,
    vertex: Sequence[int],
    robot: NDArray[np.int64],
) -> bool:
    """Return whether a wait goes on from another: one robot, one leader, one run of vertices."""
    (visit, own, leader), (next_visit, next_own, next_leader) = before, wait
    if robot[visit] != robot[next_visit] or NOBODY in (leader, next_leader):
        return False
    if robot[leader] != robot[next_leader] or next_leader - leader != next_own - own:
        return False
    ahead = vertex[own : own + MOST_AHEAD]
    if vertex[leader] not in ahead:
        return False
    lead = ahead.index(vertex[leader])  # 0 but for robots with a size, which keep a distance
    run = slice(own + lead, next_own + lead + 1)
    is_own = run.stop <= len(vertex) and robot[run.stop - 1] == robot[own]
    return bool(is_own) and vertex[run] == vertex[leader : next_leader + 1]


def _join_wait(
    waits: Sequence[Bound],
    robot: NDArray[np.int64],
    vertex: Sequence[int],
    begin: Sequence[int],
    waiting: NDArray[np.int64],
) -> Loss:
    (first, first_own, _), (last, last_own, leader) = waits[0], waits[-1]
    is_caused = leader != NOBODY
    return Loss(
        kind="follows" if last_own > first_own else "waits",
        robot=int(robot[first]),
        for_robot=int(robot[leader]) if is_caused else None,
        vertex=VertexId(vertex[first]),
        until_vertex=VertexId(vertex[last]),
        towards=VertexId(vertex[last + 1]),
        freed=VertexId(vertex[leader]) if is_caused else None,
        tick=Tick(begin[first]),
        end=Tick(begin[last] + int(waiting[last])),
        ticks=Tick(sum(int(waiting[visit]) for visit, *_ in waits)),
        count=len(waits),
    )


def _find_room_made(
    robot: int, track: Track, stay: Stays, bookings: BookedPlaces, turning: int
) -> Iterator[Loss]:
    """Yield the drives of one robot away from a vertex and back to it, between its stops.

    ``turning`` is the time of turning that only a robot needs which leaves its last vertex again.
    """
    vertices, enter = track.vertices.tolist(), track.enter.tolist()
    end = len(vertices) - 1
    for first, last in pairwise(sorted({0, *stay.serves, end})):
        latest = {vertices[visit]: visit for visit in range(first, last + 1)}
        visit = first
        while visit < last:
            back = latest[vertices[visit]]
            if back > visit:
                leave, until = enter[visit + 1], enter[back]
                ticks = int(stay.drive[visit:back].sum())
                if back == end:
                    ticks += max(turning, 0)
                yield Loss(
                    kind="makes room",
                    robot=robot,
                    for_robot=_find_visitor(bookings, robot, vertices[visit], leave, until),
                    vertex=VertexId(vertices[visit]),
                    until_vertex=VertexId(vertices[visit]),
                    towards=VertexId(vertices[visit + 1]),
                    freed=None,
                    tick=Tick(leave),
                    end=Tick(until),
                    ticks=Tick(ticks),
                    count=1,
                )
            visit = back + 1


def _add_turns(
    room: Sequence[Loss], track: Track, stay: Stays, turning: Turning, edges: NDArray[np.int32]
) -> Iterator[Loss]:
    """Yield the drives of one robot that make room, their turns included.

    Without the drives, the robot would turn from the edge before them to the edge after them. Where
    that takes as long as they do, they are a way to turn.
    """
    ends = np.concatenate(([-1], edges, [-1])).astype(np.int32)  # of visit k: ends[k : k + 2]
    for loss in room:
        first = int(np.searchsorted(track.enter, loss.tick)) - 1
        back = int(np.searchsorted(track.enter, loss.end))
        across = int(turning.compute_turns(ends[[first, back + 1]])[0])
        ticks = loss.ticks + int(stay.turns[first : back + 1].sum()) - across
        if ticks > 0:
            yield replace(loss, ticks=Tick(ticks))


def _find_visitor(
    bookings: BookedPlaces, robot: int, vertex: int, leave: int, until: int
) -> int | None:
    """Return the first other robot that books a vertex while a robot is away."""
    # Of the same type: for Python's numbers numpy would copy all bookings of the fleet.
    places = np.array((vertex, vertex + 1), bookings.vertex.dtype)
    first, after = np.searchsorted(bookings.vertex, places)
    inside = (
        (bookings.robot[first:after] != robot)
        & (bookings.start[first:after] >= leave)
        & (bookings.start[first:after] < until)
    )
    return int(bookings.robot[first:after][inside][0]) if inside.any() else None


def _compute_least_dwell_of_trip(itinerary: Itinerary) -> int:
    """Return the least ticks of all visits of a trip, without drives and turns to them."""
    visits = [list(stages) for _, stages in groupby(itinerary.stages, lambda stage: stage.vertex)]
    moving = sum(compute_least_dwell(stages, leaves=True) for stages in visits[:-1])
    return moving + compute_least_dwell(visits[-1], leaves=False)
