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

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

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
    pairs
        The pairs, in the order of i.
    i_first, j_first
        The first visit of each robot that starts later if that robot waits.
    i_vertices, j_vertices
        The vertices of each robot in it, in the order of that robot.
    """

    kind: Literal["vertex", "head-on", "following", "crossing"]
    pairs: tuple[IncompatiblePair, ...]
    i_first: int
    j_first: int
    i_vertices: tuple[VertexId, ...]
    j_vertices: tuple[VertexId, ...]

    def meetings(self) -> list[tuple[int, int]]:
        """Return (visit of i, visit of j that starts later if j waits) of all pairs."""
        return [(pair.i, pair.j_starts) for pair in self.pairs]

    def if_j_waits(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which i's ends before j's starts if j waits.

        Only those that the others do not imply, in the order of j.
        """
        return [(i, j) for j, i in _implying((pair.j_starts, pair.i) for pair in self.pairs)]

    def if_i_waits(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which j's ends before i's starts if i waits."""
        return _implying((pair.i_starts, pair.j) for pair in self.pairs)

    def ahead(self, waits: int) -> tuple[VertexId, ...]:
        """Return the vertices of the robot that goes first; 0: i waits, 1: j waits."""
        return self.j_vertices if waits == 0 else self.i_vertices


def _implying(waits: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return, of (start, end before it), those with an end that no earlier start waits for."""
    pairs: list[tuple[int, int]] = []
    for start, end in sorted(waits, key=lambda wait: (wait[0], -wait[1])):
        if not pairs or end > pairs[-1][1]:
            pairs.append((start, end))
    return pairs


def linked_segments(
    first: Route, other: Route, pairs: Iterable[IncompatiblePair]
) -> Mapping[tuple[int, int], Segment]:
    """Return the segment of each pair of incompatible visits of two robots.

    Parameters
    ----------
    first, other
        Routes of robots i and j.
    pairs
        All incompatible visits of the two.
    """
    left = {(pair.i, pair.j): pair for pair in pairs}
    segments: dict[tuple[int, int], Segment] = {}
    while left:
        _, pair = left.popitem()
        linked = [pair]
        for pair in linked:  # grows
            around = [(pair.i + di, pair.j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)]
            near = [left[at] for at in around if at in left]
            linked += [left.pop((shared.i, shared.j)) for shared in near if pair.is_linked(shared)]
        segment = _segment_of(first, other, tuple(sorted(linked)))
        segments |= dict.fromkeys(((shared.i, shared.j) for shared in linked), segment)
    return segments


def _segment_of(first: Route, other: Route, pairs: tuple[IncompatiblePair, ...]) -> Segment:
    i, j = [pair.i for pair in pairs], [pair.j for pair in pairs]
    i_first = min(pair.i_starts for pair in pairs)
    j_first = min(pair.j_starts for pair in pairs)
    together = len(pairs) * sum(a * b for a, b in zip(i, j, strict=True)) - sum(i) * sum(j)
    kind: Literal["vertex", "head-on", "following", "crossing"] = "crossing"
    if together:
        kind = "following" if together > 0 else "head-on"
    elif len(pairs) == 1 and first.vertices[i[0]] == other.vertices[j[0]]:
        kind = "vertex"
    return Segment(
        kind=kind,
        pairs=pairs,
        i_first=i_first,
        j_first=j_first,
        i_vertices=first.vertices[min(i) : max(pair.i_starts for pair in pairs) + 1],
        j_vertices=other.vertices[min(j) : max(pair.j_starts for pair in pairs) + 1],
    )


def crossing(first: Route, i: int, other: Route, j: int) -> Segment:
    """Return the segment of two visits to one vertex, and of nothing around it.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    other, j
        Route of robot j and the index of its visit, to the same vertex.
    """
    return _segment_of(first, other, (IncompatiblePair(i, j, i, j),))


def shared_segment(first: Route, i: int, other: Route, j: int) -> Segment:
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
    visits = [(i + step, j + j_step * step) for step in range(-before, after + 1)]
    return _segment_of(first, other, tuple(IncompatiblePair(a, b, a, b) for a, b in visits))


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
