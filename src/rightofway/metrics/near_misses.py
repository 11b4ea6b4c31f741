"""Robots that are nearer to each other than their sizes allow, on places of their own.

Bookings of places that exclude each other overlap (`rightofway.model.resources`). The bookings of
a fleet are columns; those of two rows that exclude each other are swept together by time.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import limit_loop
from rightofway.kinds.table import require_one_for_each
from rightofway.metrics import collisions
from rightofway.metrics.collisions import FINDING, list_overlaps, refuse_meetings
from rightofway.model import NEVER, Scenario, Tick, Track
from rightofway.model.resources import Resources
from rightofway.model.sorting import order_by
from rightofway.model.stays import compute_drives
from rightofway.native import list_excluded
from rightofway.site import VertexId

Ints = NDArray[np.int64]

BOOKINGS_AT_ONCE = 2_000_000
"""Bookings of pairs of rows that are swept at once, unless one pair has more."""


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NearMisses:
    """Near misses in columns of shape (n,), by start, then by robots.

    Attributes
    ----------
    i, j
        The two robots, the smaller first.
    start, end
        From when to when [ticks]; `NEVER` for no end.
    tails, heads
        Where each of them is at first, shape (n, 2): a vertex and -1, or both ends of an edge.
    """

    i: Ints
    j: Ints
    start: Ints
    end: Ints
    tails: Ints
    heads: Ints

    def make_rows(self, chosen: slice | Ints) -> Iterator[NearMiss]:
        """Yield the objects of some rows."""
        columns = (self.i, self.j, self.start, self.end, self.tails, self.heads)
        for i, j, start, end, tails, heads in zip(
            *(column[chosen].tolist() for column in columns), strict=True
        ):
            left, right = (
                (VertexId(tail),) if head < 0 else (VertexId(tail), VertexId(head))
                for tail, head in zip(tails, heads, strict=True)
            )
            yield NearMiss(
                robots=(i, j),
                places=(left, right),
                start=Tick(start),
                end=None if end == NEVER else Tick(end),
            )


def find_near_misses(scenario: Scenario, tracks: Sequence[Track]) -> tuple[NearMiss, ...]:
    """Return the near misses of any tracks, by start, then by robots.

    Parameters
    ----------
    scenario
        The problem; without a robot that has a size there is none.
    tracks
        One track for each robot.

    Raises
    ------
    InputError
        If bookings of places that exclude each other overlap more than `MOST_MEETINGS` times.

    Notes
    -----
    Bookings of places that exclude each other overlap. Overlaps that follow without a gap for the
    same two robots are one near miss.
    """
    return tuple(list_near_misses(scenario, tracks).make_rows(slice(None)))


def list_near_misses(scenario: Scenario, tracks: Sequence[Track]) -> NearMisses:
    """Return the near misses of any tracks in columns."""
    require_one_for_each(scenario.robots, tracks=tracks)
    resources = scenario.problem.resources
    if resources.are_points:  # their bookings exclude each other at one vertex: collisions
        none = np.zeros(0, np.int64)
        ends = np.zeros((0, 2), np.int64)
        return NearMisses(i=none, j=none, start=none, end=none, tails=ends, heads=ends)
    booked = _list_places_booked(scenario, tracks)
    return _join_overlaps(booked, *_find_overlaps(booked, _pair_rows(resources, booked)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _RowPairs:
    """Pairs of booked rows of which one excludes the other; rows by their number in `_Booked`.

    ``forth`` tells whether the list of the first row has the second, ``back`` the reverse.
    """

    first: Ints
    second: Ints
    forth: NDArray[np.bool_]
    back: NDArray[np.bool_]

    def take(self, chosen: slice) -> _RowPairs:
        """Return some of the pairs."""
        return _RowPairs(
            first=self.first[chosen],
            second=self.second[chosen],
            forth=self.forth[chosen],
            back=self.back[chosen],
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Booked:
    """The bookings of vertices and driven edges of a fleet, by row, then by start.

    Bookings ``begin[k]`` to ``begin[k + 1]`` (exclusive) are those of row ``rows[k]``.
    """

    rows: Ints
    begin: Ints
    robot: Ints
    start: Ints  # [ticks]
    end: Ints  # [ticks]
    tail: Ints
    head: Ints  # -1 at a vertex

    def list_parts(self, pairs: _RowPairs) -> Iterator[_RowPairs]:
        """Yield pairs of rows so that those of a part have `BOOKINGS_AT_ONCE` bookings."""
        counts = np.diff(self.begin)
        part = np.cumsum(counts[pairs.first] + counts[pairs.second]) // BOOKINGS_AT_ONCE
        firsts = np.flatnonzero(np.diff(part, prepend=-1)).tolist()
        for first, last in pairwise([*firsts, len(part)]):
            yield pairs.take(slice(first, last))

    def sweep(self, pairs: _RowPairs) -> tuple[Ints, Ints]:
        """Return overlapping bookings of paired rows, those of the smaller robot first."""
        sides = [self._spread(rows) for rows in (pairs.first, pairs.second)]
        booking, pair = (np.concatenate(columns) for columns in zip(*sides, strict=True))
        side = np.repeat(np.arange(2, dtype=np.int32), [len(column) for column, _ in sides])
        order = order_by(pair, self.start[booking])
        booking, pair, side = booking[order], pair[order], side[order]
        earlier, later = list_overlaps(
            pair.astype(np.int32), side, self.start[booking], self.end[booking]
        )
        is_forth = side[earlier] == 0
        left = booking[np.where(is_forth, earlier, later)]
        right = booking[np.where(is_forth, later, earlier)]
        at = pair[earlier]
        forth = pairs.forth[at] & (self.robot[left] < self.robot[right])
        back = pairs.back[at] & (self.robot[right] < self.robot[left])
        is_long = np.maximum(self.start[left], self.start[right]) < np.minimum(
            self.end[left], self.end[right]
        )
        is_kept = (forth | back) & is_long
        left, right, back = left[is_kept], right[is_kept], back[is_kept]
        return np.where(back, right, left), np.where(back, left, right)

    def _spread(self, rows: Ints) -> tuple[Ints, Ints]:
        """Return the bookings of rows, and for each the number of its row in the list."""
        counts = np.diff(self.begin)[rows]
        number = np.repeat(np.arange(len(rows)), counts)
        within = np.arange(len(number)) - np.repeat(np.cumsum(counts) - counts, counts)
        return self.begin[rows][number] + within, number


def _list_places_booked(scenario: Scenario, tracks: Sequence[Track]) -> _Booked:
    """Return the bookings of a fleet of vertices and of driven edges."""
    resources, roadmap = scenario.problem.resources, scenario.roadmap
    lengths = np.array([len(track) for track in tracks])
    vertex = np.concatenate([track.vertices for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    start = enter - np.roll(compute_drives(scenario, tracks), 1)  # the drive of a last visit is 0
    end = np.append(scenario.problem.booking_rules.end(enter[1:]), NEVER)
    end[np.cumsum(lengths) - 1] = NEVER
    own = resources.size_of.astype(np.int64)[robot] * (resources.n_vertices + resources.n_edges)
    (driven,) = np.nonzero(robot[:-1] == robot[1:])
    edge = roadmap.find_edges(vertex[driven], vertex[driven + 1])
    driven, edge = driven[edge >= 0], edge[edge >= 0]
    row = np.append(own + vertex, own[driven] + resources.n_vertices + edge)
    start, end = np.append(start, start[driven + 1]), np.append(end, end[driven])
    order = order_by(row, start)
    rows, begin = np.unique(row[order], return_index=True)
    return _Booked(
        rows=rows,
        begin=np.append(begin, len(row)),
        robot=np.append(robot, robot[driven])[order],
        start=start[order],
        end=end[order],
        tail=np.append(vertex, vertex[driven]).astype(np.int64)[order],
        head=np.append(np.full(len(vertex), -1), vertex[driven + 1])[order],
    )


def _pair_rows(resources: Resources, booked: _Booked) -> _RowPairs:
    """Return the pairs of booked rows of different places of which one excludes the other."""
    lists = [list_excluded(resources, row) for row in limit_loop(booked.rows.tolist(), FINDING)]
    n_rows = len(booked.rows)
    row = np.repeat(np.arange(n_rows), [len(excluded) for excluded in lists])
    excluded = np.fromiter(chain.from_iterable(lists), np.int64, len(row))
    other = np.minimum(np.searchsorted(booked.rows, excluded), n_rows - 1)
    place = booked.rows % (resources.n_vertices + resources.n_edges)
    is_kept = (booked.rows[other] == excluded) & (place[other] != place[row])
    row, other = row[is_kept], other[is_kept]
    pairs, number = np.unique(
        np.minimum(row, other) * n_rows + np.maximum(row, other), return_inverse=True
    )
    forth, back = np.zeros(len(pairs), bool), np.zeros(len(pairs), bool)
    forth[number[row < other]] = True
    back[number[row > other]] = True
    return _RowPairs(first=pairs // n_rows, second=pairs % n_rows, forth=forth, back=back)


def _find_overlaps(booked: _Booked, pairs: _RowPairs) -> tuple[Ints, Ints]:
    """Return the overlapping bookings of paired rows, those of the smaller robot first."""
    none = np.zeros(0, np.int64)
    overlaps, count = [(none, none)], 0
    for part in booked.list_parts(pairs):
        overlaps.append(booked.sweep(part))
        count += len(overlaps[-1][0])
        if count > collisions.MOST_MEETINGS:
            refuse_meetings()
    left, right = zip(*overlaps, strict=True)
    return np.concatenate(left), np.concatenate(right)


def _join_overlaps(booked: _Booked, left: Ints, right: Ints) -> NearMisses:
    """Join overlaps that follow without a gap; the places are those of the first."""
    start = np.maximum(booked.start[left], booked.start[right])
    end = np.minimum(booked.end[left], booked.end[right])
    columns = (booked.robot[left], booked.robot[right], start, end)
    places = (booked.tail[left], booked.head[left], booked.tail[right], booked.head[right])
    order = order_by(*columns, *places)
    left, right, start, end = left[order], right[order], start[order], end[order]
    i, j = booked.robot[left], booked.robot[right]
    is_new_pair = np.append(True, (np.diff(i) != 0) | (np.diff(j) != 0))[: len(i)]
    reached = _find_latest(is_new_pair, end)
    is_first = is_new_pair.copy()
    is_first[1:] |= start[1:] > reached[:-1]
    (first,) = np.nonzero(is_first)
    last = np.append(first[1:], len(i))[: len(first)] - 1
    by_start = order_by(start[first], i[first], j[first])
    first, last = first[by_start], last[by_start]
    left, right = left[first], right[first]
    return NearMisses(
        i=i[first],
        j=j[first],
        start=start[first],
        end=reached[last],
        tails=np.column_stack((booked.tail[left], booked.tail[right])),
        heads=np.column_stack((booked.head[left], booked.head[right])),
    )


def _find_latest(is_new_pair: NDArray[np.bool_], end: Ints) -> Ints:
    """Return the latest end of each row and those before it of the same pair of robots."""
    ends, rank = np.unique(end, return_inverse=True)
    group = np.cumsum(is_new_pair) * len(ends)
    latest: Ints = ends[np.maximum.accumulate(rank + group) - group]
    return latest
