"""Bookings, and where robots meet: collisions, swaps, robots that are too near for their sizes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise, product
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import check_work, limit_loop, measure_work_left
from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.kinds.table import require_one_for_each
from rightofway.model import NEVER, Plan, Scenario, Stays, Tick, Track, find_stays
from rightofway.model.resources import Resources
from rightofway.model.sorting import order_by
from rightofway.model.stays import compute_drives
from rightofway.native import book_times, find_overlaps, list_excluded
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BookedPlaces:
    """All bookings of a fleet, by vertex, then by start; each array has shape (n,)."""

    visit: NDArray[np.int64]  # counted robot by robot along the tracks
    robot: NDArray[np.int32]
    vertex: NDArray[np.int32]
    start: NDArray[np.int64]  # [ticks]
    end: NDArray[np.int64]  # [ticks]


MOST_MEETINGS = 10_000_000
"""Collisions and swaps of a fleet that are found, at most; half a gigabyte."""

FINDING = Fact("finding collisions")

ROWS_AT_ONCE = 4096
"""Rows of a list of collisions that are made objects at once."""


def list_bookings(
    scenario: Scenario, tracks: Sequence[Track], drive: NDArray[np.int64]
) -> BookedPlaces:
    """Return the bookings of a fleet under the scenario's rules, given its drives."""
    start, end = book_times(scenario.problem, tracks, drive)
    vertex = np.concatenate([track.vertices for track in tracks])
    robot = np.repeat(np.arange(len(tracks), dtype=np.int32), [len(track) for track in tracks])
    order = order_by(vertex, start)  # stable, so by robot where all else is equal
    return BookedPlaces(
        visit=order, robot=robot[order], vertex=vertex[order], start=start[order], end=end[order]
    )


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


def find_collisions(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Collision, ...]:
    """Return the overlaps of bookings of any tracks, by start, then by robots.

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
    meetings = _list_collisions(scenario, tracks)
    return tuple(
        Collision(
            robots=(i, j),
            vertex=VertexId(vertex),
            start=Tick(start),
            end=None if end == NEVER else Tick(end),
        )
        for i, j, start, end, vertex, _ in meetings.list_rows(slice(None))
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


def find_swaps(tracks: Sequence[Track]) -> tuple[Swap, ...]:
    """Return the swaps of any tracks, by tick, then by robots.

    Parameters
    ----------
    tracks
        One track for each robot.
    """
    return tuple(
        Swap(robots=(i, j), vertices=(VertexId(vertex), VertexId(other)), tick=Tick(tick))
        for i, j, tick, _, vertex, other in _list_swaps(tracks).list_rows(slice(None))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Meetings:
    """Collisions and swaps in columns of shape (n,), by start.

    ``other`` is the second vertex of a swap, -1 for a collision.
    """

    i: NDArray[np.int32]
    j: NDArray[np.int32]
    start: NDArray[np.int64]  # [ticks]
    end: NDArray[np.int64]  # [ticks]
    vertex: NDArray[np.int32]
    other: NDArray[np.int32]

    def list_rows(self, chosen: slice) -> Iterator[tuple[int, ...]]:
        """Yield the values of some rows."""
        columns = (self.i, self.j, self.start, self.end, self.vertex, self.other)
        return zip(*(column[chosen].tolist() for column in columns), strict=True)


def _sort_meetings(*parts: tuple[NDArray[Any], ...]) -> _Meetings:
    """Return collisions or swaps, given by the columns of `_Meetings`, in their order."""
    i, j, start, end, vertex, other = (
        np.concatenate(column) for column in zip(*parts, strict=True)
    )
    order = order_by(start, (other >= 0).astype(np.int8), i, j, vertex, other)
    return _Meetings(
        i=i[order],
        j=j[order],
        start=start[order],
        end=end[order],
        vertex=vertex[order],
        other=other[order],
    )


def _find_overlaps(
    vertex: NDArray[np.int32],
    robot: NDArray[np.int32],
    start: NDArray[np.int64],
    end: NDArray[np.int64],
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the earlier and the later booking of each pair that overlaps at one vertex."""
    left = measure_work_left()
    earlier, later, are_all = find_overlaps(
        vertex, robot, start, end, most=MOST_MEETINGS, time_limit=left
    )
    check_work(FINDING)
    if not are_all:
        message = f"robots meet more than {MOST_MEETINGS} times (take fewer robots)"
        raise InputError.at("robots", message)
    return earlier, later


def _list_collisions(scenario: Scenario, tracks: Sequence[Track]) -> _Meetings:
    bookings = list_bookings(scenario, tracks, compute_drives(scenario, tracks))
    check_work(FINDING)
    earlier, later = _find_overlaps(bookings.vertex, bookings.robot, bookings.start, bookings.end)
    first, second = bookings.robot[earlier], bookings.robot[later]
    return _sort_meetings(
        (
            np.minimum(first, second),
            np.maximum(first, second),
            bookings.start[later],
            np.minimum(bookings.end[earlier], bookings.end[later]),
            bookings.vertex[later],
            np.full(len(later), -1, np.int32),
        )
    )


def _list_swaps(tracks: Sequence[Track]) -> _Meetings:
    """Return the swaps of any tracks: two moves along one lane at one instant, in both ways."""
    none = np.zeros(0, np.int32)
    tail = np.concatenate([none, *(track.vertices[:-1] for track in tracks)])
    head = np.concatenate([none, *(track.vertices[1:] for track in tracks)])
    tick = np.concatenate([none.astype(np.int64), *(track.enter[1:] for track in tracks)])
    robot = np.repeat(np.arange(len(tracks), dtype=np.int32), [len(track) - 1 for track in tracks])
    low, high = np.minimum(tail, head), np.maximum(tail, head)
    order = order_by(low, high, tick)
    check_work(FINDING)
    low, high, tick = low[order], high[order], tick[order]
    is_same_lane = (np.diff(low) == 0) & (np.diff(high) == 0)
    as_before = np.zeros(len(order) + 1, bool)  # nearly all moves are alone at their instant
    as_before[1:-1] = (is_same_lane & (np.diff(tick) == 0))[: max(len(order) - 1, 0)]
    together = as_before[:-1] | as_before[1:]
    lane = np.append(0, np.cumsum(~is_same_lane)).astype(np.int32)[: len(order)][together]
    tick, order = tick[together], order[together]
    tail, head, robot = tail[order], head[order], robot[order]
    earlier, later = _find_overlaps(lane, robot, tick, tick + 1)
    is_swap = (tail[earlier] != head[earlier]) & (tail[earlier] != tail[later])
    earlier, later = earlier[is_swap], later[is_swap]
    first, last = (
        np.where(robot[earlier] < robot[later], *pair)
        for pair in ((earlier, later), (later, earlier))
    )
    return _sort_meetings(
        (robot[first], robot[last], tick[first], tick[first], tail[first], tail[last])
    )


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


def find_near_misses(scenario: Scenario, tracks: Sequence[Track]) -> tuple[NearMiss, ...]:
    """Return the near misses of any tracks, by start, then by robots.

    Parameters
    ----------
    scenario
        The problem; without a robot that has a size there is none.
    tracks
        One track for each robot.

    Notes ----- Bookings of places that exclude each other overlap. Overlaps that follow without a
    gap for the same two robots is one near miss.
    """
    require_one_for_each(scenario.robots, tracks=tracks)
    resources = scenario.problem.resources
    if resources.are_points:  # their bookings exclude each other at one vertex: collisions
        return ()
    of_row: defaultdict[int, list[_Booking]] = defaultdict(list)
    for robot, (track, stay) in enumerate(zip(tracks, find_stays(scenario, tracks), strict=True)):
        for row, booking in _list_places_booked(scenario, resources, robot, track, stay):
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
        for start, end, places in _join_overlaps(times)
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


class NamedCollisions(Sequence[NamedCollision]):
    """Collisions, swaps and near misses by start; rows become objects when they are read.

    Parameters
    ----------
    scenario
        The names of robots and places.
    meetings
        Collisions and swaps.
    near
        Near misses.
    """

    def __init__(
        self, scenario: Scenario, meetings: _Meetings, near: Sequence[NamedCollision] = ()
    ) -> None:
        self._scenario, self._meetings, self._near = scenario, meetings, tuple(near)
        starts = np.append(meetings.start, np.array([row.start for row in near], np.int64))
        self._order = np.argsort(starts, kind="stable") if near else None

    def __len__(self) -> int:
        return len(self._meetings.start) + len(self._near)

    @overload
    def __getitem__(self, at: int) -> NamedCollision: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[NamedCollision]: ...
    def __getitem__(self, at: int | slice) -> NamedCollision | Sequence[NamedCollision]:
        rows = range(len(self))[at]
        if isinstance(rows, int):
            return self._list_rows(slice(rows, rows + 1))[0]
        return self._list_rows(at if isinstance(at, slice) else slice(None))

    def __iter__(self) -> Iterator[NamedCollision]:
        for first in limit_loop(range(0, len(self), ROWS_AT_ONCE), FINDING, 1):
            yield from self._list_rows(slice(first, first + ROWS_AT_ONCE))

    def count_kinds(self) -> dict[str, int]:
        """Return the number of rows of each kind: collision, swap, too near."""
        n_swaps = int(np.count_nonzero(self._meetings.other >= 0))
        n_collisions = len(self._meetings.start) - n_swaps
        return {"collision": n_collisions, "swap": n_swaps, "too near": len(self._near)}

    def _list_rows(self, chosen: slice) -> list[NamedCollision]:
        if self._order is None:
            return list(map(self._name, self._meetings.list_rows(chosen)))
        n_meetings = len(self._meetings.start)
        return [
            self._name(next(self._meetings.list_rows(slice(row, row + 1))))
            if row < n_meetings
            else self._near[row - n_meetings]
            for row in self._order[chosen].tolist()
        ]

    def _name(self, row: tuple[int, ...]) -> NamedCollision:
        i, j, start, end, vertex, other = row
        robots, place = self._scenario.robots, self._scenario.roadmap.name
        vertices = (vertex,) if other < 0 else (vertex, other)
        return NamedCollision(
            robots[i].name,
            robots[j].name,
            Tick(start),
            None if end == NEVER else Tick(end),
            tuple(map(place, vertices)),
            "collision" if other < 0 else "swap",
        )


def name_collisions(scenario: Scenario, tracks: Sequence[Track]) -> NamedCollisions:
    """Return the collisions, swaps and near misses of any tracks, by time, with names of places.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.

    Raises
    ------
    InputError
        If there are more than `MOST_MEETINGS` collisions or swaps.
    """
    require_one_for_each(scenario.robots, tracks=tracks)
    parts = [_list_collisions(scenario, tracks), _list_swaps(tracks)]
    meetings = _sort_meetings(
        *((part.i, part.j, part.start, part.end, part.vertex, part.other) for part in parts)
    )
    name, place = [robot.name for robot in scenario.robots], scenario.roadmap.name
    near = [
        NamedCollision(
            name[miss.robots[0]],
            name[miss.robots[1]],
            miss.start,
            miss.end,
            tuple("-".join(map(place, vertices)) for vertices in miss.places),
            "too near",
        )
        for miss in find_near_misses(scenario, tracks)
    ]
    return NamedCollisions(scenario, meetings, near)


class _Booking(NamedTuple):
    start: int
    end: int
    robot: int
    place: tuple[VertexId, ...]


_Overlap = tuple[int, int, tuple[tuple[VertexId, ...], tuple[VertexId, ...]]]


def _list_places_booked(
    scenario: Scenario, resources: Resources, robot: int, track: Track, stay: Stays
) -> Iterator[tuple[int, _Booking]]:
    """Yield the bookings of one robot of vertices and driven edges, with their rows."""
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


def _join_overlaps(times: Iterable[_Overlap]) -> list[_Overlap]:
    """Join overlaps that follow without a gap; the places are those of the first."""
    joined: list[_Overlap] = []
    for start, end, places in sorted(times):
        if joined and start <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(joined[-1][1], end), joined[-1][2]
        else:
            joined.append((start, end, places))
    return joined
