"""Bookings, and where robots meet on one vertex or lane: collisions and swaps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import check_work, measure_work_left
from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.kinds.table import require_one_for_each
from rightofway.model import NEVER, Plan, Scenario, Tick, Track
from rightofway.model.sorting import order_by
from rightofway.model.stays import compute_drives
from rightofway.native import book_times, find_overlaps
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
"""Collisions, swaps or overlaps of near places of a fleet that are found, at most; half a gigabyte
for each kind."""

FINDING = Fact("finding collisions")


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
    meetings = list_collisions(scenario, tracks)
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
        for i, j, tick, _, vertex, other in list_swaps(tracks).list_rows(slice(None))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Meetings:
    """Collisions and swaps in columns of shape (n,), by start.

    ``other`` is the second vertex of a swap, -1 for a collision.
    """

    i: NDArray[np.int32]
    j: NDArray[np.int32]
    start: NDArray[np.int64]  # [ticks]
    end: NDArray[np.int64]  # [ticks]
    vertex: NDArray[np.int32]
    other: NDArray[np.int32]

    def list_rows(self, chosen: slice | NDArray[np.int64]) -> Iterator[tuple[int, ...]]:
        """Yield the values of some rows."""
        columns = (self.i, self.j, self.start, self.end, self.vertex, self.other)
        return zip(*(column[chosen].tolist() for column in columns), strict=True)


def sort_meetings(*parts: tuple[NDArray[Any], ...]) -> Meetings:
    """Return collisions or swaps, given by the columns of `Meetings`, in their order."""
    i, j, start, end, vertex, other = (
        np.concatenate(column) for column in zip(*parts, strict=True)
    )
    order = order_by(start, (other >= 0).astype(np.int8), i, j, vertex, other)
    return Meetings(
        i=i[order],
        j=j[order],
        start=start[order],
        end=end[order],
        vertex=vertex[order],
        other=other[order],
    )


def list_overlaps(
    place: NDArray[np.int32],
    owner: NDArray[np.int32],
    start: NDArray[np.int64],
    end: NDArray[np.int64],
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the earlier and the later booking of pairs of two owners that overlap at one place.

    The bookings are sorted by place, then by start [ticks].

    Raises
    ------
    InputError
        If there are more than `MOST_MEETINGS`.
    """
    left = measure_work_left()
    earlier, later, are_all = find_overlaps(
        place, owner, start, end, most=MOST_MEETINGS, time_limit=left
    )
    check_work(FINDING)
    if not are_all:
        refuse_meetings()
    return earlier, later


def refuse_meetings() -> NoReturn:
    """Refuse a fleet that meets too often for a list."""
    message = f"robots meet more than {MOST_MEETINGS} times (take fewer robots)"
    raise InputError.at("robots", message)


def list_collisions(scenario: Scenario, tracks: Sequence[Track]) -> Meetings:
    """Return the overlaps of bookings of any tracks in columns."""
    bookings = list_bookings(scenario, tracks, compute_drives(scenario, tracks))
    check_work(FINDING)
    earlier, later = list_overlaps(bookings.vertex, bookings.robot, bookings.start, bookings.end)
    first, second = bookings.robot[earlier], bookings.robot[later]
    return sort_meetings(
        (
            np.minimum(first, second),
            np.maximum(first, second),
            bookings.start[later],
            np.minimum(bookings.end[earlier], bookings.end[later]),
            bookings.vertex[later],
            np.full(len(later), -1, np.int32),
        )
    )


def list_swaps(tracks: Sequence[Track]) -> Meetings:
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
    earlier, later = list_overlaps(lane, robot, tick, tick + 1)
    is_swap = (tail[earlier] != head[earlier]) & (tail[earlier] != tail[later])
    earlier, later = earlier[is_swap], later[is_swap]
    first, last = (
        np.where(robot[earlier] < robot[later], *pair)
        for pair in ((earlier, later), (later, earlier))
    )
    return sort_meetings(
        (robot[first], robot[last], tick[first], tick[first], tail[first], tail[last])
    )
