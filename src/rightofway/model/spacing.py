"""Long lanes split into pieces, so that several robots can drive along one of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import ceil
from typing import NamedTuple

from rightofway.errors import InputError
from rightofway.model.geometry import Point
from rightofway.model.roadmap import Edge


class SplitLanes(NamedTuple):
    """A roadmap after its long lanes were split.

    Attributes
    ----------
    positions
        Name and (x, y) of every vertex, the given ones first [length unit].
    edges
        All edges, pieces in the place of their lane.
    pieces
        Tail and head of every piece of each lane that was split, by tail and head of the lane.
    """

    positions: dict[str, Point]
    edges: list[Edge]
    pieces: dict[tuple[str, str], list[tuple[str, str]]]


def split_lanes(
    positions: Mapping[str, Point], edges: Sequence[Edge], spacing: Fraction
) -> SplitLanes:
    """Split each lane that is longer than the spacing into pieces of equal length.

    Both directions of a lane share the new vertices, which are named by the direction that is given
    first: ``A-B/1``, ``A-B/2``, ….

    Parameters
    ----------
    positions
        Name and (x, y) of every vertex [length unit].
    edges
        Directed edges; their ends are vertices.
    spacing
        The longest piece [length unit], above 0.

    Raises
    ------
    InputError
        If a vertex has the name of a new one already.

    Examples
    --------
    >>> at = {"A": (Fraction(0), Fraction(0)), "B": (Fraction(5), Fraction(0))}
    >>> split = split_lanes(at, [Edge(tail="A", head="B", length=5)], Fraction(2))
    >>> [(edge.tail, edge.head, str(edge.length)) for edge in split.edges]
    [('A', 'A-B/1', '5/3'), ('A-B/1', 'A-B/2', '5/3'), ('A-B/2', 'B', '5/3')]
    """
    longest: dict[frozenset[str], Fraction] = {}
    for edge in edges:
        lane = frozenset((edge.tail, edge.head))
        longest[lane] = max(longest.get(lane, edge.length), edge.length)
    found, split = dict(positions), list[Edge]()
    pieces: dict[tuple[str, str], list[tuple[str, str]]] = {}
    stations: dict[frozenset[str], list[str]] = {}
    for edge in edges:
        lane = frozenset((edge.tail, edge.head))
        count = ceil(longest[lane] / spacing)
        if lane not in stations:
            names = [f"{edge.tail}-{edge.head}/{k}" for k in range(1, count)]
            stations[lane] = [edge.tail, *names, edge.head]
            begin, end = positions[edge.tail], positions[edge.head]
            for k, name in enumerate(names, start=1):
                if name in found:
                    message = f"{name!r} is the name of a piece of a lane (rename the vertex)"
                    raise InputError.at("vertices", message)
                share = Fraction(k, count)
                x, y = (a + share * (b - a) for a, b in zip(begin, end, strict=True))
                found[name] = (x, y)
        way = stations[lane] if stations[lane][0] == edge.tail else stations[lane][::-1]
        if count > 1:
            pieces[edge.tail, edge.head] = list(pairwise(way))
        split += [
            replace(
                edge,
                tail=tail,
                head=head,
                length=edge.length / count,
                surcharge=edge.surcharge / count,
            )
            for tail, head in pairwise(way)
        ]
    return SplitLanes(found, split, pieces)
