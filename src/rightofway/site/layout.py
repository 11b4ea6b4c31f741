"""A site's own drawing of vertices, lanes, stations and zones, and the roadmap made of one level.

Lengths are metres, speeds metres per second, and y grows upwards, whatever the file has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from rightofway.deadline import READING, check_work
from rightofway.errors import InputError, find_nearest, join_names, quote
from rightofway.facts import Fact, note_pieces
from rightofway.kinds.arguments import checks_arguments
from rightofway.site.directions import Directions
from rightofway.site.drawing import Drawing, Picture
from rightofway.site.edges import EdgeTable, make_roadmap_of_table
from rightofway.site.geometry import Point
from rightofway.site.lane_table import BILLION, LaneShape, LaneTable, LayoutEdge, tabulate_lanes
from rightofway.site.roadmap import EdgeClass, Roadmap
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
    is_passed
        Whether robots only drive through, without a stop.
    heading
        Heading of robots that work there: angle from the x axis to the y axis [degrees].
    actions
        What robots do where they pick and drop loads: ``pick`` or ``drop``, and the action as JSON.
    """

    name: str
    at: Point
    is_parking: bool = False
    is_charging: bool = False
    is_passed: bool = False
    heading: Fraction | None = None
    actions: tuple[tuple[str, str], ...] = ()


class Turns(NamedTuple):
    """Where robots may turn on the spot on a lane.

    Attributes
    ----------
    at_begin, at_end
        Whether they may at its ends.
    along
        Whether they may between its ends; None where it is unknown.
    """

    at_begin: bool = True
    at_end: bool = True
    along: bool | None = None


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
        The parts of the level.
    links
        Names of tail and head of each lane that leads to another level.
    picture
        The picture that it is drawn over [m].
    orientations
        Orientations along lanes, by names of tail and head: angle from the direction of driving
        [degrees].
    edge_ids
        Ids of lanes in orders, by names of tail and head.
    turns
        Where robots may turn on a lane, by names of tail and head, then by vehicle types.
    """

    name: str
    vertices: tuple[LayoutVertex, ...]
    edges: Sequence[LayoutEdge]
    stations: tuple[Station, ...] = ()
    zones: tuple[NamedZone, ...] = ()
    links: tuple[tuple[str, str], ...] = ()
    picture: Picture | None = None
    orientations: Mapping[tuple[str, str], Fraction] = field(default_factory=dict)
    edge_ids: Mapping[tuple[str, str], str] = field(default_factory=dict)
    turns: Mapping[tuple[str, str], Mapping[str, Turns]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        names = tuple(vertex.name for vertex in self.vertices)
        object.__setattr__(self, "edges", tabulate_lanes(names, self.edges))

    @property
    def lanes(self) -> LaneTable:
        """The edges as columns."""
        assert isinstance(self.edges, LaneTable), "they have been made into columns"
        return self.edges

    @property
    def vehicle_types(self) -> tuple[str, ...]:
        """Names of the vehicle types that lanes are reserved for, sorted."""
        return self.lanes.types

    def list_lanes(self, vehicle_type: str | None) -> LaneTable:
        """Return the lanes that a vehicle type may use.

        Raises
        ------
        InputError
            If the name is unknown, or None and lanes are open to different types.
        """
        known = self.vehicle_types
        if vehicle_type is None:
            if {kind.types for kind in self.lanes.used_kinds} - {None, frozenset(known)}:
                message = "lanes differ between vehicle types (give one of"
                message += f" {join_names(known)}, or each robot a type)"
                raise InputError.at("vehicle_type", message)
            return self.lanes
        if known and vehicle_type not in known:
            near = find_nearest(vehicle_type, known)
            hint = f"did you mean {near!r}?" if near else f"give one of {join_names(known)}"
            message = f"no vehicle type is named {quote(vehicle_type)} ({hint})"
            raise InputError.at("vehicle_type", message)
        return self.lanes.select(vehicle_type)


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
        Mendings and omissions of the reader, a fact each.
    """

    kind: str
    levels: tuple[Level, ...]
    notes: tuple[Fact, ...] = ()

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
        Omissions of the roadmap, a fact each.
    split
        Its lanes and their pieces.
    """

    roadmap: Roadmap
    curves: int
    chord_error: Fraction
    notes: tuple[Fact, ...]
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
    has_sizes: bool = False,
) -> LevelRoadmap:
    """Make the roadmap of a level.

    With a spacing, lanes are split that are longer; without one it is chosen, for robots that keep
    a distance [length unit]. For robots with a size, curves are cut into straight pieces, and both
    directions of a lane have vertices of their own between pieces. Lanes that only some of the
    robots may use are barred for the others.

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
    lanes = level.lanes if selects else level.list_lanes(vehicle_type)
    check_work(READING)
    table, lost = _make_slowest_table(lanes, known_types if selects else (), metre, second)
    check_work(READING)
    # Only other vehicle types come there.
    closed = {lanes.names[vertex] for vertex in _list_ends(level.lanes) - _list_ends(lanes)}
    positions: dict[str, Point] = {
        vertex.name: (vertex.at[0] * metre, vertex.at[1] * metre)
        for vertex in level.vertices
        if vertex.name not in closed
    }
    if closed:
        table = _remove_vertices(table, tuple(positions))
    zones = _list_zones(level, positions, lanes)
    curves = _list_curves(lanes) if has_sizes else {}
    shapes = {
        ends: [(x * metre, y * metre) for x, y in shape.points] for ends, shape in curves.items()
    }
    split = split_lanes(positions, table, spacing, shapes, distance=distance)
    bends = {lanes.get_ends(lane): shape.points for lane, shape in lanes.shapes.items()
             if shape.points}  # fmt: skip
    directions = _find_directions(level, positions, vehicle_type, bends, metre)
    roadmap = make_roadmap_of_table(
        split.positions,
        split.edges,
        y_up=True,
        zones=zones,
        pieces=split.pieces,
        passed=[
            vertex.name
            for vertex in level.vertices
            if vertex.is_passed and vertex.name in positions
        ],
        directions=directions,
    )
    roadmap = replace(roadmap, drawing=_make_drawing(level, roadmap, directions, metre))
    return LevelRoadmap(
        roadmap=roadmap,
        curves=len(curves),
        chord_error=metre * max((curve.chord_error or Fraction(0) for curve in curves.values()),
                                default=Fraction(0)),
        notes=tuple(_list_lacks(level, [lanes.get_ends(lane) for lane in lost], closed)),
        split=split,
    )  # fmt: skip


def _make_slowest_table(
    lanes: LaneTable, known_types: Collection[str], metre: Fraction, second: Fraction
) -> tuple[EdgeTable, list[int]]:
    """Return the lanes as edges, and which of several parallel lanes some type does without.

    Lanes are barred for the types that are known and not theirs. Of parallel lanes, an edge asks of
    each type for no more than each lane of this type does.
    """
    lengths, rank = np.unique(lanes.lengths, return_inverse=True)
    known, kinds = np.unique(rank * len(lanes.kinds) + lanes.kind_of_lane, return_inverse=True)
    limits = [
        None if kind.max_speed is None else kind.max_speed * metre / second for kind in lanes.kinds
    ]
    barred = [
        frozenset(known_types).difference(known_types if kind.types is None else kind.types)
        for kind in lanes.kinds
    ]
    above, below = metre.numerator, BILLION * metre.denominator
    as_fractions = [Fraction(length * above, below) for length in lengths.tolist()]
    classes = [
        EdgeClass(length=as_fractions[rank], max_speed=limits[kind], barred=barred[kind])
        for rank, kind in zip(*(part.tolist() for part in np.divmod(known, len(lanes.kinds))),
                              strict=True)
    ]  # fmt: skip
    table = EdgeTable(
        names=lanes.names,
        tails=lanes.tails,
        heads=lanes.heads,
        kinds=kinds.astype(np.int32),
        classes=classes,
    )
    is_repeated, lost = table.find_repeated(), list[int]()
    if not is_repeated.any():
        return table, lost
    ends, column = lanes.ends, table.kinds.copy()
    first = {int(ends[lane]): lane for lane in np.flatnonzero(~is_repeated).tolist()}
    for lane in np.flatnonzero(is_repeated).tolist():
        earlier = first[int(ends[lane])]
        taken, further = classes[column[earlier]], classes[column[lane]]
        has_own_types = known_types and taken.barred | further.barred == set(known_types)
        if taken.length != further.length or not has_own_types:
            lost.append(lane)
        if taken != further:
            classes.append(_choose_slower(taken, further, known_types))
            column[earlier] = len(classes) - 1
    table = replace(
        table,
        tails=table.tails[~is_repeated],
        heads=table.heads[~is_repeated],
        kinds=column[~is_repeated],
    )
    return table, lost


def _remove_vertices(table: EdgeTable, names: tuple[str, ...]) -> EdgeTable:
    """Return edges with the numbers that their vertices have where others are left out."""
    number = {name: vertex for vertex, name in enumerate(names)}
    vertices = np.array([number.get(name, -1) for name in table.names], np.int32)
    return replace(table, names=names, tails=vertices[table.tails], heads=vertices[table.heads])


def _list_curves(lanes: LaneTable) -> dict[tuple[str, str], LaneShape]:
    """Return the lanes that robots drive along a curve; of parallel lanes the longest counts."""
    curved = [lane for lane, shape in lanes.shapes.items() if shape.chord_error is not None]
    if not curved:
        return {}
    ends = lanes.ends
    slowest: dict[int, int] = {}
    for lane in np.flatnonzero(np.isin(ends, ends[curved])).tolist():
        earlier = slowest.get(ends[lane])
        if earlier is None or lanes.lengths[lane] > lanes.lengths[earlier]:
            slowest[ends[lane]] = lane
    shapes = ((lanes.get_ends(lane), lanes.shapes.get(lane)) for lane in slowest.values())
    return {
        names: shape
        for names, shape in shapes
        if shape is not None and shape.chord_error is not None
    }


def _find_directions(
    level: Level,
    known: Collection[str],
    vehicle_type: str | None,
    bends: Mapping[tuple[str, str], Sequence[Point]],
    metre: Fraction,
) -> Directions:
    """Return where robots of a type may not turn; of all types, where one of them may not."""
    turns = {
        ends: [turn for name, turn in of_types.items() if vehicle_type in {None, name}]
        for ends, of_types in level.turns.items()
        if {*ends} <= {*known}
    }
    along = {ends: [own.along for own in lane] for ends, lane in turns.items()}
    return Directions(
        fixed_begins=[
            ends for ends, lane in turns.items() if any(not own.at_begin for own in lane)
        ],
        fixed_ends=[ends for ends, lane in turns.items() if any(not own.at_end for own in lane)],
        turning={ends: all(lane) for ends, lane in along.items() if lane and None not in lane},
        headings={
            vertex.name: vertex.heading
            for vertex in level.vertices
            if vertex.heading is not None and vertex.name in known
        },
        orientations={
            ends: angle for ends, angle in level.orientations.items() if {*ends} <= {*known}
        },
        bends={
            ends: tuple((x * metre, y * metre) for x, y in points)
            for ends, points in bends.items()
            if {*ends} <= {*known}
        },
    )


def _make_drawing(
    level: Level,
    roadmap: Roadmap,
    directions: Directions,
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
        curves=roadmap.list_whole_edges(directions.bends),
        **directions.collect(roadmap),
        edge_ids=roadmap.list_whole_edges(
            {ends: own for ends, own in level.edge_ids.items() if {*ends} <= ids.keys()}
        ),
        picture=level.picture and level.picture.scale(metre),
    )


def _choose_slower(first: EdgeClass, other: EdgeClass, known_types: Collection[str]) -> EdgeClass:
    """Return an edge that asks each type for no more than either of two parallel lanes does.

    Types that are not known count as the slowest one.
    """
    both = (first, other)
    barred = first.barred & other.barred
    limits = {
        name: min(
            (
                limit
                for edge in both
                if name not in edge.barred and (limit := edge.get_speed_limit(name)) is not None
            ),
            default=None,
        )
        for name in sorted(set(known_types) - barred)
    }
    slowest = min((edge.max_speed for edge in both if edge.max_speed is not None), default=None)
    if None in limits.values():
        slowest = None
    return EdgeClass(
        length=max(first.length, other.length),
        max_speed=slowest,
        max_speed_by_type=tuple(
            (name, limit)
            for name, limit in limits.items()
            if limit is not None and limit != slowest
        ),
        barred=barred,
    )


def _list_lacks(
    level: Level, lost: Sequence[tuple[str, str]], closed: Collection[str]
) -> Iterator[Fact]:
    if closed:
        yield note_pieces(Fact("only other vehicle types", vertices=len(closed)), sorted(closed))
    if lost:
        yield note_pieces(Fact("parallel lanes", lanes=len(lost)), describe_lanes(lost))
    if level.links:
        lanes = describe_lanes(level.links)
        yield note_pieces(Fact("lanes to other levels", lanes=len(lanes)), lanes)


def describe_lanes(ends: Iterable[tuple[str, str]]) -> list[Fact]:
    """Return facts that name lanes by their tails and heads."""
    return [Fact("ends of lane", tail=tail, head=head) for tail, head in ends]


def name_lanes(ends: Iterable[tuple[str, str]]) -> list[str]:
    """Return names of lanes for messages, of the names of their tails and heads."""
    return [f"{tail} to {head}" for tail, head in ends]


def _list_ends(lanes: LaneTable) -> set[int]:
    return set(np.unique(np.concatenate((lanes.tails, lanes.heads))).tolist())


def _list_zones(level: Level, vertices: Collection[str], lanes: LaneTable) -> list[NamedZone]:
    """Return the zones with their vertices and edges on the roadmap."""
    if not level.zones:
        return []
    known = set(map(lanes.get_ends, range(len(lanes))))
    zones = []
    for zone in level.zones:
        edges = tuple(dict.fromkeys(edge for edge in zone.edges if edge in known))
        names = tuple(dict.fromkeys(name for name in zone.vertices if name in vertices))
        if names or edges:
            zones.append(NamedZone(name=zone.name, vertices=names, edges=edges))
    return zones
