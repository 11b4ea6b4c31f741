"""Visits at different places that exclude each other, because robots have sizes or share a zone.

A visit books its vertex from the start of the drive there to its leave, and the edge into it until
its enter. Where two such bookings exclude each other, the later visit starts only when the robot of
the other one has left: the vertex, or the edge, which is left when the vertex before it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model import NEVER, Problem, Track

MOST_PAIRS = 20_000_000
"""Pairs of bookings that exclude each other, at most."""

Ints = NDArray[np.int64]


class Exclusions(NamedTuple):
    """Which visits of a plan exclude each other, and their order in the plan.

    Attributes
    ----------
    first, before
        Visits that visit ``x`` waits for until they are left: ``before[first[x]:first[x + 1]]``,
        the last one of each robot; int32[N + 1] and int32[n].
    pairs
        Two visits of different robots, and as bits which of their bookings exclude each other: both
        vertices (1), the vertex of the first and the edge of the second (2), the other way round
        (4), both edges (8); int32[P, 3].
    """

    first: NDArray[np.int32]
    before: NDArray[np.int32]
    pairs: NDArray[np.int32]


class _Parts(NamedTuple):
    """Bookings of a plan, by row; each array has shape (n,)."""

    row: Ints
    visit: Ints
    robot: Ints
    is_edge: Ints
    start: Ints  # [ticks]
    end: Ints  # [ticks]


def exclusions_of(problem: Problem, tracks: Sequence[Track], drive: Ints) -> Exclusions:
    """Return the exclusions of a plan; none in a fleet of points without zones.

    Parameters
    ----------
    problem
        The scenario in ticks.
    tracks
        A plan that keeps the rules.
    drive
        Ticks of the edge into each visit; int64[N].

    Raises
    ------
    InputError
        If there are too many to be counted.
    """
    n_visits = sum(map(len, tracks))
    if problem.resources is None:
        empty = np.zeros(0, np.int32)
        return Exclusions(empty, empty, np.zeros((0, 3), np.int32))
    parts = _parts_of(problem, tracks, drive)
    one, other = _excluding(problem, parts)
    first_leaves = np.where(parts.is_edge[one] == 1, parts.visit[one] - 1, parts.visit[one])
    goes_first = parts.end[one] <= parts.start[other]
    second, robot = parts.visit[other][goes_first], parts.robot[one][goes_first]
    leaves = first_leaves[goes_first]
    order = np.lexsort((leaves, robot, second))
    second, robot, leaves = second[order], robot[order], leaves[order]
    is_last = np.append((np.diff(second) != 0) | (np.diff(robot) != 0), True)[: len(second)]
    second, leaves = second[is_last], leaves[is_last]
    return Exclusions(
        first=np.searchsorted(second, np.arange(n_visits + 1)).astype(np.int32),
        before=leaves.astype(np.int32),
        pairs=_joined(parts, one, other),
    )


def _parts_of(problem: Problem, tracks: Sequence[Track], drive: Ints) -> _Parts:
    resources = problem.resources
    assert resources is not None, "the fleet has sizes or zones"
    lengths = np.array(list(map(len, tracks)))
    vertex = np.concatenate([track.vertices for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    robot = np.repeat(np.arange(len(tracks)), lengths)
    is_last = np.zeros(len(vertex), bool)
    is_last[np.cumsum(lengths) - 1] = True
    moves = np.flatnonzero(~np.roll(is_last, 1))  # visits that a drive leads to
    base = resources.size_of[robot].astype(np.int64) * (resources.n_vertices + resources.n_edges)
    edge = problem.roadmap.edges(vertex[moves - 1], vertex[moves]).astype(np.int64)
    visit = np.arange(len(vertex))
    row = np.concatenate((base + vertex, base[moves] + resources.n_vertices + edge))
    start, leave = enter - drive, np.where(is_last, NEVER, np.roll(enter, -1))
    order = np.argsort(row, kind="stable")
    return _Parts(
        row=row[order],
        visit=np.concatenate((visit, moves))[order],
        robot=np.concatenate((robot, robot[moves]))[order],
        is_edge=np.repeat([0, 1], [len(vertex), len(moves)])[order],
        start=np.concatenate((start, start[moves]))[order],
        end=np.concatenate((leave, enter[moves]))[order],
    )


def _excluding(problem: Problem, parts: _Parts) -> tuple[Ints, Ints]:
    """Return all pairs of bookings of different robots and places that exclude each other."""
    resources = problem.resources
    assert resources is not None, "the fleet has sizes or zones"
    per_size = resources.n_vertices + resources.n_edges
    first = resources.first.astype(np.int64)
    one, place = _spread(first[parts.row], first[parts.row + 1])
    row = resources.excluded[place].astype(np.int64)
    elsewhere = parts.row[one] % per_size != row % per_size
    one, row = one[elsewhere], row[elsewhere]
    begin = np.searchsorted(parts.row, row)
    after = np.searchsorted(parts.row, row, side="right")
    if (after - begin).sum() > MOST_PAIRS:
        message = f"more than {MOST_PAIRS} pairs of visits exclude each other (take fewer robots)"
        raise InputError.at("robots", message)
    which, other = _spread(begin, after)
    strangers = parts.robot[one[which]] != parts.robot[other]
    return one[which][strangers], other[strangers]


def _spread(first: Ints, after: Ints) -> tuple[Ints, Ints]:
    """Return (k, first[k]), …, (k, after[k] - 1) for each k."""
    counts = (after - first).astype(np.int64)
    owner = np.repeat(np.arange(len(counts)), counts)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, first[owner] + rank


def _joined(parts: _Parts, one: Ints, other: Ints) -> NDArray[np.int32]:
    """Return the pairs of visits with the kinds of their bookings as bits."""
    upwards = parts.visit[one] < parts.visit[other]
    one, other = one[upwards], other[upwards]
    bits = np.left_shift(1, 2 * parts.is_edge[one] + parts.is_edge[other])
    order = np.lexsort((parts.visit[other], parts.visit[one]))
    left, right, bits = parts.visit[one][order], parts.visit[other][order], bits[order]
    begins = np.append(True, (np.diff(left) != 0) | (np.diff(right) != 0))[: len(left)]
    where = np.flatnonzero(begins)
    kinds = np.bitwise_or.reduceat(bits, where) if len(where) else bits
    return np.column_stack((left[where], right[where], kinds)).astype(np.int32)
