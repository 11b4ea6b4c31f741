"""A layout while a file is read: vertices and lanes come in, faults and repairs are collected."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import groupby, pairwise

from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, find_nearest, is_printable, quote
from rightofway.io.faults import Faults
from rightofway.io.source import LONGEST_NAME, Source
from rightofway.phrases import Phrase, say_count
from rightofway.site.drawing import Picture
from rightofway.site.geometry import (
    Point,
    choose_rounding_step,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.layout import Layout, LayoutEdge, LayoutVertex, Level, Station
from rightofway.site.zones import NamedZone

MAX_VERTICES, MAX_EDGES = 200_000, 1_000_000
"""The most vertices and lanes of a layout."""

MICRO = 1_000_000
"""Positions are kept to a micrometre: floats hold those of a whole country exactly."""

NEAR = Fraction(1, 100)
"""How far the ends of a trajectory may be from its vertices [m]."""

SHORTEST = Fraction(1, 1000)
"""Length of a lane between two vertices at one position [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftLane:
    """A lane as a file gives it.

    Attributes
    ----------
    source
        Where it stands in the file.
    tail, head, max_speed, types, shape
        As those of `LayoutEdge`.
    length
        Its length [m]; None for the straight distance.
    attribute
        Where that is an attribute of a graph, which may be no length, its name.
    curve
        Points of the curve that it is driven along, both ends included [m]; empty for none.
    chord_error
        How far at most that curve is from the straight lines between these points [m].
    """

    source: Source
    tail: str
    head: str
    length: Fraction | None = None
    attribute: str = ""
    max_speed: Fraction | None = None
    types: frozenset[str] | None = None
    shape: tuple[Point, ...] = ()
    curve: tuple[Point, ...] = ()
    chord_error: Fraction = Fraction(0)


@dataclass(slots=True)
class LevelDraft:
    """What was read of one level so far."""

    name: str
    vertices: dict[str, LayoutVertex] = field(default_factory=dict)
    lanes: list[DraftLane] = field(default_factory=list)
    stations: list[Station] = field(default_factory=list)
    zones: list[NamedZone] = field(default_factory=list)
    picture: Picture | None = None

    def add(self, vertex: LayoutVertex, source: Source) -> None:
        """Take a vertex; InputError if its name is taken, or there are too many."""
        if vertex.name in self.vertices:
            message = f"a vertex is named {quote(vertex.name)} already (rename one)"
            raise source.make_fault(message)
        if any(MICRO % number.denominator for number in vertex.at):
            x, y = (Fraction(round(number * MICRO), MICRO) for number in vertex.at)
            vertex = replace(vertex, at=(x, y))
        if len(self.vertices) == MAX_VERTICES:
            raise source.make_fault(f"more than {MAX_VERTICES} vertices (give a part of it)")
        self.vertices[vertex.name] = vertex

    def connect(self, lane: DraftLane) -> None:
        """Take a lane; InputError if there are too many."""
        if len(self.lanes) == MAX_EDGES:
            raise lane.source.make_fault(f"more than {MAX_EDGES} lanes (give a part of it)")
        self.lanes.append(lane)


def _in_micrometres(point: Point) -> tuple[int, int]:
    return int(point[0] * MICRO), int(point[1] * MICRO)


def _square(start: tuple[int, int], other: tuple[int, int]) -> int:
    """Return the squared distance of two points; whole numbers are quicker than fractions."""
    return (start[0] - other[0]) ** 2 + (start[1] - other[1]) ** 2


def _is_short(length: Fraction, square: int) -> bool:
    """Return whether a length is below the straight one by more than rounding makes of it."""
    above, below = length.numerator, length.denominator
    step, part = SHORTEST.numerator * MICRO, SHORTEST.denominator
    # ((length + SHORTEST) * MICRO) ** 2 < square, in whole numbers
    return above < 0 or (above * part * MICRO + below * step) ** 2 < square * (below * part) ** 2


class _Straight(dict[int, Fraction]):
    """The straight length [m] of each squared distance [square micrometres]."""

    def __init__(self, step: Fraction) -> None:
        super().__init__({0: Fraction(0)})
        self.step = step

    def __missing__(self, square: int) -> Fraction:
        self[square] = length = measure_straight_length(Fraction(square, MICRO**2), self.step)
        return length


class LayoutDraft:
    """A layout while a file is read.

    Parameters
    ----------
    kind
        Name of the format.
    """

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.faults = Faults()
        self.levels: list[LevelDraft] = []
        self.repairs: Counter[Phrase] = Counter()

    def begin_level(self, name: str = "") -> LevelDraft:
        """Begin a level; InputError for a name that cannot be shown."""
        if name and not (is_printable(name) and len(name) <= LONGEST_NAME):
            raise InputError.at("levels", f"{quote(name)} is no name (give printable text)")
        self.levels.append(LevelDraft(name))
        return self.levels[-1]

    def repair(self, mending: Phrase) -> None:
        """Note that something was mended or left out; equal notes are say_count."""
        self.repairs[mending] += 1

    def make_layout(self) -> Layout:
        """Return the layout.

        Raises
        ------
        InputError
            With all faults noted so far, and lanes that begin or end nowhere.
        """
        elsewhere = {name for level in self.levels for name in level.vertices}
        if self.faults.found:  # lanes to vertices with a fault are no further faults
            elsewhere.update(end for level in self.levels for lane in level.lanes
                             for end in (lane.tail, lane.head))  # fmt: skip
        levels = [self._finish(level, elsewhere) for level in self.levels if level.vertices]
        self.faults.stop()
        if not levels:
            raise InputError.at("", f"the {self.kind} has no vertex (give at least one)")
        notes = (
            repair
            if count == 1
            else Phrase("{count} times: {repair}", count=str(count), repair=repair)
            for repair, count in self.repairs.items()
        )
        return Layout(kind=self.kind, levels=tuple(levels), notes=tuple(notes))

    def _finish(self, level: LevelDraft, elsewhere: set[str]) -> Level:
        vertices, edges, links = level.vertices, list[LayoutEdge](), 0
        micro = {name: _in_micrometres(vertex.at) for name, vertex in vertices.items()}
        squares = [
            _square(micro[lane.tail], micro[lane.head])
            if lane.tail in vertices and lane.head in vertices
            else 0
            for lane in limit_loop(level.lanes, READING)
        ]
        nearest_ends = min((square for square in squares if square), default=0)
        straight = _Straight(choose_rounding_step([Fraction(nearest_ends, MICRO**2)]))
        no_lengths = self._no_lengths(level.lanes, squares)
        for lane, square in limit_loop(zip(level.lanes, squares, strict=True), READING):
            missing = [end for end in (lane.tail, lane.head) if end not in vertices]
            if any(end not in elsewhere for end in missing):
                near = find_nearest(missing[0], vertices)
                hint = f"did you mean {near!r}?" if near else "name one that the file has"
                message = f"no vertex is named {quote(missing[0])} ({hint})"
                self.faults.note(lane.source.location, message)
            elif missing:
                links += 1
            elif lane.tail == lane.head:
                self.repair(Phrase("a lane from a vertex to itself is left out"))
            elif lane.max_speed is not None and lane.max_speed <= 0:
                message = f"speed limit {lane.max_speed} is not positive (give m/s)"
                self.faults.note(lane.source.location, message)
            else:
                length = None if lane.attribute in no_lengths else lane.length
                edge = self._edge(lane, length, square, straight[square])
                if lane.curve:
                    edge = self._add_curve(edge, lane, vertices)
                edges.append(edge)
        return Level(
            name=level.name,
            vertices=tuple(vertices.values()),
            edges=tuple(edges),
            stations=tuple(self._usable_stations(level)),
            zones=tuple(self._usable_zones(level)),
            links=links,
            picture=level.picture,
        )

    def _no_lengths(self, lanes: Sequence[DraftLane], squares: Sequence[int]) -> set[str]:
        """Return attributes that contradict the positions of one lane: they mean something else."""
        wrong = Counter(
            lane.attribute
            for lane, square in zip(lanes, squares, strict=True)
            if lane.attribute and lane.length is not None and _is_short(lane.length, square)
        )
        for name, count in wrong.items():
            self.repair(
                Phrase(
                    "the attribute {attribute} is no length: by it, {lanes} shorter than the"
                    " straight line; all lanes get the straight length",
                    attribute=quote(name),
                    lanes=say_count(count, "lane is", "lanes are"),
                )
            )
        return set(wrong)

    def _edge(
        self, lane: DraftLane, length: Fraction | None, square: int, straight: Fraction
    ) -> LayoutEdge:
        if square == 0:
            self.repair(Phrase("a lane between two vertices at one position counts as 1 mm long"))
            length = max(length or SHORTEST, SHORTEST)
        elif length is not None and length < straight:
            if _is_short(length, square):
                self.repair(
                    Phrase("a lane shorter than the straight line gets the straight length")
                )
            length = None
        return LayoutEdge(
            tail=lane.tail,
            head=lane.head,
            length=straight if length is None else length,
            max_speed=lane.max_speed,
            types=lane.types,
            shape=lane.shape,
        )

    def _add_curve(
        self, edge: LayoutEdge, lane: DraftLane, vertices: dict[str, LayoutVertex]
    ) -> LayoutEdge:
        """Return an edge with its curve, if that leads from its tail to its head."""
        ends = vertices[lane.tail].at, vertices[lane.head].at
        gaps = (
            measure_squared_distance(*gap)
            for gap in zip(ends, (lane.curve[0], lane.curve[-1]), strict=True)
        )
        if max(gaps) > NEAR**2:
            self.repair(
                Phrase("a trajectory that does not lead from start to end counts as straight")
            )
            return edge
        points = [at for at, _ in groupby((ends[0], *lane.curve[1:-1], ends[1]))]
        squares = [measure_squared_distance(*pair) for pair in pairwise(points)]
        step = choose_rounding_step(squares)
        return replace(
            edge,
            length=max(
                edge.length,
                sum((measure_straight_length(square, step) for square in squares), Fraction(0)),
            ),
            shape=tuple(points[1:-1]),
            chord_error=lane.chord_error,
        )

    def _usable_stations(self, level: LevelDraft) -> list[Station]:
        """Return the stations with a vertex of the level; a name that is taken is left out."""
        stations: dict[str, Station] = {}
        for station in level.stations:
            vertices = tuple(name for name in station.vertices if name in level.vertices)
            if not vertices:
                self.repair(Phrase("a station without a vertex on its level is left out"))
            elif station.name in stations:
                self.repair(Phrase("a second station of one name is left out"))
            else:
                stations[station.name] = replace(station, vertices=vertices)
        return list(stations.values())

    def _usable_zones(self, level: LevelDraft) -> list[NamedZone]:
        """Return the zones with vertices or lanes, each name once."""
        zones: dict[str, NamedZone] = {}
        for zone in level.zones:
            vertices = tuple(name for name in zone.vertices if name in level.vertices)
            if zone.name in zones or not (vertices or zone.edges):
                self.repair(
                    Phrase("a zone without vertices and lanes, or with a name twice, is left out")
                )
            else:
                zones[zone.name] = replace(zone, vertices=vertices)
        return list(zones.values())
