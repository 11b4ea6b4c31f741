"""Roadmaps of named vertices and directed edges."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from rightofway.arguments import checks_arguments
from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError
from rightofway.site.geometry import Frame, VertexId
from rightofway.site.roadmap import EdgeClass, Lane, Roadmap
from rightofway.site.zones import NamedZone, number_zones
from rightofway.values import allow_none, coerce_fields, read_names, read_number


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """A way from one named vertex to another.

    Attributes
    ----------
    tail, head
        Names of the vertices it leaves and enters.
    length
        Its length [length unit], positive.
    max_speed
        Speed limit [length unit per time unit], positive; None for none.
    barred
        Types of robots that may not use it.
    surcharge
        What makes it less liked, not slower [time unit], not negative.
    """

    tail: str
    head: str
    length: Fraction
    max_speed: Fraction | None = None
    barred: frozenset[str] = frozenset()
    surcharge: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        source = f"edge {self.tail!r} to {self.head!r}"
        coerce_fields(
            self,
            source,
            length=read_number,
            max_speed=allow_none(read_number),
            barred=read_names,
            surcharge=read_number,
        )

    def make_piece(self, tail: str, head: str, length: Fraction, surcharge: Fraction) -> Edge:
        """Return a piece of this edge; its values are exact already, and are not checked again."""
        piece = object.__new__(Edge)  # a lane may have 100 000
        values = (tail, head, length, self.max_speed, self.barred, surcharge)
        for name, value in zip(Edge.__slots__, values, strict=True):
            object.__setattr__(piece, name, value)
        return piece


@checks_arguments
def make_roadmap(
    positions: Mapping[str, tuple[float, float]],
    edges: Sequence[Edge],
    *,
    y_up: bool = False,
    zones: Sequence[NamedZone] = (),
    pieces: Mapping[tuple[str, str], Sequence[tuple[str, str]]] | None = None,
    sides: Sequence[float] | None = None,
    frame: Frame | None = None,
    barred: Mapping[str, Collection[str]] | None = None,
    surcharges: Mapping[str, Fraction] | None = None,
) -> Roadmap:
    """Make a roadmap of named vertices and directed edges.

    Parameters
    ----------
    positions
        Name and (x, y) of every vertex in the site's frame [length unit]; the order gives the
        vertex ids.
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
        Names of vertices with what is added to the surcharge of each edge into them [time unit].

    Raises
    ------
    InputError
        For no vertex, an edge from or to nowhere, to itself, of no length, or given twice; and for
        zones of vertices and edges that the roadmap does not have.
    """
    ids = {name: vertex for vertex, name in enumerate(positions)}
    _check_edges(ids, edges)
    barred, surcharges = dict(barred or {}), dict(surcharges or {})
    if barred or surcharges:
        edges = [
            replace(
                edge,
                barred=edge.barred.union(barred.get(edge.head, ())),
                surcharge=edge.surcharge + surcharges.get(edge.head, 0),
            )
            for edge in edges
        ]
    # Fractions are slow to hash: edges often share theirs, and are told apart by identity.
    numbers = [
        (id(edge.length), id(edge.max_speed), id(edge.barred), id(edge.surcharge)) for edge in edges
    ]
    edge_of_numbers = dict(zip(numbers, edges, strict=True))
    # Floats first: fractions are slow to compare, too, and only equal floats need it.
    in_order = sorted(
        edge_of_numbers.items(),
        key=lambda item: (
            float(item[1].length),
            item[1].length,
            item[1].max_speed or 0,
            sorted(item[1].barred),
            item[1].surcharge,
        ),
    )
    classes, rank_of_numbers = list[EdgeClass](), dict[tuple[int, ...], int]()
    for numbers_of_edge, edge in in_order:
        edge_class = _edge_class(edge)
        if not classes or edge_class != classes[-1]:
            classes.append(edge_class)
        rank_of_numbers[numbers_of_edge] = len(classes) - 1
    order = sorted(range(len(edges)), key=lambda k: ids[edges[k].tail])  # stable: the given order
    ordered = [edges[k] for k in order]
    degrees = np.bincount([ids[edge.tail] for edge in ordered], minlength=len(ids))
    down = (1.0, -1.0 if y_up else 1.0)
    both_ends = {(edge.tail, edge.head) for edge in edges}
    return Roadmap(
        indptr=np.concatenate(([0], np.cumsum(degrees))).astype(np.int32),
        heads=np.array([ids[edge.head] for edge in ordered], np.int32),
        class_of_edge=np.array([rank_of_numbers[numbers[k]] for k in order], np.int32),
        edge_classes=tuple(classes),
        barred_vertices={VertexId(ids[name]): frozenset(kinds) for name, kinds in barred.items()},
        positions=np.array(list(positions.values()), np.float64).reshape(len(ids), 2) * down,
        labels=tuple(positions),
        frame=frame or Frame(y_up=y_up),
        sides=None if sides is None else np.array(sides, np.float64),
        zones=number_zones(zones, ids, both_ends, pieces or {}) if zones else (),
        lanes=_lanes((pieces or {}).values(), ids),
    )


def _edge_class(edge: Edge) -> EdgeClass:
    return EdgeClass(
        length=edge.length,
        max_speed=edge.max_speed,
        barred=edge.barred,
        surcharge=edge.surcharge,
    )


def _lanes(split: Iterable[Sequence[tuple[str, str]]], ids: Mapping[str, int]) -> tuple[Lane, ...]:
    """Return the lanes of some pieces each, in an order that does not depend on that of edges."""
    names = ([pieces[0][0], *(head for _, head in pieces)] for pieces in split)
    ways = (tuple(VertexId(ids[name]) for name in lane_names) for lane_names in names)
    return tuple(Lane(vertices=lane) for lane in sorted(ways))


def _check_edges(ids: Mapping[str, int], edges: Sequence[Edge]) -> None:
    if not ids:
        raise InputError.at("", "the roadmap has no vertex (give at least one)")
    seen: set[tuple[str, str]] = set()
    for index, edge in enumerate(limit_loop(edges, READING)):
        fault = _edge_fault(edge, ids, seen)
        if not fault and edge.surcharge.numerator < 0:
            fault = f"surcharge {edge.surcharge} is negative (give 0 or more)"
        if fault:
            raise InputError.at(("edges", index), fault)
        seen.add((edge.tail, edge.head))


def _edge_fault(edge: Edge, ids: Mapping[str, int], seen: set[tuple[str, str]]) -> str | None:
    for end in (edge.tail, edge.head):
        if end not in ids:
            return f"no vertex is named {end!r} (name one of the {len(ids)} vertices)"
    if edge.tail == edge.head:
        return f"leads from {edge.tail!r} to itself (take it out)"
    if edge.length.numerator <= 0:
        return f"length {edge.length} is not positive (give a length above 0)"
    if edge.max_speed is not None and edge.max_speed <= 0:
        return f"max_speed {edge.max_speed} is not positive (give a speed above 0)"
    if (edge.tail, edge.head) in seen:
        return f"{edge.tail!r} to {edge.head!r} is given twice (take one out)"
    return None
