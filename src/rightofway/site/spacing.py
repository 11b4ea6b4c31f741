"""Long lanes split into pieces, so that several robots can drive along one of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from math import ceil, dist, sqrt
from typing import NamedTuple

import numpy as np

from rightofway.deadline import limit_loop
from rightofway.errors import InputError, quote
from rightofway.quantities import format_decimal
from rightofway.site.crossings import MOST_PIECES, choose_spacing, find_crossed
from rightofway.site.edges import Edge
from rightofway.site.geometry import (
    COARSE,
    Point,
    measure_squared_distance,
    measure_straight_length,
)

STRAIGHT = 2
"""Points of a straight way: both ends."""

PIECE = re.compile("(.+)/[1-9][0-9]*")
"""The name of a vertex between two pieces of a lane."""

MAX_PIECES = 100_000
"""The most pieces that the lanes of a roadmap are split into: 50 km of lanes, each 0.5 m."""


SPLITTING = "splitting lanes into pieces"

MOST_WINDING = 10
"""How many times as long as its drawing a lane may be that is split. Half a circle is 1.6 times as
long as the straight line; a way that winds more than this is taken for a slip in its length."""


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
    crossed
        How many lanes were split because others cross them, whichever ways they are driven.
    spacing
        The longest piece of these [length unit]; None where there are none.
    """

    positions: dict[str, Point]
    edges: list[Edge]
    pieces: dict[tuple[str, str], list[tuple[str, str]]]
    crossed: int = 0
    spacing: Fraction | None = None


def split_lanes(
    positions: Mapping[str, Point],
    edges: Sequence[Edge],
    spacing: Fraction | None,
    shapes: Mapping[tuple[str, str], Sequence[Point]] | None = None,
    *,
    distance: Fraction = Fraction(0),
    is_drawn: bool = True,
) -> SplitLanes:
    """Split lanes that are longer than the spacing into equal pieces, and curves at their points.

    Both directions of a lane share the new vertices, which are named by the direction that is given
    first: ``A-B/1``, ``A-B/2``, …. Directions that are driven along different curves share none.

    Without a spacing, but with a distance that two robots keep [length unit], lanes are split that
    others cross far from their ends (`crossings`), if they are drawn as long as they are.

    Raises
    ------
    InputError
        If a vertex has the name of a new one already, or there would be too many; if a lane that is
        split is more than `MOST_WINDING` times as long as its drawing.

    Examples
    --------
    >>> at = {"A": (Fraction(0), Fraction(0)), "B": (Fraction(5), Fraction(0))}
    >>> split = split_lanes(at, [Edge(tail="A", head="B", length=5)], Fraction(2))
    >>> [(edge.tail, edge.head, str(edge.length)) for edge in split.edges]
    [('A', 'A-B/1', '5/3'), ('A-B/1', 'A-B/2', '5/3'), ('A-B/2', 'B', '5/3')]
    """
    curves = {ends: tuple(points) for ends, points in (shapes or {}).items()}
    longest, drawings = _drawn_lanes(positions, edges, curves)
    refuse_many_pieces(longest.values(), spacing)
    longest_piece = {} if spacing is None else dict.fromkeys(longest, spacing)
    if spacing is None and distance > 0 and is_drawn:
        longest_piece = _crossed(drawings, longest, list(positions.values()), distance)
    places, split = dict(positions), list[Edge]()
    pieces: dict[tuple[str, str], list[tuple[str, str]]] = {}
    ways: dict[_Ends, tuple[list[str], list[Fraction], Fraction]] = {}
    for edge in limit_loop(edges, SPLITTING):
        lane = _lane(edge, curves)
        points, own = drawings[lane], longest_piece.get(lane)
        if len(points) == STRAIGHT and (own is None or longest[lane] <= own):
            split.append(edge)  # most of a million
            continue
        if lane not in ways:
            if is_drawn and own is not None and longest[lane] > own:
                _refuse_winding(edge, points, longest[lane], own)
            lengths = measure_lengths_along(points) if len(points) > STRAIGHT else [longest[lane]]
            inside, parts = _cuts(points, lengths, own)
            names = _joint_names(edge, len(inside))
            taken = next((name for name in names if name in places), None)
            if taken is not None and spacing is None and own is not None:
                inside, parts = _cuts(points, lengths, None)  # nobody asked for pieces
                names = _joint_names(edge, len(inside))
                taken = next((name for name in names if name in places), None)
            if taken is not None:
                message = f"{taken!r} is the name of a piece of a lane (rename the vertex)"
                raise InputError.at("vertices", message)
            places |= zip(names, inside, strict=True)
            whole = sum(lengths, Fraction(0))
            least = whole if len(lengths) > 1 else Fraction(0)
            shares = _each(parts, whole.__rtruediv__)
            ways[lane] = [edge.tail, *names, edge.head], shares, least
        lane_vertices, shares, least = ways[lane]
        if lane_vertices[0] != edge.tail:
            lane_vertices, shares = lane_vertices[::-1], shares[::-1]
        if len(shares) > 1:
            pieces[edge.tail, edge.head] = list(pairwise(lane_vertices))
        found_lengths = _each(shares, max(edge.length, least).__mul__)
        surcharges = _each(shares, edge.surcharge.__mul__)
        split += [
            edge.make_piece(tail, head, length, surcharge)
            for (tail, head), length, surcharge in zip(
                pairwise(lane_vertices), found_lengths, surcharges, strict=True
            )
        ]
    crossed_pieces = list(longest_piece.values()) if spacing is None else []
    return SplitLanes(
        places,
        split,
        pieces,
        crossed=len(crossed_pieces),
        spacing=max(crossed_pieces, default=None),
    )


def _joint_names(edge: Edge, count: int) -> list[str]:
    return [f"{edge.tail}-{edge.head}/{k}" for k in range(1, count + 1)]


def _drawn_lanes(
    positions: Mapping[str, Point],
    edges: Sequence[Edge],
    curves: Mapping[tuple[str, str], tuple[Point, ...]],
) -> tuple[dict[_Ends, Fraction], dict[_Ends, list[Point]]]:
    """Return the length of each lane, of its longer direction, and its ends and bends."""
    longest, drawings = dict[_Ends, Fraction](), dict[_Ends, list[Point]]()
    for edge in edges:
        lane = _lane(edge, curves)
        longest[lane] = max(longest.get(lane, edge.length), edge.length)
        if lane not in drawings:
            bends = curves.get((edge.tail, edge.head), ())
            drawings[lane] = [positions[edge.tail], *bends, positions[edge.head]]
    return longest, drawings


def _crossed(
    drawings: Mapping[_Ends, Sequence[Point]],
    longest: Mapping[_Ends, Fraction],
    points: Sequence[Point],
    distance: Fraction,
) -> dict[_Ends, Fraction]:
    """Return the longest piece of each long lane that others cross, or that passes a vertex.

    A lane that winds far more than it is drawn stays whole, because nobody knows where it leads.
    """
    spacing = choose_spacing(list(longest.values()), distance)
    parts, wanted, lane_of = list[list[_Floats]](), list[bool](), list[_Ends]()
    for lane, drawing in drawings.items():
        make_points_along = [(float(x), float(y)) for x, y in drawing]
        drawn = sum(dist(*ends) for ends in pairwise(make_points_along))
        is_long = spacing < longest[lane] <= MOST_WINDING * drawn
        for ends in pairwise(make_points_along):
            parts.append(list(ends))
            wanted.append(is_long)
            lane_of.append(lane)
    begin, end = np.array(parts, np.float64).reshape(-1, 2, 2).swapaxes(0, 1)
    at = np.array([(float(x), float(y)) for x, y in points], np.float64)
    is_met = find_crossed(begin, end, at, np.array(wanted, bool), float(distance))
    return {
        lane: max(spacing, longest[lane] / MOST_PIECES)
        for lane in (lane_of[part] for part in np.flatnonzero(is_met).tolist())
    }


def refuse_many_pieces(lengths: Iterable[Fraction], spacing: Fraction | None) -> None:
    """Refuse a spacing that makes too many pieces, before any is made.

    Raises
    ------
    InputError
        If there would be more than `MAX_PIECES`.
    """
    count = 0 if spacing is None else sum(ceil(length / spacing) for length in lengths)
    if count > MAX_PIECES:
        remedy = "give a larger spacing"
        message = f"a spacing of {spacing} makes {count} pieces, more than {MAX_PIECES} ({remedy})"
        raise InputError.at("", message)


def _refuse_winding(
    edge: Edge, points: Sequence[Point], length: Fraction, spacing: Fraction
) -> None:
    """Refuse to split a lane whose places would lie far nearer together than robots drive."""
    drawn = sum(sqrt(measure_squared_distance(*ends)) for ends in pairwise(points))
    if length > MOST_WINDING * drawn:
        gap = drawn / ceil(length / spacing)
        raise InputError.at(
            "",
            f"the lane from {quote(edge.tail)} to {quote(edge.head)} is {format_decimal(length)}"
            f" long, but {drawn:.4g} in the drawing: a spacing of {format_decimal(spacing)} sets"
            f" places {gap:.2g} apart (correct its length or its ends, draw its way as a curve, or"
            " give a larger spacing)",
        )


def _each(parts: Sequence[Fraction], use: Callable[[Fraction], Fraction]) -> list[Fraction]:
    """Return what becomes of each part; parts that are one number are worked out once."""
    part_of = {id(part): part for part in parts}
    result_of = {key: use(part) for key, part in part_of.items()}
    return [result_of[id(part)] for part in parts]


_Ends = frozenset[str] | tuple[str, str]
"""Both ends of a lane; in order where its directions are driven along different curves."""


_Floats = tuple[float, float]


def _lane(edge: Edge, curves: Mapping[tuple[str, str], tuple[Point, ...]]) -> _Ends:
    forward, back = curves.get((edge.tail, edge.head), ()), curves.get((edge.head, edge.tail), ())
    ends = (edge.tail, edge.head)
    return frozenset(ends) if forward == back[::-1] else ends


def measure_lengths_along(points: Sequence[Point]) -> list[Fraction]:
    """Return the lengths of the straight parts of a curve, each rounded up [length unit].

    Parts that differ by rounding only get one length, so that a tick need not be short.
    """
    parts = [measure_straight_length(measure_squared_distance(*ends)) for ends in pairwise(points)]
    longest = max(parts)
    return [longest] * len(parts) if longest - min(parts) <= 2 * COARSE else parts


def _cuts(
    points: Sequence[Point], lengths: Sequence[Fraction], spacing: Fraction | None
) -> tuple[list[Point], list[Fraction]]:
    """Return the points between the ends of a way, and the lengths of the pieces between them."""
    inside, parts = list[Point](), list[Fraction]()
    for (begin, end), length in zip(pairwise(points), lengths, strict=True):
        count = 1 if spacing is None else ceil(length / spacing)
        x_step, y_step = ((b - a) / count for a, b in zip(begin, end, strict=True))
        inside += [(begin[0] + k * x_step, begin[1] + k * y_step) for k in range(1, count + 1)]
        parts += [length / count] * count
    return inside[:-1], parts


def find_pieces(
    names: Collection[str], edges: Collection[tuple[str, str]]
) -> dict[tuple[str, str], list[tuple[str, str]]]:
    """Return the pieces of lanes that were split before a file was written, from their names.

    Returns
    -------
    dict
        As `SplitLanes.pieces`.

    Examples
    --------
    >>> find_pieces(["A", "B", "A-B/1"], {("A", "A-B/1"), ("A-B/1", "B"), ("B", "A")})
    {('A', 'B'): [('A', 'A-B/1'), ('A-B/1', 'B')]}
    """
    joints: dict[str, list[str]] = {}
    for name in names:
        if piece := PIECE.fullmatch(name):
            joints.setdefault(piece[1], []).append(name)
    pieces: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for lane, unsorted_joints in joints.items():
        inside = [f"{lane}/{k + 1}" for k in range(len(unsorted_joints))]
        if set(inside) != set(unsorted_joints):
            continue
        for dash in re.finditer("-", lane):  # the names of the ends may have dashes, too
            in_order = [lane[: dash.start()], *inside, lane[dash.end() :]]
            for directed in (in_order, in_order[::-1]):
                if all(piece in edges for piece in pairwise(directed)):
                    pieces[directed[0], directed[-1]] = list(pairwise(directed))
    return pieces
