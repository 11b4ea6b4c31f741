"""Bookings, and where robots meet: collisions, swaps, robots that are too near for their sizes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, combinations, groupby, pairwise, product
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.arguments import checks_arguments, require_one_for_each
from rightofway.model import NEVER, Plan, Scenario, Stays, Tick, Track, find_stays
from rightofway.model.resources import Resources
from rightofway.model.sorting import order_by
from rightofway.native import book_times, list_excluded
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BookedPlaces:
    """All bookings of a fleet, by vertex, then by start; each array has shape (n,)."""

    visit: NDArray[np.int64]  # counted robot by robot along the tracks
    robot: NDArray[np.int64]
    vertex: NDArray[np.int32]
    start: NDArray[np.int64]  # [ticks]
    end: NDArray[np.int64]  # [ticks]


def list_bookings(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> BookedPlaces:
    """Return what a fleet books under the scenario's rules."""
    start, end = book_times(scenario.problem, tracks, stays)
    vertex = np.concatenate([track.vertices for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), [len(track) for track in tracks])
    order = order_by(vertex, start)  # stable, so by robot where all else is equal
    return BookedPlaces(
        visit=order, robot=robot[order], vertex=vertex[order], start=start[order], end=end[order]
    )


@checks_arguments
def free_running(plan: Plan) -> tuple[Track, ...]:
    """Return tracks of the same routes and work, without any wait.

    Parameters
    ----------
    plan
        The plan whose waits are left out.
    """
    return tuple(
        Track(
            vertices=track.vertices,
            enter=np.append(0, np.cumsum((stay.dwell + stay.drive)[:-1])),
        )
        for track, stay in zip(plan.tracks, plan.stays, strict=True)
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


@checks_arguments
def find_collisions(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Collision, ...]:
    """Return where bookings of any tracks overlap, by start, then by robots.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.

    Notes
    -----
    The paper's list counts the ticks of these intervals one by one.
    """
    require_one_for_each(scenario.robots, tracks=tracks)
    bookings = list_bookings(scenario, tracks, find_stays(scenario, tracks))
    columns = (bookings.vertex, bookings.start, bookings.end, bookings.robot)
    collisions_at_vertex: list[Collision] = []
    open_bookings: list[tuple[int, int, int]] = []  # of the vertex, those that have not ended yet
    for vertex, start, end, robot in zip(*(column.tolist() for column in columns), strict=True):
        open_bookings = [
            booking for booking in open_bookings if booking[0] == vertex and booking[1] > start
        ]
        for _, other_end, other in open_bookings:
            until = min(end, other_end)
            if other != robot:
                collision = Collision(
                    robots=(min(robot, other), max(robot, other)),
                    vertex=VertexId(vertex),
                    start=Tick(start),
                    end=None if until == NEVER else Tick(until),
                )
                collisions_at_vertex.append(collision)
        open_bookings.append((vertex, end, robot))
    return tuple(
        sorted(
            collisions_at_vertex,
            key=lambda collision: (collision.start, collision.robots, collision.vertex),
        )
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Swap:
    """Two robots exchange two vertices at one instant.

    Attributes
    ----------
    robots
        The two, by index, the smaller first.
    vertices
        The vertex that the first one leaves, and the vertex that the other one leaves.
    tick
        When [ticks]; each is in its new vertex from this tick on.
    """

    robots: tuple[int, int]
    vertices: tuple[VertexId, VertexId]
    tick: Tick


@checks_arguments
def find_swaps(tracks: Sequence[Track]) -> tuple[Swap, ...]:
    """Return where two robots of any tracks exchange vertices, by tick, then by robots.

    Parameters
    ----------
    tracks
        One track for each robot.
    """
    if not tracks:
        return ()
    tail = np.concatenate([track.vertices[:-1] for track in tracks])
    head = np.concatenate([track.vertices[1:] for track in tracks])
    tick = np.concatenate([track.enter[1:] for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), [len(track) - 1 for track in tracks])
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    order = order_by(low, high, tick)
    as_before = np.zeros(len(order) + 1, bool)  # nearly all moves are alone at their instant
    as_before[1:-1] = np.logical_and.reduce(
        [np.diff(column[order]) == 0 for column in (low, high, tick)]
    )
    order = order[as_before[:-1] | as_before[1:]]
    columns = (low, high, tick, robot, tail, head)
    moves = zip(*(column[order].tolist() for column in columns), strict=True)
    swaps_in_place = [
        Swap(robots=(robot, other), vertices=(VertexId(start), VertexId(end)), tick=Tick(when))
        for (_, _, when), together in groupby(moves, key=itemgetter(0, 1, 2))
        for (*_, robot, start, end), (*_, other, start_of_other, _) in combinations(together, 2)
        if robot != other and start not in (end, start_of_other)
    ]
    return tuple(sorted(swaps_in_place, key=lambda swap: (swap.tick, swap.robots, swap.vertices)))


@dataclass(frozen=True, slots=True, kw_only=True)
class NearMiss:
    """Two robots are nearer to each other than their sizes allow, on different places.

    Attributes
    ----------
    robots
        The two, by index, the smaller first.
    places
        Where each of them is at first: a vertex, or the two vertices of an edge.
    start, end
        From when to when [ticks]; an end of None is never.
    """

    robots: tuple[int, int]
    places: tuple[tuple[VertexId, ...], tuple[VertexId, ...]]
    start: Tick
    end: Tick | None


@checks_arguments
def find_near_misses(scenario: Scenario, tracks: Sequence[Track]) -> tuple[NearMiss, ...]:
    """Return where robots of any tracks are too near for their sizes, by start, then by robots.

    Parameters
    ----------
    scenario
        The problem; without a robot that has a size there is none.
    tracks
        One track for each robot.

    Notes
    -----
    Bookings of places that exclude each other overlap. What follows without a gap for the same two
    robots is one near miss.
    """
    require_one_for_each(scenario.robots, tracks=tracks)
    resources = scenario.problem.resources
    if resources.are_points:  # their bookings exclude each other at one vertex: collisions
        return ()
    of_row: defaultdict[int, list[_Booking]] = defaultdict(list)
    for robot, (track, stay) in enumerate(zip(tracks, find_stays(scenario, tracks), strict=True)):
        for row, booking in _places_booked(scenario, resources, robot, track, stay):
            of_row[row].append(booking)
    overlaps: defaultdict[tuple[int, int], list[_Overlap]] = defaultdict(list)
    for row, bookings in of_row.items():
        others = chain.from_iterable(
            of_row.get(excluded_row, ()) for excluded_row in list_excluded(resources, row)
        )
        for booking, other in product(bookings, list(others)):
            start, end = max(booking.start, other.start), min(booking.end, other.end)
            if booking.robot < other.robot and start < end and booking.place != other.place:
                overlap = start, end, (booking.place, other.place)
                overlaps[booking.robot, other.robot].append(overlap)
    near_ones = [
        NearMiss(
            robots=robots,
            places=places,
            start=Tick(start),
            end=None if end == NEVER else Tick(end),
        )
        for robots, times in overlaps.items()
        for start, end, places in _joined(times)
    ]
    return tuple(sorted(near_ones, key=lambda miss: (miss.start, miss.robots)))


class NamedCollision(NamedTuple):
    """A collision, a swap or a near miss of robots i and j, with the names of robots and places."""

    i: str
    j: str
    start: Tick
    until: Tick | None
    places: tuple[str, ...]
    kind: str


@checks_arguments
def name_collisions(scenario: Scenario, tracks: Sequence[Track]) -> tuple[NamedCollision, ...]:
    """Return the collisions, swaps and near misses of any tracks, by time, with names of places.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    name, place = [robot.name for robot in scenario.robots], scenario.roadmap.name
    meetings: list[Collision | Swap | NearMiss] = [
        *find_collisions(scenario, tracks),
        *find_swaps(tracks),
    ]
    meetings += find_near_misses(scenario, tracks)
    rows = []
    for meeting in meetings:
        i, j = (name[robot] for robot in meeting.robots)
        if isinstance(meeting, Collision):
            row = NamedCollision(
                i, j, meeting.start, meeting.end, (place(meeting.vertex),), "collision"
            )
        elif isinstance(meeting, NearMiss):
            near = tuple("-".join(map(place, vertices)) for vertices in meeting.places)
            row = NamedCollision(i, j, meeting.start, meeting.end, near, "too near")
        else:
            places = tuple(map(place, meeting.vertices))
            row = NamedCollision(i, j, meeting.tick, meeting.tick, places, "swap")
        rows.append(row)
    return tuple(sorted(rows, key=lambda row: row.start))


class _Booking(NamedTuple):
    start: int
    end: int
    robot: int
    place: tuple[VertexId, ...]


_Overlap = tuple[int, int, tuple[tuple[VertexId, ...], tuple[VertexId, ...]]]


def _places_booked(
    scenario: Scenario, resources: Resources, robot: int, track: Track, stay: Stays
) -> Iterator[tuple[int, _Booking]]:
    """Yield what one robot books, with the row of the resource: vertices, and edges it drives."""
    vertices = [VertexId(vertex) for vertex in track.vertices.tolist()]
    edges = scenario.roadmap.find_edges(track.vertices[:-1], track.vertices[1:]).tolist()
    starts = (track.enter - np.append(0, stay.drive[:-1])).tolist()
    ends = [*scenario.problem.booking_rules.end(track.enter[1:]).tolist(), NEVER]
    for vertex, start, end in zip(vertices, starts, ends, strict=True):
        yield resources.get_vertex_row(robot, vertex), _Booking(start, end, robot, (vertex,))
    for edge, ends_of_edge, start, end in zip(
        edges, pairwise(vertices), starts[1:], ends[:-1], strict=True
    ):
        if edge >= 0:
            yield resources.get_edge_row(robot, edge), _Booking(start, end, robot, ends_of_edge)


def _joined(times: Iterable[_Overlap]) -> list[_Overlap]:
    """Join what follows without a gap; the places are those of the first."""
    joined: list[_Overlap] = []
    for start, end, places in sorted(times):
        if joined and start <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(joined[-1][1], end), joined[-1][2]
        else:
            joined.append((start, end, places))
    return joined
