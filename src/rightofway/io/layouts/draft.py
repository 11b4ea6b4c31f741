"""A layout while a file is read: vertices and lanes come in, faults and repairs are collected."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import groupby, pairwise
from math import ceil, isqrt
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import READING, STEPS_BETWEEN_LOOKS, check_work, limit_loop
from rightofway.errors import InputError, find_nearest, is_printable, quote
from rightofway.facts import Fact, note_pieces
from rightofway.io.faults import Faults
from rightofway.io.source import LONGEST_NAME, Source
from rightofway.site.drawing import Picture
from rightofway.site.geometry import (
    Point,
    choose_rounding_step,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.lane_table import BILLION, LaneKind, LaneShape, LaneTable
from rightofway.site.layout import (
    Layout,
    LayoutVertex,
    Level,
    Station,
    Turns,
    describe_lanes,
)
from rightofway.site.zones import NamedZone

T = TypeVar("T")

MAX_VERTICES, MAX_EDGES = 200_000, 1_000_000
"""The most vertices and lanes of a layout."""

MOST_NOTES = 50
"""Notes of different keys that have no effect; further keys share one."""

MICRO = 1_000_000
"""Positions are kept to a micrometre: floats hold those of a whole country exactly."""

NEAR = Fraction(1, 100)
"""The largest distance of the ends of a trajectory from its vertices [m]."""

SHORTEST = BILLION // 1000
"""Length of a lane between two vertices at one position [billionths of a metre]."""

LONGEST_FAST = 1_500_000_000
"""Up to this difference of coordinates [micrometres], squares of distances fit 64 bits."""

Integers = NDArray[Any]
"""Whole numbers: int64, or of any size where they may not fit that."""

Bools = NDArray[np.bool_]


class Curve(NamedTuple):
    """The curve that a lane is driven along.

    Attributes
    ----------
    points
        Points of the curve, both ends included [m].
    chord_error
        How far at most it is from the straight lines between these points [m].
    """

    points: tuple[Point, ...]
    chord_error: Fraction


@dataclass(slots=True)
class DraftLanes:
    """The lanes that a file gives, as columns with an item for each lane.

    Attributes
    ----------
    sources
        Where it stands in the file.
    tails, heads
        Names of the vertices that it leaves and enters.
    lengths
        Its length [m]; None for the straight distance.
    attributes
        Where that is an attribute of a graph, which may be no length, its name.
    kinds
        Its properties in common with others; an index into `kind_values`.
    shapes, curves
        How lanes are drawn and driven that are not straight, by index.
    """

    sources: list[Source] = field(default_factory=list)
    tails: list[str] = field(default_factory=list)
    heads: list[str] = field(default_factory=list)
    lengths: list[Fraction | None] = field(default_factory=list)
    attributes: list[str] = field(default_factory=list)
    kinds: list[int] = field(default_factory=list)
    kind_values: list[LaneKind] = field(default_factory=list)
    shapes: dict[int, tuple[Point, ...]] = field(default_factory=dict)
    curves: dict[int, Curve] = field(default_factory=dict)
    # Fractions are slow to hash: lanes often share theirs, and are told apart by identity.
    _kind_of: dict[tuple[int, int], int] = field(default_factory=dict)

    def extend(
        self, columns: Iterable[tuple[str, str, Fraction | None, Fraction | None]], attribute: str
    ) -> None:
        """Add lanes without faults by tail, head, length and speed limit."""
        tails, heads, lengths, speeds = zip(*columns, strict=True)
        self.sources += [Source(None)] * len(tails)
        self.tails += tails
        self.heads += heads
        self.lengths += lengths
        self.attributes += [attribute] * len(tails)
        self.kinds += [self.add_kind(speed, None) for speed in speeds]

    def add_kind(self, max_speed: Fraction | None, types: frozenset[str] | None) -> int:
        """Return the number of a kind."""
        key = id(max_speed), id(types)
        kind = self._kind_of.get(key)
        if kind is None:
            kind = self._kind_of[key] = len(self.kind_values)
            self.kind_values.append(LaneKind(max_speed, types))  # which keeps both alive
        return kind


@dataclass(slots=True)
class LevelDraft:
    """The parts of one level that were read so far."""

    name: str
    vertices: dict[str, LayoutVertex] = field(default_factory=dict)
    lanes: DraftLanes = field(default_factory=DraftLanes)
    stations: list[Station] = field(default_factory=list)
    zones: list[NamedZone] = field(default_factory=list)
    picture: Picture | None = None
    orientations: dict[tuple[str, str], Fraction] = field(default_factory=dict)
    edge_ids: dict[tuple[str, str], str] = field(default_factory=dict)
    turns: dict[tuple[str, str], dict[str, Turns]] = field(default_factory=dict)
    unused: int = 0  # vertices that are drawn and on no lane, of a format that has other ones, too

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

    def connect(
        self,
        source: Source,
        tail: str,
        head: str,
        *,
        length: Fraction | None = None,
        attribute: str = "",
        max_speed: Fraction | None = None,
        types: frozenset[str] | None = None,
        shape: tuple[Point, ...] = (),
        curve: Curve | None = None,
    ) -> None:
        """Take a lane; InputError if there are too many."""
        lanes = self.lanes
        number = len(lanes.tails)
        if number % STEPS_BETWEEN_LOOKS == 0:
            check_work(READING)
        if number == MAX_EDGES:
            raise source.make_fault(f"more than {MAX_EDGES} lanes (give a part of it)")
        lanes.sources.append(source)
        lanes.tails.append(tail)
        lanes.heads.append(head)
        lanes.lengths.append(length)
        lanes.attributes.append(attribute)
        lanes.kinds.append(lanes.add_kind(max_speed, types))
        if shape:
            lanes.shapes[number] = shape
        if curve is not None:
            lanes.curves[number] = curve


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
        self.repairs: dict[Fact, list[str | Fact]] = {}
        self.failed: set[str | None] = set()
        self.unused: dict[str, list[str]] = {}  # by key the pieces that have it

    def begin_level(self, name: str = "") -> LevelDraft:
        """Begin a level; InputError for a name that cannot be shown."""
        if name and not (is_printable(name) and len(name) <= LONGEST_NAME):
            raise InputError.at("levels", f"{quote(name)} is no name (give printable text)")
        self.levels.append(LevelDraft(name))
        return self.levels[-1]

    def repair(self, mending: Fact, *pieces: str | Fact) -> None:
        """Note that pieces were mended or left out, by their names; equal notes become one."""
        self.repairs.setdefault(mending, []).extend(pieces)

    def attempt_vertex(self, name: str | None, read: Callable[..., T], *arguments: Any) -> T | None:
        """Return ``read(*arguments)``, or None after noting its faults and the name of the vertex.

        Lanes to a vertex with a fault are no further faults. None: the name is not known.
        """
        before = len(self.faults)
        value = self.faults.attempt("", read, *arguments)
        if len(self.faults) > before:
            self.failed.add(name)
        return value

    def note_unused(self, source: Source, name: str, used: Collection[str]) -> None:
        """Note the keys of a piece that have no effect on plans, apart from those that are used.

        Keys without a value, and those that are false or 0, count as not there.
        """
        for key, value in source.read_mapping().items():
            if value and key not in used:
                self.note_unused_key(key, name)

    def note_unused_key(self, key: str, name: str) -> None:
        """Note a key of a piece that has no effect on plans."""
        pieces = self.unused.get(key)
        if pieces is None and len(self.unused) >= MOST_NOTES:
            self.repair(Fact("further unused key"), f"{name}: {quote(key)}")
        elif pieces is None:
            self.unused[key] = [name]
        elif pieces[-1] != name:  # a key may be there for several types
            pieces.append(name)

    def make_layout(self) -> Layout:
        """Return the layout.

        Raises
        ------
        InputError
            With all faults noted so far, and lanes that begin or end nowhere.
        """
        elsewhere = {name for level in self.levels for name in level.vertices}
        elsewhere.update(name for name in self.failed if name is not None)
        if None in self.failed:  # lanes to vertices with a fault are no further faults
            for level in self.levels:
                elsewhere.update(level.lanes.tails, level.lanes.heads)
        levels = [self._finish(level, elsewhere) for level in self.levels if level.vertices]
        self.faults.stop()
        if not levels:
            raise self._make_fault_of_none()
        for level in self.levels:
            if not level.vertices:
                self.repair(Fact("level without lane"), level.name)
        unused = {
            Fact("unused key", key=quote(key).strip("'")): pieces
            for key, pieces in self.unused.items()
        }
        notes = (
            _name_pieces(mending, pieces) for mending, pieces in (unused | self.repairs).items()
        )
        return Layout(kind=self.kind, levels=tuple(levels), notes=tuple(notes))

    def _make_fault_of_none(self) -> InputError:
        """Return the fault of a layout without a vertex that robots could be at."""
        unused = sum(level.unused for level in self.levels)
        fault, remedy = "has no vertex", "give at least one"
        if unused:
            fault, remedy = (
                f"has {unused} vertices, and none is on a lane",
                "add lanes between them",
            )
        return InputError.at("", f"the {self.kind} {fault} ({remedy})")

    def _finish(self, level: LevelDraft, elsewhere: set[str]) -> Level:
        edges, links = _LaneFinisher(self, level).finish(elsewhere)
        return Level(
            name=level.name,
            vertices=tuple(level.vertices.values()),
            edges=edges,
            stations=tuple(self._list_usable_stations(level)),
            zones=tuple(self._list_usable_zones(level)),
            links=links,
            picture=level.picture,
            orientations=level.orientations,
            edge_ids=level.edge_ids,
            turns=level.turns,
        )

    def _list_usable_stations(self, level: LevelDraft) -> list[Station]:
        """Return the stations with a vertex of the level; a name that is taken is left out."""
        stations: dict[str, Station] = {}
        for station in level.stations:
            vertices = self._keep_vertices(level, station)
            if not vertices:
                mending = Fact("station without vertex")
                self.repair(mending, station.name)
            elif station.name in stations:
                self.repair(Fact("second station of one name"), station.name)
            else:
                stations[station.name] = replace(station, vertices=vertices)
        return list(stations.values())

    def _keep_vertices(self, level: LevelDraft, owner: Station | NamedZone) -> tuple[str, ...]:
        """Return the vertices of a station or a zone that are on its level."""
        vertices = tuple(name for name in owner.vertices if name in level.vertices)
        if vertices:
            mending = Fact("vertex not on its level")
            for name in owner.vertices:
                if name not in level.vertices:
                    self.repair(mending, Fact("name with detail", name=name, what=owner.name))
        return vertices

    def _list_usable_zones(self, level: LevelDraft) -> list[NamedZone]:
        """Return the zones with vertices or lanes, each name once."""
        zones: dict[str, NamedZone] = {}
        for zone in level.zones:
            vertices = self._keep_vertices(level, zone)
            if zone.name in zones or not (vertices or zone.edges):
                self.repair(Fact("zone left out"), zone.name)
            else:
                zones[zone.name] = replace(zone, vertices=vertices)
        return list(zones.values())


def find_name(source: Source, *keys: str) -> str | None:
    """Return the value of the first key that names a piece; None without one."""
    names = (source.value.get(key) for key in keys) if isinstance(source.value, dict) else ()
    for name in names:
        if type(name) in {int, str} and is_printable(str(name)):
            return str(name)[:LONGEST_NAME]
    return None


def name_piece(source: Source, *keys: str) -> str:
    """Return the name of a piece: the value of the first key that names it, or its place."""
    return find_name(source, *keys) or str(source.location)


def _name_pieces(mending: Fact, pieces: Sequence[str | Fact]) -> Fact:
    if len(pieces) > 1:
        mending = Fact("several times", count=len(pieces), repair=mending)
    return note_pieces(mending, pieces) if pieces else mending


class _LaneFinisher:
    """The lanes of a level made fit to drive along, all at once."""

    def __init__(self, draft: LayoutDraft, level: LevelDraft) -> None:
        self.draft, self.level, self.lanes = draft, level, level.lanes
        ids = {name: number for number, name in enumerate(level.vertices)}
        self.tails, self.heads = (
            np.array([ids.get(name, -1) for name in limit_loop(names, READING)], np.int32)
            for names in (self.lanes.tails, self.lanes.heads)
        )
        self.is_here = (self.tails >= 0) & (self.heads >= 0)
        self.squares = self._measure_squares()
        self.roots = _find_roots(self.squares)
        self.repairs: list[tuple[int, Fact, list[Fact]]] = []

    def _measure_squares(self) -> Integers:
        """Return the squared distance of the ends of each lane [square micrometres]."""
        at = np.array(
            [[int(number * MICRO) for number in vertex.at]
             for vertex in self.level.vertices.values()], np.int64
        )  # fmt: skip
        steps = at[self.tails] - at[self.heads]
        steps[~self.is_here] = 0
        if np.abs(steps).max(initial=0) > LONGEST_FAST:
            steps = steps.astype(object)
        squares: Integers = steps[:, 0] ** 2 + steps[:, 1] ** 2
        return squares

    def finish(self, elsewhere: set[str]) -> tuple[LaneTable, tuple[tuple[str, str], ...]]:
        """Return the lanes of the level, and the ends of those to other levels."""
        is_kept, links = self._drop_undrivable(elsewhere)
        lengths = self._choose_lengths(is_kept)
        lanes_kept = np.flatnonzero(is_kept)
        shapes, lengths = self._draw_curves(is_kept, lengths)
        for _, mending, pieces in sorted(self.repairs, key=lambda repair: repair[0]):
            self.draft.repair(mending, *pieces)
        new_number = np.cumsum(is_kept) - 1
        kinds = np.array(self.lanes.kinds, np.int32)[lanes_kept]
        return (
            LaneTable(
                names=tuple(self.level.vertices),
                tails=self.tails[lanes_kept],
                heads=self.heads[lanes_kept],
                lengths=lengths[lanes_kept].astype(np.int64),
                kind_of_lane=kinds,
                kinds=tuple(self.lanes.kind_values),
                shapes={int(new_number[lane]): shape for lane, shape in sorted(shapes.items())},
            ),
            links,
        )

    def _drop_undrivable(self, elsewhere: set[str]) -> tuple[Bools, tuple[tuple[str, str], ...]]:
        """Return the lanes that can be driven along, and the ends of those to other levels."""
        lanes, vertices = self.lanes, self.level.vertices
        links = list[tuple[str, str]]()
        is_loop = self.is_here & (self.tails == self.heads)
        limits = [kind.max_speed for kind in lanes.kind_values]
        is_slow = np.array([limit is not None and limit <= 0 for limit in limits], bool)
        kinds = np.array(lanes.kinds, np.int32)
        is_kept = self.is_here & ~is_loop
        if is_slow.any():
            is_kept &= ~is_slow[kinds]
        for lane in np.flatnonzero(~is_kept).tolist():
            ends = (lanes.tails[lane], lanes.heads[lane])
            missing = [end for end in dict.fromkeys(ends) if end not in vertices]
            unknown = [end for end in missing if end not in elsewhere]
            for end in unknown:
                near = find_nearest(end, vertices)
                hint = f"did you mean {near!r}?" if near else "name one that the file has"
                message = f"no vertex is named {quote(end)} ({hint})"
                self.draft.faults.note(lanes.sources[lane].location, message)
            if unknown:
                continue
            if missing:
                links.append(ends)
            elif not is_loop[lane]:
                message = f"speed limit {limits[kinds[lane]]} is not positive (give m/s)"
                self.draft.faults.note(lanes.sources[lane].location, message)
        mending = Fact("lane to itself")
        self._note_mended(is_loop, mending)
        return is_kept, tuple(links)

    def _note_mended(self, lanes: Bools, mending: Fact) -> None:
        """Note which lanes were mended, in the order of the file."""
        if lanes.any():
            numbers = np.flatnonzero(lanes).tolist()
            ends = ((self.lanes.tails[lane], self.lanes.heads[lane]) for lane in numbers)
            self.repairs.append((numbers[0], mending, describe_lanes(limit_loop(ends, READING))))

    def _choose_lengths(self, is_kept: Bools) -> Integers:
        """Return the length of each lane [billionths of a metre], not below the straight one."""
        apart = self.squares[self.squares > 0]
        nearest_ends = apart.min() if len(apart) else 0
        step = choose_rounding_step([Fraction(int(nearest_ends), MICRO**2)])
        straight = _measure_straight(self.squares, self.roots, step)
        given = self._read_lengths()
        has_length = np.array([length is not None for length in self.lanes.lengths], bool)
        check_work(READING)
        is_short = has_length & _is_short(given, self.squares, self.roots)
        has_length &= ~self._find_no_lengths(is_short)
        at_one_place = is_kept & (self.squares == 0)
        phrase = Fact("lane without length")
        self._note_mended(at_one_place, phrase)
        is_short &= is_kept & has_length & ~at_one_place
        phrase = Fact("lane too short")
        self._note_mended(is_short, phrase)
        lengths = np.where(has_length, np.maximum(given, straight), straight)
        return np.where(at_one_place, np.maximum(lengths, SHORTEST), lengths)

    def _read_lengths(self) -> Integers:
        """Return the lengths that are given [billionths of a metre], rounded up; else 0."""
        # By identity: fractions are slow to hash, and lanes often share theirs.
        length_of = {id(length): length for length in limit_loop(self.lanes.lengths, READING)}
        whole = {
            key: 0 if length is None else ceil(length * BILLION)
            for key, length in limit_loop(length_of.items(), READING)
        }
        return _convert_to_integers([whole[id(length)] for length in self.lanes.lengths])

    def _find_no_lengths(self, is_short: Bools) -> Bools:
        """Return lanes with an attribute that contradicts the positions of one lane.

        The attribute means something else.
        """
        wrong = Counter(
            name for name in (self.lanes.attributes[k] for k in np.flatnonzero(is_short)) if name
        )
        for name, count in wrong.items():
            self.draft.repair(Fact("attribute no length", attribute=quote(name), lanes=count))
        if not wrong:
            return np.zeros(len(is_short), bool)
        return np.array([name in wrong for name in self.lanes.attributes], bool)

    def _draw_curves(
        self, is_kept: Bools, lengths: Integers
    ) -> tuple[dict[int, LaneShape], Integers]:
        """Return how lanes are drawn, and lengths that are not below those of their curves."""
        shapes = {
            lane: LaneShape(points, None)
            for lane, points in self.lanes.shapes.items()
            if is_kept[lane]
        }
        lost, lengths = np.zeros(len(is_kept), bool), lengths.copy()
        for lane, curve in self.lanes.curves.items():
            if is_kept[lane]:
                points = self._connect_curve(lane, curve)
                if points is None:
                    lost[lane] = True
                    continue
                shapes[lane] = LaneShape(tuple(points[1:-1]), curve.chord_error)
                squares = [measure_squared_distance(*pair) for pair in pairwise(points)]
                step = choose_rounding_step(squares)
                along = sum(measure_straight_length(square, step) for square in squares)
                lengths[lane] = max(lengths[lane], int(along * BILLION))
        phrase = Fact("trajectory of other ends")
        self._note_mended(lost, phrase)
        return shapes, lengths

    def _connect_curve(self, lane: int, curve: Curve) -> list[Point] | None:
        """Return the points along a curve, if that leads from the tail of a lane to its head."""
        vertices = self.level.vertices
        tail, head = vertices[self.lanes.tails[lane]].at, vertices[self.lanes.heads[lane]].at
        first, *inside, last = curve.points
        gaps = (measure_squared_distance(*gap) for gap in ((tail, first), (head, last)))
        if max(gaps) > NEAR**2:
            return None
        return [at for at, _ in groupby((tail, *inside, head))]


def _convert_to_integers(values: Sequence[int]) -> Integers:
    return np.array(values, np.int64)


def _find_roots(squares: Integers) -> Integers:
    """Return the square roots of whole numbers, rounded down; exact."""
    if squares.dtype == object:
        return np.array([isqrt(square) for square in squares.tolist()], object)
    roots: Integers = np.sqrt(squares).astype(np.int64)
    roots -= roots**2 > squares  # what rounding has added
    roots += (roots + 1) ** 2 <= squares
    return roots


def _measure_straight(squares: Integers, roots: Integers, step: Fraction) -> Integers:
    """Return straight lengths [billionths of a metre], as `measure_straight_length` does.

    Squares are in square micrometres, their roots in micrometres.
    """
    micro = int(step * MICRO)
    steps = -(-squares // micro**2)
    whole = _find_roots(steps)
    whole += whole**2 < steps
    lengths = np.where(roots**2 == squares, roots, whole * micro) * (BILLION // MICRO)
    return lengths.astype(np.int64)


def _is_short(lengths: Integers, squares: Integers, roots: Integers) -> Bools:
    """Return which lengths are below the straight ones by more than rounding makes of them."""
    longer, unit = lengths + SHORTEST, BILLION // MICRO
    is_short = longer < unit * roots
    unsure = np.flatnonzero(~is_short & (longer < unit * (roots + 1)))  # roots are rounded down
    is_short[unsure] = [
        int(longer[lane]) ** 2 < int(squares[lane]) * unit**2 for lane in unsure.tolist()
    ]
    return (is_short | (lengths < 0)).astype(bool)
