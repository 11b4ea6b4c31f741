"""Pairs of robots: bookings of one vertex that overlap, swaps; and robots that move in a circle."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault, FaultCollector, Names, ticks
from rightofway.check.visits import Visits
from rightofway.model import Plan, Tick, VertexId
from rightofway.model.sorting import order_by

__all__ = ["judge_bookings", "judge_rotations", "judge_swaps"]

Indices = NDArray[np.int64]

FEWEST = 3
"""Robots of a rotation; two make a swap."""

CHUNK = 2**20
"""About how many pairs are made together."""


def _pairs(first: Indices, after: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield all (i, j) with ``first[i] <= j < after[i]``, some at a time."""
    counts = np.maximum(after - first, 0)
    totals = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        before = totals[begin] - counts[begin]
        end = max(int(np.searchsorted(totals, before + CHUNK)), begin + 1)
        here = counts[begin:end]
        i = np.repeat(np.arange(begin, end), here)
        rank = np.arange(len(i)) - np.repeat(totals[begin:end] - here - before, here)
        yield i, first[i] + rank
        begin = end


def judge_bookings(plan: Plan, visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find vertex conflicts, and those that only the headway makes."""
    headway = plan.scenario.problem.headway
    approaches = plan.scenario.rules.occupancy == "both"
    bookings = _crowded_only(_bookings(visits, headway, approaches=approaches))
    judgement = _Overlaps(bookings, headway, names, collector)
    for one, other in _pairs(np.arange(len(bookings.start)) + 1, _begun(bookings)):
        strangers = bookings.robot[one] != bookings.robot[other]
        at_once = bookings.start[other] < bookings.leave[one]
        conflict, too_soon = strangers & at_once, strangers & ~at_once
        judgement.report("vertex conflict", one[conflict], other[conflict])
        judgement.report("headway", one[too_soon], other[too_soon])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Bookings:
    """Bookings from `start` to `end`, the headway after `leave` included."""

    robot: NDArray[np.int64]
    vertex: NDArray[np.int64]
    start: NDArray[Any]
    leave: NDArray[Any]
    end: NDArray[Any]
    last: NDArray[np.bool_]

    def only(self, which: NDArray[Any]) -> _Bookings:
        return _Bookings(
            robot=self.robot[which],
            vertex=self.vertex[which],
            start=self.start[which],
            leave=self.leave[which],
            end=self.end[which],
            last=self.last[which],
        )


def _bookings(visits: Visits, headway: int, *, approaches: bool) -> _Bookings:
    start = visits.enter
    if approaches:  # 0 for a first visit: the last visit before it has no drive
        start = start - np.roll(visits.drive, 1)
    return _Bookings(
        robot=visits.robot,
        vertex=visits.vertex,
        start=start,
        leave=visits.leave,
        end=visits.leave + headway,
        last=visits.last,
    )


def _crowded_only(bookings: _Bookings) -> _Bookings:
    """Return the bookings of vertices where any overlap, by vertex and start.

    Two neighbours in that order overlap then. A booking that does not last at all meets nobody.
    """
    order = order_by(bookings.vertex, bookings.start)
    order = order[bookings.start[order] < bookings.end[order]]
    vertex, start, end = bookings.vertex[order], bookings.start[order], bookings.end[order]
    overlap = (vertex[1:] == vertex[:-1]) & (start[1:] < end[:-1])
    return bookings.only(order[np.isin(vertex, vertex[1:][overlap])])


def _begun(bookings: _Bookings) -> Indices:
    """Return, for each booking, the index after the last one that starts before it ends."""
    count = len(bookings.start)
    times = np.concatenate((bookings.end, bookings.start))
    places = np.concatenate((bookings.vertex, bookings.vertex))
    order = order_by(places, times)  # at one tick, ends come before starts
    is_start = order >= count
    begun = np.empty(count, np.int64)
    begun[order[~is_start]] = np.cumsum(is_start)[~is_start]
    return begun


class _Overlaps:
    """Reports pairs of bookings that overlap; `one` starts first."""

    def __init__(
        self, bookings: _Bookings, headway: int, names: Names, collector: FaultCollector
    ) -> None:
        self._bookings, self._headway = bookings, headway
        self._names, self._collector = names, collector

    def report(
        self, kind: Literal["vertex conflict", "headway"], one: Indices, other: Indices
    ) -> None:
        bookings = self._bookings
        message = self._conflict if kind == "vertex conflict" else self._too_soon

        def fault(position: int) -> Fault:
            pair = int(one[position]), int(other[position])
            return Fault(
                kind=kind,
                robots=tuple(sorted(int(bookings.robot[booking]) for booking in pair)),
                vertices=(VertexId(int(bookings.vertex[pair[0]])),),
                tick=Tick(int(bookings.start[pair[1]])),
                message=message(*pair),
            )

        ends = bookings.robot[one], bookings.robot[other]
        robots = np.minimum(*ends), np.maximum(*ends)
        self._collector.add_all(kind, bookings.start[other], robots, fault)

    def _conflict(self, one: int, other: int) -> str:
        return (
            f"{self._name(one)} books {self._vertex(one)} {self._interval(one)} and"
            f" {self._name(other)} {self._interval(other)} (let one come when the other has left)"
        )

    def _too_soon(self, one: int, other: int) -> str:
        bookings = self._bookings
        gap = bookings.start[other] - bookings.leave[one]
        return (
            f"{self._name(other)} comes to {self._vertex(one)} at tick {bookings.start[other]},"
            f" {ticks(gap)} after {self._name(one)} left, the headway is {self._headway}"
            f" (come at tick {bookings.end[one]} or later)"
        )

    def _name(self, booking: int) -> str:
        return self._names.robot(int(self._bookings.robot[booking]))

    def _vertex(self, booking: int) -> str:
        return self._names.vertex(int(self._bookings.vertex[booking]))

    def _interval(self, booking: int) -> str:
        bookings = self._bookings
        until = "for ever" if bookings.last[booking] else f"to {bookings.leave[booking]}"
        return f"from tick {bookings.start[booking]} {until}"


def judge_swaps(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find pairs of robots that exchange two vertices."""
    move, begin, after = _opposite(visits)
    for i, j in _pairs(begin, after):
        # Moves are numbered robot by robot, so that the smaller one has the smaller robot.
        one, other = np.minimum(move[i], move[j]), np.maximum(move[i], move[j])
        strangers = visits.robot[one] != visits.robot[other]
        _take_swaps(one[strangers], other[strangers], visits, names, collector)


def _moves(visits: Visits) -> Indices:
    """Return the visits that end by moving from one vertex of the roadmap to another."""
    head = np.roll(visits.vertex, -1)
    known = visits.known & np.roll(visits.known, -1)
    return np.flatnonzero(~visits.last & known & (visits.vertex != head))


def _opposite(visits: Visits) -> tuple[Indices, Indices, Indices]:
    """Return moves in an order in which the moves opposite to move i are begin[i] to after[i].

    Each pair comes up once: moves to a smaller vertex have an empty range.
    """
    move, new_group = _at_once(visits)
    group = np.cumsum(new_group) - 1
    upwards = visits.vertex[move] < visits.vertex[move + 1]
    begin = np.flatnonzero(new_group)
    after = begin + np.bincount(group, weights=~upwards).astype(np.int64)
    return move, begin[group], np.where(upwards, after[group], begin[group])


def _at_once(visits: Visits) -> tuple[Indices, NDArray[np.bool_]]:
    """Return moves between the same two vertices at one instant, and where each group begins.

    In a group, moves to a smaller vertex come first. Nearly all moves are alone in their group;
    these are left out. Rows are sorted by few columns before the exact order is made of the rest.
    """
    move = _moves(visits)
    low = np.minimum(visits.vertex[move], visits.vertex[move + 1])
    order = order_by(low, visits.leave[move])
    move, low = move[order], low[order]
    leave = visits.leave[move]
    maybe, _ = _alike(low, leave)
    move, low, leave = move[maybe], low[maybe], leave[maybe]
    tail, head = visits.vertex[move], visits.vertex[move + 1]
    high = np.maximum(tail, head)
    order = order_by(low, high, leave, tail < head)
    move, low, high, leave = move[order], low[order], high[order], leave[order]
    shared, begins = _alike(low, high, leave)
    return move[shared], begins[shared]


def _alike(*columns: NDArray[Any]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which rows equal a neighbour, and which rows begin a group of equal rows."""
    as_before = np.zeros(len(columns[0]) + 1, bool)
    as_before[1:-1] = np.logical_and.reduce([column[1:] == column[:-1] for column in columns])
    return as_before[:-1] | as_before[1:], ~as_before[:-1]


def _take_swaps(
    one: Indices, other: Indices, visits: Visits, names: Names, collector: FaultCollector
) -> None:
    def fault(position: int) -> Fault:
        moves = int(one[position]), int(other[position])
        robots = tuple(int(visits.robot[move]) for move in moves)
        vertices = tuple(VertexId(int(visits.vertex[move])) for move in moves)
        who = " and ".join(map(names.robot, robots))
        where = " and ".join(map(names.vertex, vertices))
        return Fault(
            kind="swap conflict",
            robots=robots,
            vertices=vertices,
            tick=Tick(int(visits.leave[moves[0]])),
            message=f"{who} exchange {where} (let one wait aside until the other is by)",
        )

    robots = visits.robot[one], visits.robot[other]
    collector.add_all("swap conflict", visits.leave[one], robots, fault)


class _Move(NamedTuple):
    robot: int
    head: int


def judge_rotations(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find circles of three or more robots that move at one instant.

    Where robots leave one vertex together, which is a vertex conflict, the first is followed.
    """
    moves: dict[Tick, dict[int, _Move]] = defaultdict(dict)
    for visit in _moves(visits).tolist():
        tail, head = int(visits.vertex[visit]), int(visits.vertex[visit + 1])
        robot, tick = int(visits.robot[visit]), Tick(int(visits.leave[visit]))
        moves[tick].setdefault(tail, _Move(robot, head))
    for tick, leaving in moves.items():
        for circle in _circles(leaving):
            collector.add(_rotation(tick, circle, leaving, names))


def _circles(leaving: Mapping[int, _Move]) -> Iterator[list[int]]:
    """Yield the circles of three or more vertices, each from the first vertex found of it."""
    reached: dict[int, int] = {}  # the start of the walk that reached a vertex first
    for start in leaving:
        vertex, path = start, []
        while vertex in leaving and vertex not in reached:
            reached[vertex] = start
            path.append(vertex)
            vertex = leaving[vertex].head
        circle = path[path.index(vertex) :] if reached.get(vertex) == start else []
        if len(circle) >= FEWEST:
            yield circle


def _rotation(tick: Tick, circle: list[int], leaving: Mapping[int, _Move], names: Names) -> Fault:
    robots = [leaving[vertex].robot for vertex in circle]
    who = ", ".join(map(names.robot, robots))
    places = ", ".join(map(names.vertex, circle))
    return Fault(
        kind="rotation",
        robots=tuple(sorted(robots)),
        vertices=tuple(map(VertexId, circle)),
        tick=tick,
        message=f"{who} move round {places} at once (let one wait until its place is empty)",
    )
