"""Pairs of robots: bookings of one vertex that overlap, swaps; and robots that move in a circle."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault, FaultGroup, FaultKind
from rightofway.check.visits import Visits
from rightofway.model import Tick
from rightofway.model.sorting import order_by
from rightofway.site import VertexId

Indices = NDArray[np.int64]

FEWEST = 3
"""Robots of a rotation; two make a swap."""

CHUNK = 2**20
"""About how many pairs are made together."""


def _list_pairs(first: Indices, after: Indices) -> Iterator[tuple[Indices, Indices]]:
    """Yield all (i, j) with ``first[i] <= j < after[i]``, some at a time."""
    counts = np.maximum(after - first, 0)
    totals = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        before = totals[begin] - counts[begin]
        end = max(int(np.searchsorted(totals, before + CHUNK)), begin + 1)
        group_sizes = counts[begin:end]
        i = np.repeat(np.arange(begin, end), group_sizes)
        rank = np.arange(len(i)) - np.repeat(totals[begin:end] - group_sizes - before, group_sizes)
        yield i, first[i] + rank
        begin = end


def judge_bookings(visits: Visits) -> Iterator[FaultGroup]:
    """Find vertex conflicts, and those that only the headway makes."""
    headway = visits.scenario.problem.booking_rules.headway
    crowded = _find_crowded(visits.place, visits.vertex_start, visits.vertex_end + headway)
    robot, vertex, last = visits.robot[crowded], visits.vertex[crowded], visits.last[crowded]
    start, leave = visits.vertex_start[crowded], visits.vertex_end[crowded]

    def describe_conflict(first: int, second: int) -> Mapping[str, Any]:
        """Return both bookings; the last visit of a robot has no end."""
        begins = {"begin": int(start[first]), "other_begin": int(start[second])}
        ends = (None if last[booking] else int(leave[booking]) for booking in (first, second))
        return begins | dict(zip(("end", "other_end"), ends, strict=True))

    def describe_headway(first: int, second: int) -> Mapping[str, Any]:
        return {
            "moment": int(start[second]),
            "time": int(start[second] - leave[first]),
            "headway": int(headway),
            "earliest": int(leave[first] + headway),
        }

    def group(
        kind: FaultKind,
        first: Indices,
        second: Indices,
        describe: Callable[[int, int], Mapping[str, Any]],
    ) -> FaultGroup:
        def fault(position: int) -> Fault:
            pair = int(first[position]), int(second[position])
            in_order = [int(robot[booking]) for booking in pair]
            return Fault(
                kind=kind,
                robots=tuple(sorted(in_order)),
                vertices=(VertexId(int(vertex[pair[0]])),),
                tick=Tick(int(start[pair[1]])),
                numbers={"one": in_order[0], "other": in_order[1], **describe(*pair)},
                scenario=visits.scenario,
            )

        ends = robot[first], robot[second]
        robots = np.minimum(*ends), np.maximum(*ends)
        return FaultGroup(kind, start[second], robots, fault)

    after = _count_begun(visits.place[crowded], start, leave + headway)
    for first, second in _list_pairs(np.arange(len(start)) + 1, after):
        strangers = robot[first] != robot[second]
        at_once = start[second] < leave[first]
        conflicts, too_soons = strangers & at_once, strangers & ~at_once
        yield group("vertex conflict", first[conflicts], second[conflicts], describe_conflict)
        yield group("headway", first[too_soons], second[too_soons], describe_headway)


def _find_crowded(vertex: Indices, start: NDArray[Any], end: NDArray[Any]) -> Indices:
    """Return the bookings of vertices where any overlap, by vertex and start.

    Two neighbours in that order overlap then. A booking of no duration overlaps none.
    """
    order = order_by(vertex, start)
    order = order[start[order] < end[order]]
    vertex, start, end = vertex[order], start[order], end[order]
    overlap = (vertex[1:] == vertex[:-1]) & (start[1:] < end[:-1])
    return order[np.isin(vertex, vertex[1:][overlap])]


def _count_begun(vertex: Indices, start: NDArray[Any], end: NDArray[Any]) -> Indices:
    """Return, for each booking, the index after the last one that starts before it ends."""
    count = len(start)
    # At one tick, ends come before starts.
    order = order_by(np.concatenate((vertex, vertex)), np.concatenate((end, start)))
    is_start = order >= count
    begun = np.empty(count, np.int64)
    begun[order[~is_start]] = np.cumsum(is_start)[~is_start]
    return begun


def judge_swaps(visits: Visits) -> Iterator[FaultGroup]:
    """Find pairs of robots that exchange two vertices."""

    def fault(first: Indices, second: Indices, position: int) -> Fault:
        moves = int(first[position]), int(second[position])
        return Fault(
            kind="swap conflict",
            robots=tuple(int(visits.robot[move]) for move in moves),
            vertices=tuple(VertexId(int(visits.vertex[move])) for move in moves),
            tick=Tick(int(visits.leave[moves[0]])),
            scenario=visits.scenario,
        )

    move, begin, after = _find_opposite(visits)
    for i, j in _list_pairs(begin, after):
        # Moves are numbered robot by robot, so that the smaller one has the smaller robot.
        first, second = np.minimum(move[i], move[j]), np.maximum(move[i], move[j])
        strangers = visits.robot[first] != visits.robot[second]
        first, second = first[strangers], second[strangers]
        robots = visits.robot[first], visits.robot[second]
        yield FaultGroup(
            "swap conflict", visits.leave[first], robots, partial(fault, first, second)
        )


def _find_moves(visits: Visits) -> Indices:
    """Return the visits that end by moving from one vertex of the roadmap to another."""
    head = np.roll(visits.vertex, -1)
    known = visits.known & np.roll(visits.known, -1)
    return np.flatnonzero(~visits.last & known & (visits.vertex != head))


def _find_opposite(visits: Visits) -> tuple[Indices, Indices, Indices]:
    """Return moves in an order in which the moves opposite to move i are begin[i] to after[i].

    Each pair comes up once: moves to a smaller vertex have an empty range. Nearly all moves are
    alone between their vertices at their instant; these are left out. Moves are sorted by few
    columns before the exact order is made of the rest.
    """
    move = _find_moves(visits)
    low = np.minimum(visits.vertex[move], visits.vertex[move + 1])
    order = order_by(low, visits.leave[move])
    move, low = move[order], low[order]
    maybe, _ = _mark_alike(low, visits.leave[move])
    move, low = move[maybe], low[maybe]
    tail, head, leave = visits.vertex[move], visits.vertex[move + 1], visits.leave[move]
    columns = (low, np.maximum(tail, head), leave)
    order = order_by(*columns, tail < head)  # in a group, moves to a smaller vertex come first
    shared, begins = _mark_alike(*(column[order] for column in columns))
    upwards = (tail < head)[order][shared]
    group = np.cumsum(begins[shared]) - 1
    begin = np.flatnonzero(begins[shared])
    after = begin + np.bincount(group, weights=~upwards).astype(np.int64)
    return move[order][shared], begin[group], np.where(upwards, after[group], begin[group])


def _mark_alike(*columns: NDArray[Any]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which rows equal a neighbour, and which rows begin a group of equal rows."""
    as_before = np.zeros(len(columns[0]) + 1, bool)
    as_before[1:-1] = np.logical_and.reduce([column[1:] == column[:-1] for column in columns])
    return as_before[:-1] | as_before[1:], ~as_before[:-1]


def judge_rotations(visits: Visits) -> Iterator[Fault]:
    """Find circles of three or more robots that move at one instant, where rules forbid them.

    Where robots leave one vertex together, which is a vertex conflict, the first is followed.
    """
    if visits.scenario.rules.rotations:
        return
    heads: dict[Tick, dict[int, int]] = defaultdict(dict)
    robots: dict[tuple[Tick, int], int] = {}  # the one that leaves a vertex at a tick
    for visit in _find_moves(visits).tolist():
        tail, head = int(visits.vertex[visit]), int(visits.vertex[visit + 1])
        tick = Tick(int(visits.leave[visit]))
        heads[tick].setdefault(tail, head)
        robots.setdefault((tick, tail), int(visits.robot[visit]))
    for tick, head_of in heads.items():
        for circle in _find_circles(head_of):
            moving = [robots[tick, vertex] for vertex in circle]
            yield Fault(
                kind="rotation",
                robots=tuple(sorted(moving)),
                vertices=tuple(map(VertexId, circle)),
                tick=tick,
                numbers={"moving": moving},
                scenario=visits.scenario,
            )


def _find_circles(head_of: Mapping[int, int]) -> Iterator[list[int]]:
    """Yield the circles of three or more vertices, each from the first vertex found of it."""
    reached: dict[int, int] = {}  # the start of the walk that reached a vertex first
    for start in head_of:
        vertex, path = start, []
        while vertex in head_of and vertex not in reached:
            reached[vertex] = start
            path.append(vertex)
            vertex = head_of[vertex]
        circle = path[path.index(vertex) :] if reached.get(vertex) == start else []
        if len(circle) >= FEWEST:
            yield circle
