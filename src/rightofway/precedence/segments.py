"""Segments: runs of vertices that two routes share in opposite directions.

Robots that meet head-on cannot pass each other anywhere in the segment, so there is only one
decision: who goes through it first. The other waits before it until the first has left it, which
is the paper's "optimum point where one robot waits until the other has passed".
"""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.model import Route, VertexId

__all__ = ["Segment", "head_on_segment"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A longest run of vertices that one robot visits in reverse order of the other.

    Attributes
    ----------
    i_first, i_last
        Indices of the first and last visit of robot i in it.
    j_first, j_last
        The same for robot j, whose first visit is where i has its last.
    vertices
        The vertices in the order of robot i; a single one is a plain meeting.
    """

    i_first: int
    i_last: int
    j_first: int
    j_last: int
    vertices: tuple[VertexId, ...]


def head_on_segment(one: Route, i: int, other: Route, j: int) -> Segment:
    """Return the longest segment around two visits to one vertex.

    Parameters
    ----------
    one, i
        Route of robot i and the index of its visit.
    other, j
        Route of robot j and the index of its visit, to the same vertex.
    """
    before = 0
    while (
        i - before > 0
        and j + before < len(other) - 1
        and one.vertices[i - before - 1] == other.vertices[j + before + 1]
    ):
        before += 1
    after = 0
    while (
        i + after < len(one) - 1
        and j - after > 0
        and one.vertices[i + after + 1] == other.vertices[j - after - 1]
    ):
        after += 1
    return Segment(
        i_first=i - before,
        i_last=i + after,
        j_first=j - after,
        j_last=j + before,
        vertices=one.vertices[i - before : i + after + 1],
    )
