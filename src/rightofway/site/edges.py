"""Roadmaps of named vertices and directed edges.

A roadmap may have a million edges. So readers hand them on as the columns of an `EdgeTable`, and an
edge is an object only where somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import groupby
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, quote
from rightofway.kinds.table import NAMES, NUMBER, TYPE_SPEEDS, TypeSpeeds, allow_none, coerce_fields
from rightofway.site.chains import unfold
from rightofway.site.directions import Directions, direct_vertices
from rightofway.site.geometry import Frame, VertexId, find_fractions
from rightofway.site.roadmap import EdgeClass, Lane, Roadmap
from rightofway.site.zones import NamedZone, number_zones


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """A directed edge between named vertices.

    Attributes
    ----------
    tail, head
        Names of the vertices it leaves and enters.
    length
        Its length [length unit], positive.
    max_speed
        Speed limit [length unit per time unit], positive; None for none.
    max_speed_by_type
        Types of robots that have another speed limit, with this limit.
    barred
        Types of robots that may not use it.
    surcharge
        A cost that makes it less liked, not slower [time unit], not negative.
    """

    tail: str
    head: str
    length: Fraction
    max_speed: Fraction | None = None
    max_speed_by_type: Mapping[str, Fraction] | TypeSpeeds = ()
    barred: frozenset[str] = frozenset()
    surcharge: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        source = f"edge {self.tail!r} to {self.head!r}"
        coerce_fields(
            self,
            source,
            length=NUMBER,
            max_speed=allow_none(NUMBER),
            max_speed_by_type=TYPE_SPEEDS,
            barred=NAMES,
            surcharge=NUMBER,
        )

    def make_piece(self, tail: str, head: str, length: Fraction, surcharge: Fraction) -> Edge:
        """Return a piece of this edge; its values are exact already, and are not checked again."""
        piece = object.__new__(Edge)  # a lane may have 100 000
        own = (self.max_speed, self.max_speed_by_type, self.barred)
        values = (tail, head, length, *own, surcharge)
        for name, value in zip(Edge.__slots__, values, strict=True):
            object.__setattr__(piece, name, value)
        return piece


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EdgeTable(Sequence[Edge]):
    """Directed edges as columns.

    Attributes
    ----------
    names
        Names of the vertices, by id.
    tails, heads
        The vertices that each edge leaves and enters; int32, shape (E,).
    kinds
        Index into `classes` of each edge; int32, shape (E,).
    classes
        Common properties of edges, in any order; some may be equal.
    """

    names: tuple[str, ...]
    tails: NDArray[np.int32]
    heads: NDArray[np.int32]
    kinds: NDArray[np.int32]
    classes: Sequence[EdgeClass]

    def __len__(self) -> int:
        return len(self.tails)

    @overload
    def __getitem__(self, index: int) -> Edge: ...
    @overload
    def __getitem__(self, index: slice) -> list[Edge]: ...
    def __getitem__(self, index: int | slice) -> Edge | list[Edge]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        edge_class = self.classes[self.kinds[index]]
        return Edge(
            tail=self.names[self.tails[index]],
            head=self.names[self.heads[index]],
            length=edge_class.length,
            max_speed=edge_class.max_speed,
            max_speed_by_type=edge_class.max_speed_by_type,
            barred=edge_class.barred,
            surcharge=edge_class.surcharge,
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]

    def find_repeated(self) -> NDArray[np.bool_]:
        """Return which edges have the tail and the head of an earlier one."""
        ends = self.tails.astype(np.int64) * len(self.names) + self.heads
        is_repeated = np.ones(len(self), bool)
        is_repeated[np.unique(ends, return_index=True)[1]] = False
        return is_repeated


def tabulate_edges(positions: Mapping[str, object], edges: Sequence[Edge]) -> EdgeTable:
    """Return edges as columns; a table with these vertices is returned as it is.

    Raises
    ------
    InputError
        For an edge from or to a vertex that has no position.
    """
    names = tuple(positions)
    if isinstance(edges, EdgeTable):
        if edges.names == names:
            return edges
        edges = list(edges)
    ids = {name: vertex for vertex, name in enumerate(names)}
    # Fractions are slow to hash: edges often share theirs, and are told apart by identity.
    kinds = dict[tuple[int, ...], int]()
    classes, kind_of_edge, ends = list[EdgeClass](), list[int](), list[int]()
    for index, edge in enumerate(limit_loop(edges, READING)):
        for end in (edge.tail, edge.head):
            vertex = ids.get(end)
            if vertex is None:
                message = f"no vertex is named {end!r} (name one of the {len(ids)} vertices)"
                raise InputError.at(("edges", index), message)
            ends.append(vertex)
        own = (edge.length, edge.max_speed, edge.max_speed_by_type, edge.barred, edge.surcharge)
        numbers = tuple(map(id, own))
        kind = kinds.get(numbers)
        if kind is None:
            kind = kinds[numbers] = len(classes)
            classes.append(
                EdgeClass(
                    length=edge.length,
                    max_speed=edge.max_speed,
                    max_speed_by_type=TYPE_SPEEDS.read(edge.max_speed_by_type),
                    barred=edge.barred,
                    surcharge=edge.surcharge,
                )
            )
        kind_of_edge.append(kind)
    tails, heads = np.array(ends, np.int32).reshape(-1, 2).T
    kind_column = np.array(kind_of_edge, np.int32)
    return EdgeTable(names=names, tails=tails, heads=heads, kinds=kind_column, classes=classes)


def make_roadmap(
    positions: Mapping[str, tuple[float | Fraction, float | Fraction]],
    edges: Sequence[Edge],
    *,
    y_up: bool = False,
    zones: Sequence[NamedZone] = (),
    pieces: Mapping[tuple[str, str], Sequence[tuple[str, str]]] | None = None,
    sides: Sequence[Fraction] | None = None,
    frame: Frame | None = None,
    barred: Mapping[str, Collection[str]] | None = None,
    surcharges: Mapping[str, Fraction] | None = None,
    passed: Collection[str] = (),
    directions: Directions | None = None,
) -> Roadmap:
    """Make a roadmap of named vertices and directed edges.

    Parameters
    ----------
    positions
        Name and (x, y) of every vertex in the site's frame [length unit], exact; floating point
        counts as its shortest decimal. The order gives the vertex ids.
    edges
        Directed edges; their order decides between equally short paths.
    y_up
        Whether y grows upwards in the site's frame.
    zones
        Vertices and edges that hold one robot at a time. A lane that was split may be named.
    pieces
        Tail and head of every piece of each lane that was split, by tail and head of the lane.
    sides
        Side of the square cell round each vertex [length unit]; None without cells.
    frame
        The frame that the positions are relative to, by default the site's; ``y_up`` is its own.
    barred
        Names of vertices with the types of robots that may not be there.
    surcharges
        Names of vertices with the time added to the surcharge of each edge into them [time unit].
    passed
        Names of vertices that robots only drive through.
    directions
        Where robots may not turn; None for nowhere.

    Raises
    ------
    InputError
        For no vertex, an edge from or to nowhere, to itself, of no length, or given twice; and for
        zones of vertices and edges that the roadmap does not have.
    """
    return make_roadmap_of_table(
        positions,
        tabulate_edges(positions, edges),
        y_up=y_up,
        zones=zones,
        pieces=pieces,
        sides=sides,
        frame=frame,
        barred=barred,
        surcharges=surcharges,
        passed=passed,
        directions=directions,
    )


def make_roadmap_of_table(
    positions: Mapping[str, tuple[float | Fraction, float | Fraction]],
    table: EdgeTable,
    *,
    y_up: bool = False,
    zones: Sequence[NamedZone] = (),
    pieces: Mapping[tuple[str, str], Sequence[tuple[str, str]]] | None = None,
    sides: Sequence[Fraction] | None = None,
    frame: Frame | None = None,
    barred: Mapping[str, Collection[str]] | None = None,
    surcharges: Mapping[str, Fraction] | None = None,
    passed: Collection[str] = (),
    directions: Directions | None = None,
) -> Roadmap:
    """Make a roadmap of a table of edges; otherwise as `make_roadmap`.

    Raises
    ------
    InputError
        As `make_roadmap`.
    """
    ids = {name: vertex for vertex, name in enumerate(table.names)}
    _check_edges(table)
    table = _add_those_of_vertices(table, ids, barred or {}, surcharges or {})
    classes, kinds = _sort_classes(table)
    order = np.argsort(table.tails, kind="stable")  # the given order at each vertex
    degrees = np.bincount(table.tails, minlength=len(ids))
    down = -1 if y_up else 1
    points = [(float(x), down * float(y)) for x, y in positions.values()]
    roadmap = Roadmap(
        indptr=np.concatenate(([0], np.cumsum(degrees))).astype(np.int32),
        heads=table.heads[order],
        class_of_edge=kinds[order],
        edge_classes=classes,
        barred_vertices={
            VertexId(ids[name]): frozenset(kinds_of_vertex)
            for name, kinds_of_vertex in (barred or {}).items()
        },
        positions=np.array(points, np.float64).reshape(len(ids), 2),
        fractions={
            vertex: (x, down * y) for vertex, (x, y) in find_fractions(positions.values()).items()
        },
        labels=table.names,
        frame=frame or Frame(y_up=y_up),
        sides=None if sides is None else tuple(sides),
        zones=number_zones(zones, ids, _list_ends(table), pieces or {}) if zones else (),
        lanes=_list_lanes((pieces or {}).values(), ids),
    )
    roadmap = direct_vertices(roadmap, directions or Directions())
    passed_vertices = [VertexId(ids[name]) for name in passed]
    return unfold(roadmap, [at for own in passed_vertices for at in roadmap.list_copies(own)])


def _list_ends(table: EdgeTable) -> set[tuple[str, str]]:
    names = table.names
    ends = zip(table.tails.tolist(), table.heads.tolist(), strict=True)
    return {(names[tail], names[head]) for tail, head in ends}


def _add_those_of_vertices(
    table: EdgeTable,
    ids: Mapping[str, int],
    barred: Mapping[str, Collection[str]],
    surcharges: Mapping[str, Fraction],
) -> EdgeTable:
    """Return edges with the barred types and the surcharges of the vertices that they enter."""
    special = sorted({*barred, *surcharges}, key=ids.__getitem__)
    if not special:
        return table
    number = np.zeros(len(ids), np.int64)
    number[[ids[name] for name in special]] = np.arange(1, len(special) + 1)
    pairs = table.kinds.astype(np.int64) * (len(special) + 1) + number[table.heads]
    known, kinds = np.unique(pairs, return_inverse=True)
    classes = list[EdgeClass]()
    for kind, vertex in (divmod(pair, len(special) + 1) for pair in known.tolist()):
        edge_class = table.classes[kind]
        if vertex:
            name = special[vertex - 1]
            edge_class = replace(
                edge_class,
                barred=edge_class.barred.union(barred.get(name, ())),
                surcharge=edge_class.surcharge + surcharges.get(name, 0),
            )
        classes.append(edge_class)
    return replace(table, kinds=kinds.astype(np.int32), classes=classes)


def _sort_classes(table: EdgeTable) -> tuple[tuple[EdgeClass, ...], NDArray[np.int32]]:
    """Return the classes that edges have, sorted and all different, and that of each edge."""
    used, kinds = np.unique(table.kinds, return_inverse=True)
    given = [table.classes[kind] for kind in used.tolist()]
    # Floats first: fractions are slow to compare, and only equal floats need it.
    floats = [edge_class.length.numerator / edge_class.length.denominator for edge_class in given]
    rank, classes = np.zeros(len(given), np.int32), list[EdgeClass]()
    for _, same in groupby(sorted(range(len(given)), key=floats.__getitem__), floats.__getitem__):
        alike = list(same)
        if len(alike) > 1:
            alike.sort(key=lambda kind: _sort_key(given[kind]))
        for kind in alike:
            if kind == alike[0] or given[kind] != classes[-1]:
                classes.append(given[kind])
            rank[kind] = len(classes) - 1
    return tuple(classes), rank[kinds]


def _sort_key(edge_class: EdgeClass) -> tuple[Any, ...]:
    return (
        edge_class.length,
        edge_class.max_speed or 0,
        sorted(edge_class.barred),
        edge_class.surcharge,
        edge_class.max_speed_by_type,
    )


def _list_lanes(
    split: Iterable[Sequence[tuple[str, str]]], ids: Mapping[str, int]
) -> tuple[Lane, ...]:
    """Return the lanes of some pieces each, in an order that does not depend on that of edges."""
    names = ([pieces[0][0], *(head for _, head in pieces)] for pieces in split)
    ways = (tuple(VertexId(ids[name]) for name in lane_names) for lane_names in names)
    return tuple(Lane(vertices=lane) for lane in sorted(ways))


def _check_edges(table: EdgeTable) -> None:
    """Refuse a table whose first wrong edge is not one that robots can drive along."""
    if not table.names:
        raise InputError.at("", "the roadmap has no vertex (give at least one)")
    if not len(table):
        return
    is_wrong = np.array(
        [_describe_class_fault(edge_class) != "" for edge_class in table.classes], bool
    )
    is_repeated = table.find_repeated()
    wrong = (table.tails == table.heads) | is_wrong[table.kinds] | is_repeated
    if not wrong.any():
        return
    index = int(wrong.argmax())
    tail, head = table.names[table.tails[index]], table.names[table.heads[index]]
    fault = _describe_class_fault(table.classes[table.kinds[index]])
    if tail == head:
        fault = f"leads from {tail!r} to itself (take it out)"
    elif not fault or (fault.startswith("surcharge") and is_repeated[index]):
        fault = f"{tail!r} to {head!r} is given twice (take one out)"
    raise InputError.at(("edges", index), fault)


def _describe_class_fault(edge_class: EdgeClass) -> str:
    if edge_class.length.numerator <= 0:
        return f"length {edge_class.length} is not positive (give a length above 0)"
    if edge_class.max_speed is not None and edge_class.max_speed.numerator <= 0:
        return f"max_speed {edge_class.max_speed} is not positive (give a speed above 0)"
    for name, speed in edge_class.max_speed_by_type:
        if speed <= 0:
            limit = f"max_speed_by_type: {quote(name)}: {speed}"
            return f"{limit} is not positive (give a speed above 0)"
    if edge_class.surcharge.numerator < 0:
        return f"surcharge {edge_class.surcharge} is negative (give 0 or more)"
    return ""
