"""The graph that robots drive on; a grid is a roadmap of unit edges."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, shown
from rightofway.model.clustering import Obstacle
from rightofway.model.drawing import Drawing
from rightofway.model.geometry import Frame, Point
from rightofway.model.units import VertexId
from rightofway.model.values import Number, coerced, length, names, number, optional
from rightofway.model.zones import NamedZone, Zone, zones_of

if TYPE_CHECKING:
    from collections.abc import Mapping

T = TypeVar("T")

FREE = frozenset(".GS")
"""Grid characters that a robot may stand on; every other one is blocked."""

EAST_SOUTH_WEST_NORTH = ((0, 1), (1, 0), (0, -1), (-1, 0))
"""Steps in (row, column), in the order that decides between equally short paths."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Grid:
    """Where the vertices of a roadmap lie on a grid of cells.

    Attributes
    ----------
    rows, columns
        Size of the grid [cells].
    cell_size
        Side of a cell [length unit].
    cells
        Row-major number of each vertex's cell, increasing; int32, shape (V,).
    vertex_at
        The vertex of each cell, -1 where it is blocked; int32, shape (rows * columns,).
    """

    rows: int
    columns: int
    cell_size: Fraction
    cells: NDArray[np.int32]
    vertex_at: NDArray[np.int32]

    def lines(self) -> tuple[str, ...]:
        """Return the grid as text, ``.`` for free and ``@`` for blocked."""
        text = np.where(self.vertex_at >= 0, ".", "@").reshape(self.rows, self.columns)
        return tuple("".join(row) for row in text)

    def cell(self, vertex: int) -> tuple[int, int]:
        """Return the (row, column) of a vertex."""
        row, column = divmod(int(self.cells[vertex]), self.columns)
        return row, column


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Roadmap:
    """A directed graph with edge lengths, in compressed sparse rows.

    Attributes
    ----------
    indptr, heads
        The edges that leave vertex ``v`` are ``indptr[v]`` to ``indptr[v + 1]`` (exclusive) and
        lead to ``heads`` of those; int32, shapes (V + 1,) and (E,).
    length_class
        Index into `lengths` of each edge; int32, shape (E,).
    lengths
        The distinct edge lengths [length unit].
    positions
        Where to draw each vertex, x to the right and y down [length unit]; float64, shape (V, 2).
    labels
        Names of the vertices, or None on a grid, where they are ``N<row-major number>``.
    grid
        The grid this roadmap was cut from, if any.
    frame
        Where the plane of the positions lies in the site's frame.
    speed_limits
        Speed limit of each length class [length unit per time unit], None for none; empty where no
        edge has one. Classes of one length may differ in it.
    barred
        Types of robots that may not drive along an edge of each length class; empty where there is
        no such type. Classes of one length may differ in it.
    surcharges
        What makes an edge of each length class less liked, not slower [time unit]; empty where
        nothing does. Classes of one length may differ in it.
    barred_vertices
        Vertices with the types of robots that may not be there; every edge into such a vertex is
        barred for these types.
    zones
        Vertices and edges that hold one robot at a time.
    obstacles
        What blocked cells of a grid are, in the site's frame before its yaw. Only for people: no
        plan depends on it, and roadmaps that differ in it alone are equal.
    drawing
        Stations, parking places, the picture below: only for people, too.
    sides
        Side of the square cell round each vertex [length unit], None where vertices have none and
        on a grid; float64, shape (V,).
    """

    indptr: NDArray[np.int32]
    heads: NDArray[np.int32]
    length_class: NDArray[np.int32]
    lengths: tuple[Fraction, ...]
    positions: NDArray[np.float64]
    labels: tuple[str, ...] | None = None
    grid: Grid | None = None
    frame: Frame = field(default_factory=Frame)
    speed_limits: tuple[Fraction | None, ...] = ()
    barred: tuple[frozenset[str], ...] = ()
    surcharges: tuple[Fraction, ...] = ()
    barred_vertices: Mapping[VertexId, frozenset[str]] = field(default_factory=dict)
    zones: tuple[Zone, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    drawing: Drawing = field(default_factory=Drawing)
    sides: NDArray[np.float64] | None = None
    _ids: Mapping[str, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for array in (self.indptr, self.heads, self.length_class, self.positions):
            array.flags.writeable = False
        ids = {name: vertex for vertex, name in enumerate(self.labels or ())}
        object.__setattr__(self, "_ids", ids)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Roadmap):
            return NotImplemented
        return (
            self.lengths == other.lengths
            and self.speed_limits == other.speed_limits
            and self.barred == other.barred
            and self.surcharges == other.surcharges
            and self.barred_vertices == other.barred_vertices
            and self.zones == other.zones
            and self.labels == other.labels
            and self.frame == other.frame
            and _same_grid(self.grid, other.grid)
            and np.array_equal(self.indptr, other.indptr)
            and np.array_equal(self.heads, other.heads)
            and np.array_equal(self.length_class, other.length_class)
            and np.array_equal(self.positions, other.positions)
            and _same_sides(self.sides, other.sides)
        )

    def __hash__(self) -> int:
        return hash((self.n_vertices, self.n_edges, self.lengths))

    def __repr__(self) -> str:
        grid = self.grid
        cut = f", grid of {grid.columns} x {grid.rows} cells" if grid else ""
        return f"Roadmap({self.n_vertices} vertices, {self.n_edges} edges{cut})"

    def durations(self, speed: Fraction) -> list[Fraction]:
        """Return how long a robot of a speed drives along an edge of each class [time unit]."""
        if not self.speed_limits:
            return [length / speed for length in self.lengths]
        return [
            length / (speed if limit is None else min(speed, limit))
            for length, limit in zip(self.lengths, self.speed_limits, strict=True)
        ]

    def is_barred(self, length_class: int, robot_type: str | None) -> bool:
        """Return whether edges of a length class are barred for robots of a type."""
        return bool(self.barred) and robot_type in self.barred[length_class]

    @property
    def types(self) -> frozenset[str]:
        """Types of robots that an edge or a vertex is barred for."""
        return frozenset().union(*self.barred, *self.barred_vertices.values())

    @property
    def n_vertices(self) -> int:
        """Number of vertices."""
        return len(self.indptr) - 1

    @property
    def n_edges(self) -> int:
        """Number of directed edges."""
        return len(self.heads)

    def name(self, vertex: int) -> str:
        """Return the name of a vertex: its label, or ``N<row-major number>`` on a grid."""
        if self.labels is not None:
            return self.labels[vertex]
        return f"N{int(self.grid.cells[vertex]) if self.grid else vertex}"

    def vertex(self, name: str) -> VertexId:
        """Return the vertex of that name.

        Raises
        ------
        KeyError
            If no free vertex has that name.
        """
        if self.labels is not None:
            return VertexId(self._ids[name])
        number = name[1:]
        if not (name.startswith("N") and number.isascii() and number.isdecimal()):
            raise KeyError(name)
        vertex = int(number)
        if self.grid is not None:
            cells = self.grid.vertex_at
            vertex = int(cells[vertex]) if vertex < len(cells) else -1
        if not 0 <= vertex < self.n_vertices:
            raise KeyError(name)
        return VertexId(vertex)

    def point(self, vertex: int) -> Point:
        """Return where a vertex lies in the site's frame; on a grid, the centre of its cell."""
        if self.grid is not None:
            row, column = self.grid.cell(vertex)
            size = self.grid.cell_size
            return self.frame.to_site((column * size, row * size))
        x, y = self.positions[vertex].tolist()
        return self.frame.to_site((Fraction(repr(x)), Fraction(repr(y))))

    def without(self, closed: Collection[int], edges: Collection[tuple[int, int]] = ()) -> Roadmap:
        """Return the same vertices without some edges, and without those at closed vertices."""
        tails = np.repeat(np.arange(self.n_vertices), np.diff(self.indptr))
        shut = np.fromiter(closed, np.int64, len(closed))
        is_open = ~(np.isin(tails, shut) | np.isin(self.heads, shut))
        is_open[[index for ends in edges if (index := self.edge(*ends)) is not None]] = False
        degree = np.bincount(tails[is_open], minlength=self.n_vertices)
        kept = set(zip(tails[is_open].tolist(), self.heads[is_open].tolist(), strict=True))
        zones = (
            replace(zone, edges=tuple(ends for ends in zone.edges if ends in kept))
            for zone in self.zones
        )
        return replace(
            self,
            indptr=np.concatenate(([0], np.cumsum(degree))).astype(np.int32),
            heads=self.heads[is_open],
            length_class=self.length_class[is_open],
            zones=tuple(zones),
        )

    def edge(self, tail: int, head: int) -> int | None:
        """Return the index of the edge from ``tail`` to ``head``, or None without one."""
        for index in range(int(self.indptr[tail]), int(self.indptr[tail + 1])):
            if self.heads[index] == head:
                return index
        return None

    def edges(self, tails: NDArray[np.int32], heads: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return the indices of the edges from ``tails`` to ``heads``, -1 without one; int32."""
        found = np.full(len(tails), -1, np.int32)
        first, last = self.indptr[tails], self.indptr[tails + 1]
        for offset in range(int((last - first).max(initial=0))):
            edge = np.minimum(first + offset, len(self.heads) - 1)
            fits = (first + offset < last) & (self.heads[edge] == heads) & (found < 0)
            found[fits] = edge[fits]
        return found


def _same_sides(one: NDArray[np.float64] | None, other: NDArray[np.float64] | None) -> bool:
    if one is None or other is None:
        return one is other
    return np.array_equal(one, other)


def _same_grid(one: Grid | None, other: Grid | None) -> bool:
    if one is None or other is None:
        return one is other
    return (one.rows, one.columns, one.cell_size) == (
        other.rows,
        other.columns,
        other.cell_size,
    ) and np.array_equal(one.cells, other.cells)


def roadmap_of_grid(
    lines: Sequence[str],
    *,
    cell_size: Number = 1,
    y_up: bool = False,
    origin: Point | None = None,
    yaw: Fraction = Fraction(0),
) -> Roadmap:
    """Make the roadmap of a grid: a vertex for each free cell, edges to the four next to it.

    Parameters
    ----------
    lines
        The rows, all of one length. ``.``, ``G`` and ``S`` are free, everything else is blocked.
    cell_size
        Side of a cell, and so the length of every edge [length unit].
    y_up
        Whether y grows upwards in the site's frame; the first row is the upper one all the same.
    origin
        The lower left corner of the grid in the site's frame [length unit]. By default (0, 0) is
        the corner of the grid that has the least x and y.
    yaw
        Angle by which the grid is turned about the origin, from the site's x to its y [rad].

    Raises
    ------
    InputError
        For an empty or ragged grid, one without a free cell, or a cell size that is not positive.
    """
    _check_lines(lines)
    size = length(cell_size, "cell_size")
    free = np.array([[character in FREE for character in line] for line in lines])
    if not free.any():
        raise InputError.at("", f"no free cell in {free.size} ({_meant_by(lines)})")
    rows, columns = free.shape
    cells = np.flatnonzero(free).astype(np.int32)
    vertex_at = np.full(rows * columns, -1, np.int32)
    vertex_at[cells] = np.arange(len(cells), dtype=np.int32)
    neighbours = _neighbours(vertex_at.reshape(rows, columns), free)
    present = neighbours >= 0
    cells.flags.writeable = vertex_at.flags.writeable = False
    y, x = np.divmod(cells, columns)
    return Roadmap(
        indptr=np.concatenate(([0], np.cumsum(present.sum(axis=1)))).astype(np.int32),
        heads=neighbours[present],
        length_class=np.zeros(int(present.sum()), np.int32),
        lengths=(size,),
        positions=np.column_stack((x, y)).astype(np.float64) * float(size),
        grid=Grid(rows=rows, columns=columns, cell_size=size, cells=cells, vertex_at=vertex_at),
        frame=_frame_of_grid(rows * size, size, y_up=y_up, origin=origin, yaw=yaw),
    )


def _frame_of_grid(
    height: Fraction, size: Fraction, *, y_up: bool, origin: Point | None, yaw: Fraction
) -> Frame:
    """Return the frame of a grid: the point (0, 0) of its plane is the centre of its first cell."""
    left, bottom = origin or (Fraction(0), Fraction(0) if y_up else height)
    corner = Frame(x=left, y=bottom, y_up=y_up, yaw=yaw)
    x, y = corner.to_site((size / 2, size / 2 - height))
    return Frame(x=x, y=y, y_up=y_up, yaw=yaw)


def _check_lines(lines: Sequence[str]) -> None:
    if isinstance(lines, str) or not all(isinstance(line, str) for line in lines):
        raise InputError.at("", f"{shown(lines)} is no list of rows (give a list of text)")
    if not lines or not lines[0]:
        raise InputError.at("", "the grid is empty (give at least one row of one cell)")
    spaced = [line.rstrip() for line in lines]
    if all(set(line[1::2]) <= {" "} and " " not in line[::2] for line in spaced) and any(
        " " in line for line in spaced
    ):
        message = f"{shown(lines[0])} has spaces between cells (write {shown(spaced[0][::2])})"
        raise InputError.at("", message)
    width = len(lines[0])
    for row, line in enumerate(lines):
        if len(line) != width:
            message = f"{len(line)} cells, but row 0 has {width} (make all rows equally long)"
            raise InputError.at(f"[{row}]", message)


def _meant_by(lines: Sequence[str]) -> str:
    """Return how to write a grid that has no free cell."""
    found = sorted(set("".join(lines)))
    if set(found) <= set("01"):
        return "write . for free and @ for blocked, not 0 and 1"
    others = [character for character in found if character not in "@#TOWX"]
    if len(others) == 1 and len(found) > 1:
        return f"free cells are . G S; {shown(others[0])} is blocked here: write . for it"
    return "free cells are . G S, all other characters are blocked"


def _neighbours(vertex_at: NDArray[np.int32], free: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Return the vertex east, south, west and north of each vertex, -1 for none; shape (V, 4)."""
    framed = np.pad(vertex_at, 1, constant_values=-1)
    rows, columns = vertex_at.shape
    return np.column_stack(
        [
            framed[1 + down : 1 + down + rows, 1 + right : 1 + right + columns][free]
            for down, right in EAST_SOUTH_WEST_NORTH
        ]
    )


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
        coerced(
            self, source, length=number, max_speed=optional(number), barred=names, surcharge=number
        )


def roadmap_of_edges(
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
    # Floats first: fractions are slow to compare, and only equal floats need it.
    classes = sorted(
        {_edge_class(edge) for edge in edges},
        key=lambda one: (
            float(one.length),
            one.length,
            one.max_speed or 0,
            sorted(one.barred),
            one.surcharge,
        ),
    )
    class_of = {each: index for index, each in enumerate(classes)}
    ordered = sorted(edges, key=lambda edge: ids[edge.tail])  # stable: keeps the given order
    degrees = np.bincount([ids[edge.tail] for edge in ordered], minlength=len(ids))
    down = (1.0, -1.0 if y_up else 1.0)
    both_ends = {(edge.tail, edge.head) for edge in edges}
    return Roadmap(
        indptr=np.concatenate(([0], np.cumsum(degrees))).astype(np.int32),
        heads=np.array([ids[edge.head] for edge in ordered], np.int32),
        length_class=np.array([class_of[_edge_class(edge)] for edge in ordered], np.int32),
        lengths=tuple(one.length for one in classes),
        speed_limits=_unless_all(None, [one.max_speed for one in classes]),
        barred=_unless_all(frozenset(), [one.barred for one in classes]),
        surcharges=_unless_all(Fraction(0), [one.surcharge for one in classes]),
        barred_vertices={VertexId(ids[name]): frozenset(kinds) for name, kinds in barred.items()},
        positions=np.array(list(positions.values()), np.float64).reshape(len(ids), 2) * down,
        labels=tuple(positions),
        frame=frame or Frame(y_up=y_up),
        sides=None if sides is None else np.array(sides, np.float64),
        zones=zones_of(zones, ids, both_ends, pieces or {}) if zones else (),
    )


class _EdgeClass(NamedTuple):
    """What edges of one length class have in common."""

    length: Fraction
    max_speed: Fraction | None
    barred: frozenset[str]
    surcharge: Fraction


def _edge_class(edge: Edge) -> _EdgeClass:
    return _EdgeClass(edge.length, edge.max_speed, edge.barred, edge.surcharge)


def _unless_all(usual: T, values: Sequence[T]) -> tuple[T, ...]:
    """Return the values, or nothing where all are as usual."""
    return () if all(value == usual for value in values) else tuple(values)


def _check_edges(ids: Mapping[str, int], edges: Sequence[Edge]) -> None:
    if not ids:
        raise InputError.at("", "the roadmap has no vertex (give at least one)")
    seen: set[tuple[str, str]] = set()
    for index, edge in enumerate(edges):
        fault = _edge_fault(edge, ids, seen)
        if not fault and edge.surcharge < 0:
            fault = f"surcharge {edge.surcharge} is negative (give 0 or more)"
        if fault:
            raise InputError.at(f"edges[{index}]", fault)
        seen.add((edge.tail, edge.head))


def _edge_fault(edge: Edge, ids: Mapping[str, int], seen: set[tuple[str, str]]) -> str | None:
    for end in (edge.tail, edge.head):
        if end not in ids:
            return f"no vertex is named {end!r} (name one of the {len(ids)} vertices)"
    if edge.tail == edge.head:
        return f"leads from {edge.tail!r} to itself (take it out)"
    if edge.length <= 0:
        return f"length {edge.length} is not positive (give a length above 0)"
    if edge.max_speed is not None and edge.max_speed <= 0:
        return f"max_speed {edge.max_speed} is not positive (give a speed above 0)"
    if (edge.tail, edge.head) in seen:
        return f"{edge.tail!r} to {edge.head!r} is given twice (take one out)"
    return None
