"""Segments: where two routes run together, so that one decision holds for all of it.

Robots that meet head-on cannot pass each other anywhere in the segment, so the only question is
who goes through it first. The other waits before it until the first has left it, which is the
paper's "optimum point where one robot waits until the other has passed". Robots that go the same
way cannot overtake each other either: who enters first stays ahead, and the other follows it from
vertex to vertex.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rightofway.model import Route, VertexId


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
