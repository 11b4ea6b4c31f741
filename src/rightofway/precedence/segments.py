"""Segments: where two routes run together, so that one decision holds for all of it.

Robots that meet head-on cannot pass each other anywhere in the segment, so the only question is
who goes through it first. The other waits before it until the first has left it, which is the
paper's "optimum point where one robot waits until the other has passed". Robots that go the same
way cannot overtake each other either: who enters first stays ahead, and the other follows it from
vertex to vertex.

Robots with a size also meet where their visits are at different vertices: on lanes side by side,
and where lanes cross. Two pairs of incompatible visits of two robots are *linked* if no timetable
orders them differently. A segment is then a largest set of linked pairs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

from rightofway.model import Route
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A longest run of vertices that two robots visit in the same or in reverse order.

    Attributes
    ----------
    kind
        ``head-on`` (in reverse order), ``following`` (in the same) or ``vertex`` (just one).
    i_first, i_last
        Indices of the first and last visit of robot i in it.
    j_first, j_last
        The same for robot j; if head-on, its first visit is where i has its last.
    vertices
        The vertices in the order of robot i.
    """

    kind: Literal["vertex", "head-on", "following"]
    i_first: int
    i_last: int
    j_first: int
    j_last: int
    vertices: tuple[VertexId, ...]

    def meetings(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) to each vertex, in the order of i."""
        i, j = range(self.i_first, self.i_last + 1), range(self.j_first, self.j_last + 1)
        return list(zip(i, reversed(j) if self.kind == "head-on" else j, strict=True))

    def if_j_waits(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which i's goes first if j waits.

        Head-on, i's last and j's first visit say it all: the rest follows.
        """
        return self.meetings() if self.kind == "following" else [(self.i_last, self.j_first)]

    def if_i_waits(self) -> list[tuple[int, int]]:
        """Return the visits (of i, of j) of which j's goes first if i waits."""
        return self.meetings() if self.kind == "following" else [(self.i_first, self.j_last)]

    def ahead(self, waits: int) -> tuple[VertexId, ...]:
        """Return the vertices in the order of the robot that goes first; 0: i waits, 1: j waits."""
        return self.vertices[::-1] if waits == 0 and self.kind == "head-on" else self.vertices


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
class SegmentOfSizes:
    """A largest set of linked pairs of visits of two robots with a size.

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
    found: list[tuple[int, int]] = []
    for start, end in sorted(waits, key=lambda wait: (wait[0], -wait[1])):
        if not found or end > found[-1][1]:
            found.append((start, end))
    return found


def segments_of_sizes(
    one: Route, other: Route, pairs: Iterable[IncompatiblePair]
) -> Mapping[tuple[int, int], SegmentOfSizes]:
    """Return the segment of each pair of incompatible visits of two robots.

    Parameters
    ----------
    one, other
        Routes of robots i and j.
    pairs
        All incompatible visits of the two.
    """
    left = {(pair.i, pair.j): pair for pair in pairs}
    found: dict[tuple[int, int], SegmentOfSizes] = {}
    while left:
        _, pair = left.popitem()
        linked = [pair]
        for pair in linked:  # grows
            around = [(pair.i + di, pair.j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)]
            near = [left[at] for at in around if at in left]
            linked += [left.pop((each.i, each.j)) for each in near if pair.is_linked(each)]
        segment = _segment_of(one, other, tuple(sorted(linked)))
        found |= dict.fromkeys(((each.i, each.j) for each in linked), segment)
    return found


def _segment_of(one: Route, other: Route, pairs: tuple[IncompatiblePair, ...]) -> SegmentOfSizes:
    i, j = [pair.i for pair in pairs], [pair.j for pair in pairs]
    i_first = min(pair.i_starts for pair in pairs)
    j_first = min(pair.j_starts for pair in pairs)
    together = len(pairs) * sum(a * b for a, b in zip(i, j, strict=True)) - sum(i) * sum(j)
    kind: Literal["vertex", "head-on", "following", "crossing"] = "crossing"
    if together:
        kind = "following" if together > 0 else "head-on"
    elif len(pairs) == 1 and one.vertices[i[0]] == other.vertices[j[0]]:
        kind = "vertex"
    return SegmentOfSizes(
        kind=kind,
        pairs=pairs,
        i_first=i_first,
        j_first=j_first,
        i_vertices=one.vertices[min(i) : max(pair.i_starts for pair in pairs) + 1],
        j_vertices=other.vertices[min(j) : max(pair.j_starts for pair in pairs) + 1],
    )


def crossing(one: Route, i: int, j: int) -> Segment:
    """Return the segment of two visits to one vertex, and of nothing around it.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    j
        Index of the visit of robot j to the same vertex.
    """
    here = (one.vertices[i],)
    return Segment(kind="vertex", i_first=i, i_last=i, j_first=j, j_last=j, vertices=here)


def shared_segment(one: Route, i: int, other: Route, j: int) -> Segment:
    """Return the longest segment around two visits to one vertex; head-on if it could be both.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    other, j
        Route of robot j and the index of its visit, to the same vertex.
    """
    before = _run(one, i, other, j, i_step=-1, j_step=1)
    after = _run(one, i, other, j, i_step=1, j_step=-1)
    kind: Literal["head-on", "following"] = "head-on"
    j_first, j_last = j - after, j + before
    if not before + after:
        before = _run(one, i, other, j, i_step=-1, j_step=-1)
        after = _run(one, i, other, j, i_step=1, j_step=1)
        kind, j_first, j_last = "following", j - before, j + after
    if before + after:
        return Segment(
            kind=kind,
            i_first=i - before,
            i_last=i + after,
            j_first=j_first,
            j_last=j_last,
            vertices=one.vertices[i - before : i + after + 1],
        )
    return crossing(one, i, j)


def _run(one: Route, i: int, other: Route, j: int, *, i_step: int, j_step: int) -> int:
    """Return how many visits further both routes go on together in these directions."""
    length = 0
    while (
        0 <= i + i_step < len(one)
        and 0 <= j + j_step < len(other)
        and one.vertices[i + i_step] == other.vertices[j + j_step]
    ):
        i, j, length = i + i_step, j + j_step, length + 1
    return length
