"""Segments: where two routes run together, so that one decision holds for all of it.

Robots that meet head-on cannot pass each other anywhere in the segment, so the only question is
who goes through it first. The other waits before it until the first has left it, which is the
paper's "optimum point where one robot waits until the other has passed". Robots that go the same
way cannot overtake each other either: who enters first stays ahead, and the other follows it from
vertex to vertex.

A segment is a set of pairs of visits. For points it is a longest run of vertices that both robots
visit in one order, or in reverse order. Robots with a size also meet where their visits are at
different vertices: on lanes side by side, and where lanes cross. Two pairs of incompatible visits
of two robots are *linked* if no timetable orders them differently; a segment is then a largest set
of linked pairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from operator import mul, neg
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Route
from rightofway.site import VertexId


class IncompatiblePair(NamedTuple):
    """Visits of two robots i and j that exclude each other; all are indices in the two routes.

    ``i_starts`` and ``j_starts`` are the visits whose start counts: the visit itself, or the next
    one if only the edge that leads there is too near.
    """

    i: int
    j: int
    i_starts: int
    j_starts: int

    def is_linked(self, other: IncompatiblePair) -> bool:
        """Return whether one robot goes first in both pairs, whatever the timetable.

        If i went first here and j there, then j would start here no sooner than i has left, and i
        would start there no sooner than j has left; each would wait for the other.
        """
        i_then_j = self.j_starts <= other.j + 1 and other.i_starts <= self.i + 1
        j_then_i = self.i_starts <= other.i + 1 and other.j_starts <= self.j + 1
        return i_then_j and j_then_i


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """Linked pairs of visits of two robots: one of them goes first in all.

    Attributes
    ----------
    kind
        ``following`` if later visits of i meet later visits of j, ``head-on`` if they meet earlier
        ones, ``vertex`` if both robots just visit one vertex, else ``crossing``.
    i, j, i_starts, j_starts
        The pairs in the order of i, each number of an `IncompatiblePair` by itself: a run of
        vertices is a few ranges.
    i_first, j_first
        The first visit of each robot that starts later if that robot waits.
    i_vertices, j_vertices
        The vertices of each robot in it, in the order of that robot.
    """

    kind: Literal["vertex", "head-on", "following", "crossing"]
    i: Sequence[int]
    j: Sequence[int]
    i_starts: Sequence[int]
    j_starts: Sequence[int]
    i_first: int
    j_first: int
    i_vertices: tuple[VertexId, ...]
    j_vertices: tuple[VertexId, ...]

    @property
    def pairs(self) -> tuple[IncompatiblePair, ...]:
        """The pairs of visits, in the order of i."""
        return tuple(map(IncompatiblePair, self.i, self.j, self.i_starts, self.j_starts))

    def list_meetings(self) -> list[tuple[int, int]]:
        """Return (visit of i, visit of j that starts later if j waits) of all pairs."""
        return list(zip(self.i, self.j_starts, strict=True))

    def list_rights_of_i(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which i's ends before j's starts if j waits.

        Only those that the others do not imply, in the order of j.
        """
        return [
            (i, j) for j, i in _list_implying(zip(self.j_starts, map(neg, self.i), strict=True))
        ]

    def list_rights_of_j(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which j's ends before i's starts if i waits."""
        return _list_implying(zip(self.i_starts, map(neg, self.j), strict=True))

    def list_vertices_ahead(self, waits: int) -> tuple[VertexId, ...]:
        """Return the vertices of the robot that goes first; 0: i waits, 1: j waits."""
        return self.j_vertices if waits == 0 else self.i_vertices


def _list_implying(waits: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return (start, end before it) of those pairs whose end no earlier start waits for.

    Given are pairs (start, minus the end), so that sorting puts the latest end of a start first.
    """
    implying: list[tuple[int, int]] = []
    latest = -1
    for start, minus_end in sorted(waits):
        if -minus_end > latest:
            latest = -minus_end
            implying.append((start, latest))
    return implying


class LinkedSegments:
    """The segments of two robots, each linked when it is first asked for.

    A graph asks for few of them: most pairs of visits of a plan are never in conflict. So the pairs
    stay the rows of an array, shape (n, 4), in the order of an `IncompatiblePair`.
    """

    def __init__(self, first: Route, other: Route, pairs: NDArray[np.int32]) -> None:
        self._first, self._other = first, other
        self._pairs = pairs
        visits = zip(pairs[:, 0].tolist(), pairs[:, 1].tolist(), strict=True)
        self._rows = {visit: row for row, visit in enumerate(visits)}
        self._segments: dict[tuple[int, int], Segment] = {}

    def find(self, i: int, j: int) -> Segment | None:
        """Return the segment of two visits, None where they do not exclude each other."""
        segment = self._segments.get((i, j))
        if segment is None and (i, j) in self._rows:
            segment = self._connect(self._make_pair(i, j))
        return segment

    def _make_pair(self, i: int, j: int) -> IncompatiblePair:
        return IncompatiblePair._make(self._pairs[self._rows[i, j]].tolist())

    def _connect(self, pair: IncompatiblePair) -> Segment:
        linked, seen = [pair], {(pair.i, pair.j)}
        for reached in linked:  # grows
            i, j = reached.i, reached.j
            around = [(i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)]
            near = [self._make_pair(*at) for at in around if at in self._rows and at not in seen]
            new = [other for other in near if reached.is_linked(other)]
            seen.update((other.i, other.j) for other in new)
            linked += new
        columns = tuple(zip(*sorted(linked), strict=True))
        segment = _make_segment(self._first, self._other, columns)
        self._segments |= dict.fromkeys(seen, segment)
        return segment


def _make_segment(first: Route, other: Route, columns: tuple[Sequence[int], ...]) -> Segment:
    i, j, i_starts, j_starts = columns
    together = len(i) * sum(map(mul, i, j)) - sum(i) * sum(j)  # above 0: i and j rise together
    kind: Literal["vertex", "head-on", "following", "crossing"] = "crossing"
    if together:
        kind = "following" if together > 0 else "head-on"
    elif len(i) == 1 and first.vertices[i[0]] == other.vertices[j[0]]:
        kind = "vertex"
    return Segment(
        kind=kind,
        i=i,
        j=j,
        i_starts=i_starts,
        j_starts=j_starts,
        i_first=min(i_starts),
        j_first=min(j_starts),
        i_vertices=first.vertices[min(i) : max(i_starts) + 1],
        j_vertices=other.vertices[min(j) : max(j_starts) + 1],
    )


def make_crossing(first: Route, i: int, other: Route, j: int) -> Segment:
    """Return the segment of two visits to one vertex, without neighbouring visits.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    other, j
        Route of robot j and the index of its visit, to the same vertex.
    """
    return _make_segment(first, other, ((i,), (j,), (i,), (j,)))


def find_shared_segment(first: Route, i: int, other: Route, j: int) -> Segment:
    """Return the longest run of vertices around two visits; head-on if it could be both.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    other, j
        Route of robot j and the index of its visit, to the same vertex.
    """
    j_step = -1
    before = _run(first, i, other, j, i_step=-1, j_step=1)
    after = _run(first, i, other, j, i_step=1, j_step=-1)
    if not before + after:
        j_step = 1
        before = _run(first, i, other, j, i_step=-1, j_step=-1)
        after = _run(first, i, other, j, i_step=1, j_step=1)
    i_visits = range(i - before, i + after + 1)
    j_visits = range(j - j_step * before, j + j_step * (after + 1), j_step)
    return _make_segment(first, other, (i_visits, j_visits, i_visits, j_visits))


def _run(first: Route, i: int, other: Route, j: int, *, i_step: int, j_step: int) -> int:
    """Return how many visits further both routes go on together in these directions."""
    length = 0
    while (
        0 <= i + i_step < len(first)
        and 0 <= j + j_step < len(other)
        and first.vertices[i + i_step] == other.vertices[j + j_step]
    ):
        i, j, length = i + i_step, j + j_step, length + 1
    return length
