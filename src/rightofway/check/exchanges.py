"""Robots that move at one instant into the vertices they leave: swaps and rotations."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.check.pairs import Indices, pairs
from rightofway.check.report import Fault
from rightofway.check.sieve import Sieve
from rightofway.check.visits import Visits
from rightofway.check.words import Words
from rightofway.model import Tick, VertexId
from rightofway.model.sorting import order_by

__all__ = ["judge_rotations", "judge_swaps"]

FEWEST = 3
"""Robots of a rotation; two make a swap."""


def judge_swaps(visits: Visits, words: Words, sieve: Sieve) -> None:
    """Find pairs of robots that exchange two vertices."""
    move, begin, after = _opposite(visits)
    for i, j in pairs(begin, after):
        # Moves are numbered robot by robot, so that the smaller one has the smaller robot.
        one, other = np.minimum(move[i], move[j]), np.maximum(move[i], move[j])
        strangers = visits.robot[one] != visits.robot[other]
        _take_swaps(one[strangers], other[strangers], visits, words, sieve)


def _moves(visits: Visits) -> Indices:
    """Return the visits that end by moving from one vertex of the roadmap to another."""
    head = np.roll(visits.vertex, -1)
    known = visits.known & np.roll(visits.known, -1)
    return np.flatnonzero(~visits.last & known & (visits.vertex != head))


def _opposite(visits: Visits) -> tuple[Indices, Indices, Indices]:
    """Return moves so sorted that, for move i, those opposite to it are begin[i] to after[i].

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

    In a group, moves to a smaller vertex come first. Moves that are alone are left out: they are
    nearly all.
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


def _take_swaps(one: Indices, other: Indices, visits: Visits, words: Words, sieve: Sieve) -> None:
    def fault(position: int) -> Fault:
        moves = int(one[position]), int(other[position])
        robots = tuple(int(visits.robot[move]) for move in moves)
        vertices = tuple(VertexId(int(visits.vertex[move])) for move in moves)
        who = " and ".join(map(words.robot, robots))
        where = " and ".join(map(words.vertex, vertices))
        return Fault(
            kind="swap conflict",
            robots=robots,
            vertices=vertices,
            tick=Tick(int(visits.leave[moves[0]])),
            message=f"{who} exchange {where} (let one wait aside until the other is by)",
        )

    robots = visits.robot[one], visits.robot[other]
    sieve.add_all("swap conflict", visits.leave[one], robots, fault)


class _Move(NamedTuple):
    robot: int
    head: int


def judge_rotations(visits: Visits, words: Words, sieve: Sieve) -> None:
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
            sieve.add(_rotation(tick, circle, leaving, words))


def _circles(leaving: Mapping[int, _Move]) -> Iterator[list[int]]:
    """Yield the circles of three or more vertices, each from the vertex where it is come upon."""
    reached: dict[int, int] = {}  # vertex: where the walk began that came by first
    for start in leaving:
        vertex, path = start, []
        while vertex in leaving and vertex not in reached:
            reached[vertex] = start
            path.append(vertex)
            vertex = leaving[vertex].head
        circle = path[path.index(vertex) :] if reached.get(vertex) == start else []
        if len(circle) >= FEWEST:
            yield circle


def _rotation(tick: Tick, circle: list[int], leaving: Mapping[int, _Move], words: Words) -> Fault:
    robots = [leaving[vertex].robot for vertex in circle]
    names = ", ".join(map(words.robot, robots))
    places = ", ".join(map(words.vertex, circle))
    return Fault(
        kind="rotation",
        robots=tuple(sorted(robots)),
        vertices=tuple(map(VertexId, circle)),
        tick=tick,
        message=f"{names} move round {places} at once (let one wait until its place is empty)",
    )
