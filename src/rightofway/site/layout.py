"""A site's own drawing of vertices, lanes, stations and zones, and the roadmap made of one level.

Lengths are metres, speeds metres per second, and y grows upwards, whatever the file has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from rightofway.arguments import checks_arguments
from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, find_nearest, join_names, quote
from rightofway.phrases import Phrase, say_count
from rightofway.site.drawing import Drawing, Picture
from rightofway.site.edges import Edge, make_roadmap
from rightofway.site.geometry import Point
from rightofway.site.roadmap import Roadmap
from rightofway.site.spacing import SplitLanes, split_lanes
from rightofway.site.zones import NamedZone


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutVertex:
    """A named point that robots stop at or pass.

    Attributes
    ----------
    name
        A name of its own on its level.
    at
        Where it lies in the site's frame [m].
    is_parking, is_charging
        Whether a robot may park, or can be charged, there.
    """

    name: str
    at: Point
    is_parking: bool = False
    is_charging: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutEdge:
    """A directed lane.

    Attributes
    ----------
    tail, head
        Names of the vertices it leaves and enters.
    length
        Its length [m], not below the straight distance.
    max_speed
        Speed limit [m/s]; None for none.
    types
        Vehicle types that may use it; None for all.
    shape
        Points between its ends where it is drawn [m]; empty for a straight lane.
    chord_error
        How far at most a curve that robots drive along is from the straight lines between these
        points [m]; None where robots drive straight, whatever is drawn.
    """

    tail: str
    head: str
    length: Fraction
    max_speed: Fraction | None = None
    types: frozenset[str] | None = None
    shape: tuple[Point, ...] = ()
    chord_error: Fraction | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Station:
    """A named place to work at.

    Attributes
    ----------
    name
        Its name.
    vertices
        Names of the vertices from which it is served; the first one stands for it.
    """

    name: str
    vertices: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Level:
    """One floor of a building, or one of several layouts in a file.

    Attributes
    ----------
    name
        Its name; empty where the file names none.
    vertices, edges, stations, zones
        What lies on it.
    links
        Lanes that lead to other levels.
    picture
        The picture that it is drawn over [m].
    """

    name: str
    vertices: tuple[LayoutVertex, ...]
    edges: tuple[LayoutEdge, ...]
    stations: tuple[Station, ...] = ()
    zones: tuple[NamedZone, ...] = ()
    links: int = 0
    picture: Picture | None = None

    @property
    def vehicle_types(self) -> tuple[str, ...]:
        """Names of the vehicle types that lanes are reserved for, sorted."""
        return tuple(sorted({name for edge in self.edges for name in edge.types or ()}))

    def list_lanes(self, vehicle_type: str | None) -> tuple[LayoutEdge, ...]:
        """Return the lanes that a vehicle type may use.

        Raises
        ------
        InputError
            If the name is unknown, or None and lanes are open to different types.
        """
        known = self.vehicle_types
        if vehicle_type is None:
            if len({edge.types for edge in self.edges} - {None, frozenset(known)}) > 0:
                message = "lanes differ between vehicle types (give one of"
                message += f" {join_names(known)}, or each robot a type)"
                raise InputError.at("vehicle_type", message)
            return self.edges
        if known and vehicle_type not in known:
            near = find_nearest(vehicle_type, known)
            hint = f"did you mean {near!r}?" if near else f"give one of {join_names(known)}"
            message = f"no vehicle type is named {quote(vehicle_type)} ({hint})"
            raise InputError.at("vehicle_type", message)
        return tuple(
            edge for edge in self.edges if edge.types is None or vehicle_type in edge.types
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A site's drawing of vertices and lanes.

    Attributes
    ----------
    kind
        The format it was read from: ``LIF``.
    levels
        Its levels, at least one.
    notes
        What the reader mended or left out, a sentence each.
    """

    kind: str
    levels: tuple[Level, ...]
    notes: tuple[Phrase, ...] = ()

    @checks_arguments
    def get_level(self, name: str | None = None) -> Level:
        """Return a level by name; None for the only one.

        Raises
        ------
        InputError
            If there is no such level, or there are several and none is named.
        """
        known = [level.name for level in self.levels]
        if name is None and len(known) == 1:
            return self.levels[0]
        if name is None:
            message = f"the layout has {len(known)} levels, and a plan stays on one"
            raise InputError.at("level", f"{message} (give one of {join_names(known)})")
        if name not in known:
            near = find_nearest(name, known)
            hint = f"did you mean {near!r}?" if near else f"give one of {join_names(known)}"
            raise InputError.at("level", f"no level is named {quote(name)} ({hint})")
        return self.levels[known.index(name)]


class LevelRoadmap(NamedTuple):
    """The roadmap of a level.

    Attributes
    ----------
    roadmap
        The roadmap.
    curves
        How many lanes were split into the straight pieces of a curve.
    chord_error
        How far at most these pieces are from their curves [length unit].
    notes
        What the roadmap lacks, a sentence each.
    split
        Its lanes and their pieces.
    """

    roadmap: Roadmap
    curves: int
    chord_error: Fraction
    notes: tuple[Phrase, ...]
    split: SplitLanes


def build_roadmap_of_level(
    level: Level,
    *,
    vehicle_type: str | None = None,
    robot_types: Collection[str | None] = (),
    metre: Fraction = Fraction(1),
    second: Fraction = Fraction(1),
    spacing: Fraction | None = None,
    distance: Fraction = Fraction(0),
    cuts_curves: bool = False,
) -> LevelRoadmap:
    """Make the roadmap of a level.

    With a spacing, lanes are split that are longer; without one, those that others cross, for
    robots that keep a distance [length unit]. For robots with a size, curves are cut into straight
    pieces. Lanes that only some of the robots may use are barred for the others.

    Raises
    ------
    InputError
        If the vehicle type is not known, or the level has no vertex.
    """
    known_types, selects = level.vehicle_types, False
    if vehicle_type is None and robot_types and None not in robot_types:
        for name in sorted(name for name in robot_types if name is not None):
            level.list_lanes(name)
        selects = bool(known_types)
    lanes = level.edges if selects else level.list_lanes(vehicle_type)
    slowest: dict[tuple[str, str], Edge] = {}
    # Fractions are slow to hash: lanes often share theirs, and are told apart by identity.
    kinds = dict[tuple[int, ...], Edge]()
    for lane in limit_loop(lanes, READING):
        numbers = (id(lane.length), id(lane.max_speed), id(lane.types))
        kind = kinds.get(numbers)
        if kind is None:
            is_open = lane.types is None or not selects
            kind = kinds[numbers] = Edge(
                tail=lane.tail,
                head=lane.head,
                length=lane.length if metre == 1 else lane.length * metre,
                max_speed=None if lane.max_speed is None else lane.max_speed * metre / second,
                barred=frozenset() if is_open else frozenset(known_types) - (lane.types or set()),
            )
        edge = kind.make_piece(lane.tail, lane.head, kind.length, kind.surcharge)
        known = slowest.get((lane.tail, lane.head))
        slowest[lane.tail, lane.head] = _slower(known, edge) if known else edge
    closed = _ends(level.edges) - _ends(lanes)  # only other vehicle types come there
    positions: dict[str, Point] = {
        vertex.name: (vertex.at[0] * metre, vertex.at[1] * metre)
        for vertex in level.vertices
        if vertex.name not in closed
    }
    edges, zones = list(slowest.values()), _zones(level, positions, slowest)
    curves = _curves(lanes, slowest) if cuts_curves else {}
    split = SplitLanes(positions, edges, {})
    if spacing is not None or curves or distance > 0:
        shapes = {
            ends: [(x * metre, y * metre) for x, y in lane.shape] for ends, lane in curves.items()
        }
        split = split_lanes(positions, edges, spacing, shapes, distance=distance)
    drawn = {name: (float(x), float(y)) for name, (x, y) in split.positions.items()}
    roadmap = make_roadmap(drawn, split.edges, y_up=True, zones=zones, pieces=split.pieces)
    bends = {(lane.tail, lane.head): lane.shape for lane in lanes if lane.shape}
    roadmap = replace(roadmap, drawing=_drawing(level, roadmap, bends, metre))
    return LevelRoadmap(
        roadmap=roadmap,
        curves=len(curves),
        chord_error=metre * max((curve.chord_error or Fraction(0) for curve in curves.values()),
                                default=Fraction(0)),
        notes=tuple(_lacks(level, lanes, slowest, closed)),
        split=split,
    )  # fmt: skip


def _curves(
    lanes: Sequence[LayoutEdge], pairs: Collection[tuple[str, str]]
) -> dict[tuple[str, str], LayoutEdge]:
    """Return the lanes that robots drive along a curve; of parallel lanes the longest counts."""
    if all(lane.chord_error is None for lane in lanes):
        return {}
    slowest: dict[tuple[str, str], LayoutEdge] = {}
    for lane in lanes:
        ends = (lane.tail, lane.head)
        if ends in pairs and (ends not in slowest or lane.length > slowest[ends].length):
            slowest[ends] = lane
    return {ends: lane for ends, lane in slowest.items() if lane.chord_error is not None}


def _drawing(
    level: Level,
    roadmap: Roadmap,
    bends: Mapping[tuple[str, str], Sequence[Point]],
    metre: Fraction,
) -> Drawing:
    """Return the places and curves of a level that its roadmap has, and its picture."""
    ids = {name: roadmap.get_vertex(name) for name in roadmap.labels or ()}
    stations = {
        station.name: next(ids[name] for name in station.vertices if name in ids)
        for station in level.stations
        if not ids.keys().isdisjoint(station.vertices)
    }
    known = [vertex for vertex in level.vertices if vertex.name in ids]
    return Drawing(
        stations=tuple(stations.items()),
        parking=tuple(ids[vertex.name] for vertex in known if vertex.is_parking),
        charging=tuple(ids[vertex.name] for vertex in known if vertex.is_charging),
        curves=tuple(
            (ids[tail], ids[head], tuple((x * metre, y * metre) for x, y in points))
            for (tail, head), points in bends.items()
            if {tail, head} <= ids.keys() and roadmap.find_edge(ids[tail], ids[head]) is not None
        ),
        picture=level.picture and level.picture.scale(metre),
    )


def _slower(first: Edge, other: Edge) -> Edge:
    """Return an edge that asks a robot for no more than either of two parallel lanes does."""
    limits = [edge.max_speed for edge in (first, other) if edge.max_speed is not None]
    length = max(first.length, other.length)
    barred = first.barred & other.barred
    return replace(first, length=length, max_speed=min(limits, default=None), barred=barred)


def _lacks(
    level: Level,
    lanes: Sequence[LayoutEdge],
    pairs: Collection[tuple[str, str]],
    closed: Collection[str],
) -> Iterator[Phrase]:
    if closed:
        yield Phrase(
            "{vertices} left out: only lanes of other vehicle types lead there",
            vertices=say_count(len(closed), "vertex", "vertices"),
        )
    parallel = len(lanes) - len(set(pairs))
    if parallel:
        yield Phrase(
            "{lanes} left out: the slowest of each counts",
            lanes=say_count(parallel, "parallel lane", "parallel lanes"),
        )
    if level.links:
        yield Phrase(
            "{lanes} to other levels left out: plans stay on one level",
            lanes=say_count(level.links, "lane", "lanes"),
        )


def _ends(lanes: Sequence[LayoutEdge]) -> set[str]:
    return {end for lane in lanes for end in (lane.tail, lane.head)}


def _zones(
    level: Level, vertices: Collection[str], lanes: Collection[tuple[str, str]]
) -> list[NamedZone]:
    """Return the zones with what the roadmap has of them."""
    zones = []
    for zone in level.zones:
        edges = tuple(dict.fromkeys(edge for edge in zone.edges if edge in lanes))
        names = tuple(dict.fromkeys(name for name in zone.vertices if name in vertices))
        if names or edges:
            zones.append(NamedZone(name=zone.name, vertices=names, edges=edges))
    return zones
