"""Vertices at which robots may not turn, as one vertex for each direction of driving.

A robot that may not turn on the spot drives on along lanes in nearly the direction in which it has
come. Which lanes these are depends on the lane that it has come along. So such a vertex becomes
several vertices at one place: robots come to each along lanes that may be followed by the same
lanes. The graph then contains the rule, as it does between the pieces of a lane.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import atan2, degrees
from operator import attrgetter
from typing import Any

import numpy as np

from rightofway.errors import InputError, join_names
from rightofway.site.geometry import Point, VertexId
from rightofway.site.roadmap import Lane, Roadmap
from rightofway.site.zones import Zone
from rightofway.units import write_decimal

MOST_BEND = 90
"""A robot that may not turn follows lanes whose headings differ by this at most, after rounding to
whole degrees: it drives round a corner, and does not reverse."""

MICRO = 10**6
"""Headings of edges are rounded to this part of a degree."""

END = "/end"
"""The name of a vertex for robots that come along a lane is that of the lane with this suffix."""

Ends = tuple[str, str]
"""The names of tail and head."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Directions:
    """Where robots may turn, and how they are turned, by names of vertices and lanes.

    Attributes
    ----------
    fixed
        Vertices at which robots may not turn.
    fixed_ends, fixed_begins
        Lanes at whose end, or begin, robots may not turn.
    turning
        Lanes along which robots may turn, or may not, where that is known: a robot that may turn
        along a lane enters it in any heading.
    headings
        The heading of robots that work at a vertex: from the site's x axis to its y axis [degrees].
    orientations
        The angle of robots against the direction of driving along a lane [degrees].
    bends
        Points between the ends of lanes that robots drive along a curve, in the site's frame.
    """

    fixed: Collection[str] = ()
    fixed_ends: Collection[Ends] = ()
    fixed_begins: Collection[Ends] = ()
    turning: Mapping[Ends, bool] = field(default_factory=dict)
    headings: Mapping[str, Fraction] = field(default_factory=dict)
    orientations: Mapping[Ends, Fraction] = field(default_factory=dict)
    bends: Mapping[Ends, tuple[Point, ...]] = field(default_factory=dict)

    def collect(self, roadmap: Roadmap) -> dict[str, Any]:
        """Return headings, orientations and turning of a roadmap, as `Drawing` has them."""
        at = roadmap.get_vertex

        def list_edges(lanes: Mapping[Ends, Any]) -> tuple[tuple[VertexId, VertexId, Any], ...]:
            value_of = {
                edge: value
                for (tail, head), value in lanes.items()
                for edge in roadmap.list_pieces((at(tail), at(head)))
            }
            return tuple((*edge, value) for edge, value in value_of.items())

        return {
            "headings": tuple((at(name), heading) for name, heading in self.headings.items()),
            "orientations": list_edges(self.orientations),
            "turning": list_edges(self.turning),
        }


def direct_vertices(roadmap: Roadmap, directions: Directions) -> Roadmap:
    """Return a roadmap in which robots do not turn where they may not.

    Each vertex with a forbidden turn keeps its number for robots that come in its heading, if it
    has one, else for those that can drive on along most lanes. Homes are in this direction; where
    there is no heading, robots stop in any direction (`model.stop_directions`). The vertices for
    other directions come last; they are named by a lane, like ``A-B/end`` for robots that come to B
    from A.

    Raises
    ------
    InputError
        If a vertex has the name of a new one.
    """
    known = _find_known(roadmap)
    if not (directions.fixed or directions.fixed_ends or directions.fixed_begins):
        return replace(roadmap, originals=known) if known else roadmap
    drives = _Drives(roadmap, directions)
    split = _Split(drives)
    for vertex in sorted(drives.special):
        split.split_vertex(vertex)
    return split.make_roadmap(known)


class _Split:
    """The edges of a roadmap between vertices for each direction, as they are found."""

    def __init__(self, drives: _Drives) -> None:
        self.drives, self.roadmap = drives, drives.roadmap
        self.heads = [*drives.heads]
        self.tails = [[tail] for tail in drives.tails]  # an edge may leave several copies
        self.drawn = [*range(self.roadmap.n_vertices)]
        self.labels = [*map(self.roadmap.name, self.drawn)]
        self.fixed = set[VertexId]()
        self.unmet = dict[VertexId, str]()

    def split_vertex(self, vertex: int) -> None:
        """Split a vertex by the lanes that robots may follow, and by their heading."""
        drives = self.drives
        ways: dict[tuple[bool, frozenset[int], bool], list[int]] = {}
        for edge in drives.into[vertex]:
            after = frozenset(own for own in drives.out[vertex] if drives.may_follow(edge, own))
            is_fixed = drives.is_fixed_after(edge)
            fits = not is_fixed or drives.fits(edge, vertex)
            ways.setdefault((fits, after, is_fixed), []).append(edge)
        if not ways:  # robots only begin there, in any heading
            self.fixed |= {VertexId(vertex)} & drives.fixed
            return
        in_order = sorted(
            ways.items(), key=lambda item: (-item[0][0], -len(item[0][1]), -len(item[1]), item[1])
        )
        if not in_order[0][0][0]:
            self.unmet[VertexId(vertex)] = drives.describe_headings(vertex)
        for edge in drives.out[vertex]:
            self.tails[edge] = []
        for number, ((_, after, is_fixed), before) in enumerate(in_order):
            at = vertex if number == 0 else self._add_copy(vertex, before[0])
            self.fixed |= {VertexId(at)} if is_fixed else set()
            for edge in before:
                self.heads[edge] = at
            for edge in after:
                self.tails[edge].append(at)

    def _add_copy(self, vertex: int, edge: int) -> int:
        """Add the vertex of robots that come along an edge."""
        name = self.drives.name_end(edge)
        if name in self.labels:
            message = f"{name!r} is the name of the end of a lane (rename the vertex)"
            raise InputError.at("vertices", message)
        self.drawn.append(vertex)
        self.labels.append(name)
        return len(self.drawn) - 1

    def make_roadmap(self, known: Mapping[VertexId, VertexId]) -> Roadmap:
        """Return the roadmap of all vertices; some are copies already."""
        roadmap, n = self.roadmap, self.roadmap.n_vertices
        rows = sorted((tail, edge) for edge, tails in enumerate(self.tails) for tail in tails)
        tails, edges = np.array(rows, np.int64).reshape(-1, 2).T
        counts = np.bincount(tails, minlength=len(self.drawn))
        drawn = np.array(self.drawn, np.int64)
        used, kinds = np.unique(roadmap.class_of_edge[edges], return_inverse=True)
        new = {VertexId(copy): VertexId(of) for copy, of in enumerate(self.drawn[n:], n)}
        return replace(
            roadmap,
            indptr=np.concatenate(([0], np.cumsum(counts))).astype(np.int32),
            heads=np.array(self.heads, np.int32)[edges],
            class_of_edge=kinds.astype(np.int32),
            edge_classes=tuple(roadmap.edge_classes[kind] for kind in used.tolist()),
            positions=roadmap.positions[drawn],
            fractions={at: roadmap.fractions[of] for at, of in enumerate(self.drawn)
                       if of in roadmap.fractions},
            labels=tuple(self.labels),
            sides=None if roadmap.sides is None else tuple(roadmap.sides[of] for of in self.drawn),
            barred_vertices={VertexId(at): roadmap.barred_vertices[VertexId(of)]
                             for at, of in enumerate(self.drawn)
                             if of in roadmap.barred_vertices},
            zones=tuple(zone for zone in map(self._split_zone, roadmap.zones)
                        if zone.vertices or zone.edges),
            lanes=tuple(sorted((own for lane in roadmap.lanes for own in self._split_lane(lane)),
                               key=attrgetter("vertices"))),
            originals={**known, **{copy: known.get(of, of) for copy, of in new.items()}},
            fixed=frozenset(self.fixed),
            unmet=self.unmet,
        )  # fmt: skip

    def _split_zone(self, zone: Zone) -> Zone:
        inside = {*zone.vertices}
        return Zone(
            name=zone.name,
            vertices=tuple(VertexId(at) for at, of in enumerate(self.drawn) if of in inside),
            edges=tuple(ends for pair in zone.edges for ends in self._list_ends(pair)),
        )

    def _split_lane(self, lane: Lane) -> Iterator[Lane]:
        """Yield a lane from each of the vertices where it begins."""
        last = self._list_ends(lane.pieces[-1])
        for begin, _ in self._list_ends(lane.pieces[0]):
            yield Lane(vertices=(begin, *lane.joints, last[0][1]))

    def _list_ends(self, drawn: tuple[int, int]) -> list[tuple[VertexId, VertexId]]:
        """Return tail and head of each edge that an edge has become."""
        edge = self.drives.edge_of[drawn]
        head = VertexId(self.heads[edge])
        return [(VertexId(tail), head) for tail in self.tails[edge]]


def list_named_copies(names: Collection[str]) -> dict[str, list[str]]:
    """Return the names of vertices for further directions, by the vertices they may stand for.

    The names of the ends of lanes may have dashes, too.
    """
    copies: dict[str, list[str]] = {}
    for name in names:
        for dash in re.finditer("-", name) if name.endswith(END) else ():
            copies.setdefault(name[dash.end() : -len(END)], []).append(name)
    return copies


def _find_known(roadmap: Roadmap) -> dict[VertexId, VertexId]:
    """Return the vertices of directions that a file has, from their names and positions."""
    ids = {name: VertexId(vertex) for vertex, name in enumerate(roadmap.labels or ())}
    return {
        ids[copy]: ids[name]
        for name, copies in list_named_copies(ids).items()
        for copy in copies
        if name in ids and roadmap.get_point(ids[name]) == roadmap.get_point(ids[copy])
    }


class _Drives:
    """The edges of a roadmap, with the headings of robots and the turns that they may make."""

    def __init__(self, roadmap: Roadmap, directions: Directions) -> None:
        self.roadmap, self.directions = roadmap, directions
        self.tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
        self.heads = roadmap.heads.tolist()
        self.ids = {name: VertexId(vertex) for vertex, name in enumerate(roadmap.labels or ())}
        self.edge_of = {
            ends: edge for edge, ends in enumerate(zip(self.tails, self.heads, strict=True))
        }
        self.lane_of = {piece: lane.ends for lane in roadmap.lanes for piece in lane.pieces}
        self.fixed = frozenset(self.ids[name] for name in directions.fixed if name in self.ids)
        self.at_end = self._find_pieces(directions.fixed_ends, -1)
        self.at_begin = self._find_pieces(directions.fixed_begins, 0)
        self.special = {
            *self.fixed,
            *(self.heads[edge] for edge in self.at_end),
            *(self.tails[edge] for edge in self.at_begin),
        }
        self.into, self.out = ({vertex: list[int]() for vertex in self.special} for _ in range(2))
        for (tail, head), edge in self.edge_of.items() if self.special else ():
            if tail in self.special:
                self.out[tail].append(edge)
            if head in self.special:
                self.into[head].append(edge)

    def _find_pieces(self, lanes: Collection[Ends], piece: int) -> set[int]:
        """Return the first (0) or the last (-1) edge along each of some lanes."""
        ids = self.ids
        known = (ends for ends in lanes if ids.keys() >= {*ends})
        pieces = (self.roadmap.list_pieces((ids[tail], ids[head])) for tail, head in known)
        return {self.edge_of[own[piece]] for own in pieces if own}

    def is_fixed_after(self, edge: int) -> bool:
        """Return whether robots may not turn at the end of an edge."""
        return self.heads[edge] in self.fixed or edge in self.at_end

    def may_follow(self, before: int, after: int) -> bool:
        """Return whether robots may drive along an edge after another one."""
        is_fixed = self.is_fixed_after(before) or after in self.at_begin
        headings = self._measure_heading(before, 1), self._measure_heading(after, 0)
        return not is_fixed or self._may_turn(after) or measure_angle(*headings) <= MOST_BEND

    def fits(self, edge: int, vertex: int) -> bool:
        """Return whether robots come along an edge in the heading of a vertex; True for any."""
        heading = self.directions.headings.get(self.roadmap.name(vertex))
        return measure_angle(self._measure_heading(edge, 1), heading) == 0

    def describe_headings(self, vertex: int) -> str:
        """Return the heading of a vertex, and those in which lanes end there, as text."""
        own = self.directions.headings[self.roadmap.name(vertex)]
        headings = (self._measure_heading(edge, 1) for edge in self.into[vertex])
        known = sorted({heading % 360 for heading in headings if heading is not None})
        ends = list(map(write_decimal, known))
        return f"in heading {write_decimal(own)}, and lanes end there in {join_names(ends)}"

    def name_end(self, edge: int) -> str:
        """Return the name of the vertex for robots that come along an edge."""
        tail, head = self._list_names(edge)[-1]
        return f"{tail}-{head}{END}"

    def _list_names(self, edge: int) -> list[Ends]:
        """Return the names of the ends of an edge, and of those of its lane."""
        ends = VertexId(self.tails[edge]), VertexId(self.heads[edge])
        name = self.roadmap.name
        return [(name(tail), name(head)) for tail, head in (ends, self.lane_of.get(ends, ends))]

    def _may_turn(self, edge: int) -> bool:
        return any(self.directions.turning.get(ends) for ends in self._list_names(edge))

    def _measure_heading(self, edge: int, end: int) -> Fraction | None:
        """Return the heading of robots at the begin (0) or the end (1) of an edge [degrees]."""
        names, at = self._list_names(edge), self.roadmap.get_point
        bends = self.directions.bends.get(names[0], ())
        points = [at(self.tails[edge]), *bends, at(self.heads[edge])]
        (x, y), (to_x, to_y) = points[-2:] if end else points[:2]
        if (x, y) == (to_x, to_y):
            return None
        turns = map(self.directions.orientations.get, names)
        turn = next((turn for turn in turns if turn is not None), Fraction(0))
        return Fraction(round(degrees(atan2(to_y - y, to_x - x)) * MICRO), MICRO) + turn


def measure_angle(heading: Fraction | None, other: Fraction | None) -> int:
    """Return the angle between two headings, the shorter way, in whole degrees; 0 without one."""
    if heading is None or other is None:
        return 0
    angle = abs(heading - other) % 360
    return round(min(angle, 360 - angle))
