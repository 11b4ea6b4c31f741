"""Vertices, edges and zones that are added one by one, and the roadmap that they become."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, find_nearest, locate_faults, quote
from rightofway.kinds.numbers import Number
from rightofway.kinds.table import (
    COORDINATE,
    NAME,
    NAMES,
    NOT_NEGATIVE,
    NUMBER,
    POSITIVE,
    TRUTH,
    TYPE_SPEEDS,
    allow_none,
)
from rightofway.site import (
    Edge,
    Point,
    Roadmap,
    choose_rounding_step,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.directions import Directions
from rightofway.site.drawing import Drawing
from rightofway.site.edges import make_roadmap_of_table
from rightofway.site.spacing import split_lanes
from rightofway.site.zones import NamedZone


@dataclass
class DrawnLanes:
    """Vertices, edges and zones, as `FleetBuilder` adds them.

    Attributes
    ----------
    positions
        Name and position of each vertex [length unit].
    edges
        Tail, head, length if it is given, and the other attributes of each directed edge.
    barred, surcharges, passed
        Properties given for vertices.
    fixed
        Vertices at which robots may not turn.
    turning
        Whether robots may turn along an edge, by tail and head, where that is known.
    headings, orientations
        Headings at vertices, and orientations along edges by tail and head [degrees].
    edge_ids
        Ids of edges in orders, by tail and head.
    zones
        Zones by the names of their vertices and edges.
    is_drawn
        Whether the positions are those of the site; else they are numbers in a row.
    """

    positions: dict[str, Point] = field(default_factory=dict)
    edges: list[tuple[str, str, Fraction | None, dict[str, Any]]] = field(default_factory=list)
    barred: dict[str, frozenset[str]] = field(default_factory=dict)
    surcharges: dict[str, Fraction] = field(default_factory=dict)
    passed: list[str] = field(default_factory=list)
    fixed: list[str] = field(default_factory=list)
    turning: dict[tuple[str, str], bool] = field(default_factory=dict)
    headings: dict[str, Fraction] = field(default_factory=dict)
    orientations: dict[tuple[str, str], Fraction] = field(default_factory=dict)
    edge_ids: dict[tuple[str, str], str] = field(default_factory=dict)
    zones: list[NamedZone] = field(default_factory=list)
    is_drawn: bool = True

    def add_vertex(
        self,
        name: str,
        x: Number,
        y: Number,
        *,
        barred: Iterable[str],
        surcharge: Number,
        is_passed: bool,
        heading: Number | None = None,
        turning: bool = True,
    ) -> None:
        """Add a vertex, as `FleetBuilder.add_vertex`."""
        place = f"vertex {quote(name)}"
        if not isinstance(name, str) or not name:
            raise InputError.at(place, "is no name (give text)")
        if name in self.positions:
            raise InputError.at(place, "is there already (give each vertex a name of its own)")
        self.positions[name] = (COORDINATE.read_at(place, x), COORDINATE.read_at(place, y))
        if types := NAMES.read_at((place, "barred"), barred):
            self.barred[name] = types
        if more := NOT_NEGATIVE.read_at((place, "surcharge"), surcharge):
            self.surcharges[name] = more
        if TRUTH.read_at((place, "is_passed"), is_passed):
            self.passed.append(name)
        if (angle := allow_none(NUMBER).read_at((place, "heading"), heading)) is not None:
            self.headings[name] = angle
        if not TRUTH.read_at((place, "turning"), turning):
            self.fixed.append(name)

    def add_edge(
        self,
        tail: str,
        head: str,
        length: Number | None,
        *,
        both_ways: bool,
        max_speed: Number | None,
        max_speed_by_type: Mapping[str, Number],
        barred: Iterable[str],
        surcharge: Number,
        orientation: Number | None = None,
        edge_id: str | None = None,
        turning: bool | None = None,
    ) -> None:
        """Add an edge, as `FleetBuilder.add_edge`."""
        place = f"edge {quote(tail)} to {quote(head)}"
        for name in (tail, head):
            if not isinstance(name, str) or name not in self.positions:
                near = find_nearest(name, self.positions)
                hint = f"did you mean {near!r}?" if near else "add it first"
                raise InputError.at(place, f"no vertex is named {quote(name)} ({hint})")
        given = allow_none(POSITIVE).read_at((place, "length"), length)
        if given is None:
            with locate_faults(place):
                measure_straight_length(self._measure_square(tail, head))
        limit = allow_none(POSITIVE).read_at((place, "max_speed"), max_speed)
        more = {
            "max_speed": limit,
            "max_speed_by_type": TYPE_SPEEDS.read_at(
                (place, "max_speed_by_type"), max_speed_by_type
            ),
            "barred": NAMES.read_at((place, "barred"), barred),
            "surcharge": NOT_NEGATIVE.read_at((place, "surcharge"), surcharge),
        }
        angle = allow_none(NUMBER).read_at((place, "orientation"), orientation)
        if angle is not None:
            self.orientations[tail, head] = angle
            self.orientations |= {(head, tail): angle} if both_ways else {}
        if (own := allow_none(NAME).read_at((place, "edge_id"), edge_id)) is not None:
            self.edge_ids[tail, head] = own
            self.edge_ids |= {(head, tail): own} if both_ways else {}
        may_turn = allow_none(TRUTH).read_at((place, "turning"), turning)
        if may_turn is not None:
            self.turning[tail, head] = may_turn
            self.turning |= {(head, tail): may_turn} if both_ways else {}
        self.edges.append((tail, head, given, more))
        if both_ways:
            self.edges.append((head, tail, given, more))

    def build_roadmap(
        self,
        *,
        spacing: Fraction | None,
        y_up: bool,
        distance: Fraction = Fraction(0),
    ) -> Roadmap:
        """Return the roadmap; longer edges are split into pieces of at most ``spacing``.

        Without a spacing, one is chosen for robots that have to keep a distance above 0. The
        vertices that were added come first, whatever is split; those of the
        other direction of a lane come last.
        """
        squares = [
            self._measure_square(tail, head) for tail, head, given, _ in self.edges if given is None
        ]
        step = choose_rounding_step(squares)
        edges = [
            Edge(
                tail=tail,
                head=head,
                length=given or measure_straight_length(self._measure_square(tail, head), step),
                **more,
            )
            for tail, head, given, more in self.edges
        ]
        directions = Directions(
            fixed=self.fixed,
            turning=self.turning,
            headings=self.headings,
            orientations=self.orientations,
        )
        split = split_lanes(
            self.positions,
            edges,
            spacing,
            distance=distance,
            is_drawn=self.is_drawn,
        )
        roadmap = make_roadmap_of_table(
            split.positions,
            split.edges,
            y_up=y_up,
            zones=self.zones,
            pieces=split.pieces,
            barred=self.barred,
            surcharges=self.surcharges,
            passed=self.passed,
            directions=directions,
        )
        drawing = Drawing(
            **directions.collect(roadmap),
            edge_ids=roadmap.list_whole_edges(self.edge_ids),
        )
        return replace(roadmap, drawing=drawing)

    def _measure_square(self, tail: str, head: str) -> Fraction:
        return measure_squared_distance(self.positions[tail], self.positions[head])


def read_graph(graph: Any) -> DrawnLanes:
    """Return the lanes of a `networkx` graph; drawn if all its nodes have positions."""
    if not all(hasattr(graph, name) for name in ("nodes", "edges", "is_directed")):
        raise InputError.at("graph", f"{quote(graph)} is no graph (give a networkx graph)")
    at = {node: _read_position(node, data) for node, data in graph.nodes(data=True)}
    is_drawn = all(at.values())
    lanes = DrawnLanes(is_drawn=is_drawn)
    for index, (node, position) in enumerate(at.items()):
        x, y = position if position and is_drawn else (index, 0)
        lanes.add_vertex(str(node), x, y, barred=(), surcharge=0, is_passed=False)
    for tail, head, data in graph.edges(data=True):
        lanes.add_edge(
            str(tail),
            str(head),
            data.get("length", data.get("weight", None if is_drawn else 1)),
            both_ways=not graph.is_directed(),
            max_speed=data.get("max_speed"),
            max_speed_by_type={},
            barred=(),
            surcharge=0,
        )
    return lanes


def _read_position(node: Any, data: dict[str, Any]) -> tuple[Any, Any] | None:
    """Return where a node of a graph lies, if it says so."""
    position = data.get("pos", (data["x"], data["y"]) if {"x", "y"} <= data.keys() else node)
    if isinstance(position, str) or not hasattr(position, "__len__") or len(position) != 2:  # noqa: PLR2004 (x and y)
        return None
    return position[0], position[1]
