"""Long lanes split into pieces, so that several robots can drive along one of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from math import ceil, dist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import limit_loop
from rightofway.errors import InputError, quote
from rightofway.facts import Fact
from rightofway.site.directions import list_named_copies
from rightofway.site.edges import Edge, EdgeTable, tabulate_edges
from rightofway.site.geometry import (
    COARSE,
    Point,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.units import write_decimal

STRAIGHT = 2
"""Points of a straight way: both ends."""

PIECE = re.compile("(.+)/[1-9][0-9]*")
"""The name of a vertex between two pieces of a lane."""

MAX_PIECES = 100_000
"""The most pieces that the lanes of a roadmap are split into: 50 km of lanes, each 0.5 m."""


PIECE_IN_DISTANCES = 3
"""Length of a piece in least distances of two robots, where a map does not say how lanes are split:
shorter pieces block a crossing hardly less, because a robot that drives along a piece has booked
both of its ends, too."""

MOST_PIECES, MOST_CUTS = 8, 50_000
"""Pieces that a lane, and all lanes together, are split into where a map does not say how, at most:
else pieces are longer. The eighth part of a lane is booked for an eighth of the time."""

SPLITTING = Fact("splitting lanes")

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
    chosen
        How many lanes were split though no map asks for it, whichever ways they are driven.
    spacing
        The longest piece of these [length unit]; None where there are none.
    """

    positions: dict[str, Point]
    edges: EdgeTable
    pieces: dict[tuple[str, str], list[tuple[str, str]]]
    chosen: int = 0
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

    The new vertices are named by the lane and its direction: ``A-B/1``, ``A-B/2``, …. Each
    direction has its own, so that no robot turns back inside a lane; ``A-B/1`` and the last one of
    ``B-A`` are at one point.

    Without a spacing, but with a distance that two robots keep [length unit], the spacing is chosen
    (`choose_spacing`), and lanes stay whole that are not drawn as long as they are.

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
    table = tabulate_edges(positions, edges)
    curves = {ends: tuple(points) for ends, points in (shapes or {}).items()}
    is_chosen = spacing is None and distance > 0 and is_drawn
    if not len(table) or (spacing is None and not is_chosen and not curves):
        return SplitLanes(dict(positions), table, {})
    lanes = _Lanes(table, curves)
    if spacing is not None:
        refuse_many_pieces(lanes.list_lengths(), spacing)
    elif is_chosen:
        spacing = choose_spacing(lanes.lengths_as_floats, distance)
    is_long = lanes.find_longer(spacing)
    is_bent = np.zeros(len(is_long), bool)
    bent = [edge for edge in range(len(table)) if lanes.get_bends(edge)] if curves else []
    is_bent[lanes.lane_of_edge[bent]] = True
    places = dict(positions)
    places_back: dict[str, Point] = {}  # after all others, so that these have the same numbers
    pieces: dict[tuple[str, str], list[tuple[str, str]]] = {}
    ways = dict[int, _Way | None]()
    parts: dict[int, _Way] = {}
    affected = np.flatnonzero((is_long | is_bent)[lanes.lane_of_edge]).tolist()
    for edge in limit_loop(affected, SPLITTING):
        lane = int(lanes.lane_of_edge[edge])
        if lane not in ways:
            own = spacing if is_long[lane] else None
            ways[lane] = _make_way(
                lanes,
                edge,
                places,
                places_back,
                own,
                is_chosen=is_chosen,
                is_drawn=is_drawn,
            )
        lane_way = ways[lane]
        if lane_way is not None:
            parts[edge] = (
                lane_way if lane_way.names[0] == lanes.get_ends(edge)[0] else lane_way.reverse()
            )
            if len(lane_way.shares) > 1:
                pieces[lanes.get_ends(edge)] = list(pairwise(parts[edge].names))
    chosen = [
        lane_way.longest_piece
        for lane_way in ways.values()
        if lane_way is not None and lane_way.is_cut
    ]
    places |= places_back
    return SplitLanes(
        places,
        _join(table, tuple(places), parts),
        pieces,
        chosen=len(chosen) if is_chosen else 0,
        spacing=max(chosen, default=None) if is_chosen else None,
    )


class _Way(NamedTuple):
    """The vertices along a lane, and the pieces between them."""

    names: list[str]
    names_back: list[str]  # in the other direction
    shares: list[Fraction]  # of the whole lane
    least: Fraction  # length of the lane, at least
    longest_piece: Fraction
    is_cut: bool  # whether a spacing makes pieces

    def reverse(self) -> _Way:
        return self._replace(names=self.names_back, names_back=self.names, shares=self.shares[::-1])


class _Lanes:
    """The lanes of a table: an edge and the one back are one lane, unless their curves differ."""

    def __init__(
        self, table: EdgeTable, curves: Mapping[tuple[str, str], tuple[Point, ...]]
    ) -> None:
        self.table, self.curves = table, curves
        tails, heads = table.tails.astype(np.int64), table.heads.astype(np.int64)
        count = len(table.names)
        keys = np.minimum(tails, heads) * count + np.maximum(tails, heads)
        if curves:
            apart = [
                edge
                for edge in range(len(table))
                if self.get_bends(edge) != self.curves.get(self.get_ends(edge)[::-1], ())[::-1]
            ]
            keys[apart] = count**2 + tails[apart] * count + heads[apart]
        _, first, lane_of_edge, self.n_directions = np.unique(
            keys, return_index=True, return_inverse=True, return_counts=True
        )
        self.first, self.lane_of_edge = first, lane_of_edge
        # The class of the longer direction.
        self.longest = table.kinds[first].copy()
        for edge in np.flatnonzero(table.kinds != self.longest[lane_of_edge]).tolist():
            lane, kind = lane_of_edge[edge], table.kinds[edge]
            if table.classes[kind].length > table.classes[self.longest[lane]].length:
                self.longest[lane] = kind
        floats = [
            edge_class.length.numerator / edge_class.length.denominator
            for edge_class in table.classes
        ]
        self.lengths_as_floats = np.array(floats)[self.longest]

    def get_ends(self, edge: int) -> tuple[str, str]:
        """Return the names of tail and head."""
        names = self.table.names
        return names[self.table.tails[edge]], names[self.table.heads[edge]]

    def get_bends(self, edge: int) -> tuple[Point, ...]:
        """Return the points between the ends of a curve."""
        return self.curves.get(self.get_ends(edge), ())

    def get_length(self, lane: int) -> Fraction:
        """Return the length of the longer direction."""
        length: Fraction = self.table.classes[self.longest[lane]].length
        return length

    def list_lengths(self) -> Iterator[Fraction]:
        """Yield the length of each lane."""
        return (self.table.classes[kind].length for kind in self.longest.tolist())

    def find_longer(self, spacing: Fraction | None) -> NDArray[np.bool_]:
        """Return which lanes are longer than a length; none without one."""
        if spacing is None:
            return np.zeros(len(self.longest), bool)
        is_longer = self.lengths_as_floats > float(spacing)
        for lane in np.flatnonzero(self.lengths_as_floats == float(spacing)).tolist():
            is_longer[lane] = self.get_length(lane) > spacing  # rounding makes them equal
        return is_longer


def _make_way(
    lanes: _Lanes,
    edge: int,
    places: dict[str, Point],
    places_back: dict[str, Point],
    spacing: Fraction | None,
    *,
    is_chosen: bool,
    is_drawn: bool,
) -> _Way | None:
    """Return the way along a lane in the direction of an edge, and add its new vertices.

    Those of the other direction are added, too. None for a lane that stays whole. Where the spacing
    is chosen nobody has asked for pieces: a lane stays as it is whose pieces have names of
    vertices, or that winds more than it is drawn, because nobody knows where it leads.
    """
    length = lanes.get_length(int(lanes.lane_of_edge[edge]))
    tail, head = lanes.get_ends(edge)
    points = [places[tail], *lanes.get_bends(edge), places[head]]
    if spacing is not None and is_drawn:
        drawn = sum(dist(*ends) for ends in pairwise([(float(x), float(y)) for x, y in points]))
        if length > MOST_WINDING * drawn:
            if not is_chosen:
                raise _make_winding_fault(tail, head, drawn, length, spacing)
            spacing = None
    if spacing is not None and is_chosen:
        spacing = max(spacing, length / MOST_PIECES)
    lengths = measure_lengths_along(points) if len(points) > STRAIGHT else [length]
    for own in (spacing, None) if is_chosen else (spacing,):
        inside, parts = _cut(points, lengths, own)
        names = [f"{tail}-{head}/{k}" for k in range(1, len(inside) + 1)]
        back = [f"{head}-{tail}/{k}" for k in range(1, len(inside) + 1)]
        if lanes.n_directions[lanes.lane_of_edge[edge]] == 1:
            back = names[::-1]
        all_names = dict.fromkeys((*names, *back))
        taken = next((name for name in all_names if name in places or name in places_back), None)
        if taken is None:
            break
    else:
        message = f"{taken!r} is the name of a piece of a lane (rename the vertex)"
        raise InputError.at("vertices", message)
    if not names:
        return None
    places.update(zip(names, inside, strict=True))
    if back != names[::-1]:
        places_back.update(zip(reversed(back), inside, strict=True))
    whole = sum(lengths, Fraction(0))
    return _Way(
        names=[tail, *names, head],
        names_back=[head, *back, tail],
        shares=_compute_each(parts, whole.__rtruediv__),
        least=whole if len(lengths) > 1 else Fraction(0),
        longest_piece=Fraction(0) if own is None else own,
        is_cut=own is not None,
    )


def _join(table: EdgeTable, names: tuple[str, ...], parts: Mapping[int, _Way]) -> EdgeTable:
    """Return a table with pieces in the place of the edges that are split."""
    ids = {name: vertex for vertex, name in enumerate(names)}
    counts = np.ones(len(table), np.int64)
    tails, heads, kinds = list[int](), list[int](), list[int]()
    classes, new_kinds = list(table.classes), dict[tuple[int, ...], int]()
    for edge, lane_way in limit_loop(parts.items(), SPLITTING):
        counts[edge] = len(lane_way.shares)
        of_vertex = [ids[name] for name in lane_way.names]
        tails += of_vertex[:-1]
        heads += of_vertex[1:]
        edge_class = table.classes[table.kinds[edge]]
        for share in lane_way.shares:
            key = (int(table.kinds[edge]), id(share), id(lane_way.least))
            if key not in new_kinds:
                new_kinds[key] = len(classes)
                classes.append(
                    replace(
                        edge_class,
                        length=share * max(edge_class.length, lane_way.least),
                        surcharge=share * edge_class.surcharge,
                    )
                )
            kinds.append(new_kinds[key])
    row = np.repeat(np.arange(len(table)), counts)
    columns = [column[row] for column in (table.tails, table.heads, table.kinds)]
    is_piece = np.zeros(len(table), bool)
    is_piece[list(parts)] = True
    for column, values in zip(columns, (tails, heads, kinds), strict=True):
        column[is_piece[row]] = values
    return EdgeTable(
        names=names, tails=columns[0], heads=columns[1], kinds=columns[2], classes=classes
    )


def choose_spacing(lengths: NDArray[np.float64], distance: Fraction) -> Fraction:
    """Return the length that lanes are split at where a map does not say it.

    It is `PIECE_IN_DISTANCES` times the distance, doubled until all lanes that are longer make no
    more than `MOST_CUTS` pieces; a lane makes `MOST_PIECES` at most.

    Examples
    --------
    >>> choose_spacing(np.array([5.0, 20.0]), Fraction(1))
    Fraction(3, 1)
    """
    spacing = PIECE_IN_DISTANCES * distance
    while True:
        counts = np.minimum(np.ceil(lengths / float(spacing)), MOST_PIECES)
        if counts[counts > 1].sum() <= MOST_CUTS:
            return spacing
        spacing *= 2


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


def _make_winding_fault(
    tail: str, head: str, drawn: float, length: Fraction, spacing: Fraction
) -> InputError:
    """Return the fault of a lane whose places would lie far nearer together than robots drive."""
    gap = drawn / ceil(length / spacing)
    return InputError.at(
        "",
        f"the lane from {quote(tail)} to {quote(head)} is {write_decimal(length)}"
        f" long, but {drawn:.4g} in the drawing: a spacing of {write_decimal(spacing)} sets"
        f" places {gap:.2g} apart (correct its length or its ends, draw its way as a curve, or"
        " give a larger spacing)",
    )


def _compute_each(parts: Sequence[Fraction], use: Callable[[Fraction], Fraction]) -> list[Fraction]:
    """Return the result for each part; parts that are one number are worked out once."""
    part_of = {id(part): part for part in parts}
    result_of = {key: use(part) for key, part in part_of.items()}
    return [result_of[id(part)] for part in parts]


def measure_lengths_along(points: Sequence[Point]) -> list[Fraction]:
    """Return the lengths of the straight parts of a curve, each rounded up [length unit].

    Parts that differ by rounding only get one length, so that a tick need not be short.
    """
    parts = [measure_straight_length(measure_squared_distance(*ends)) for ends in pairwise(points)]
    longest = max(parts)
    return [longest] * len(parts) if longest - min(parts) <= 2 * COARSE else parts


def _cut(
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
    copies = list_named_copies(names)
    pieces: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for lane, unsorted_joints in joints.items():
        inside = [f"{lane}/{k + 1}" for k in range(len(unsorted_joints))]
        if set(inside) != set(unsorted_joints):
            continue
        for dash in re.finditer("-", lane):  # the names of the ends may have dashes, too
            ends = lane[: dash.start()], lane[dash.end() :]
            for begin, end in product(*([name, *copies.get(name, ())] for name in ends)):
                in_order = [begin, *inside, end]
                for directed in (in_order, in_order[::-1]):
                    if all(piece in edges for piece in pairwise(directed)):
                        pieces[directed[0], directed[-1]] = list(pairwise(directed))
    return pieces
