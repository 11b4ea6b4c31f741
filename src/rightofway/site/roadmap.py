"""The graph that robots drive on; a grid is a roadmap of unit edges."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import chain, pairwise, product
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, InputFault, find_nearest, quote
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import TypeSpeeds
from rightofway.site.clustering import Obstacle
from rightofway.site.drawing import Drawing
from rightofway.site.geometry import Frame, Point, VertexId, read_shortest
from rightofway.site.passing import Passing
from rightofway.site.zones import Zone

T = TypeVar("T")

WHOLE = (int, np.int32, np.int64)
"""Types of numbers of vertices and edges."""


class UnknownVertex(InputError, KeyError):
    """No vertex has this name, or this number."""

    @classmethod
    def named(cls, name: object, known: Collection[str]) -> UnknownVertex:
        """Return the error for a name, with the nearest known one."""
        near = find_nearest(name, known) if isinstance(name, str) else None
        remedy = f"did you mean {near!r}?" if near else "give one of the map's vertices"
        return cls([InputFault("name", f"no vertex is named {quote(name)} ({remedy})")])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Grid:
    """The positions of the vertices of a roadmap on a grid of cells.

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

    def as_lines(self) -> tuple[str, ...]:
        """Return the grid as text, ``.`` for free and ``@`` for blocked."""
        text = np.where(self.vertex_at >= 0, ".", "@").reshape(self.rows, self.columns)
        return tuple("".join(row) for row in text)

    def get_cell(self, vertex: int) -> tuple[int, int]:
        """Return the (row, column) of a vertex."""
        row, column = divmod(int(self.cells[vertex]), self.columns)
        return row, column


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeClass:
    """Common properties of edges: length, speed limits, and barred types of robots.

    Attributes
    ----------
    length
        The length [length unit].
    max_speed
        The speed limit [length unit per time unit]; None for none.
    max_speed_by_type
        Types of robots that have another speed limit, with this limit.
    barred
        Types of robots that may not drive along the edges.
    surcharge
        A cost that makes the edges less liked, not slower [time unit].
    max_radius
        The largest radius of robots that may drive along the edges [length unit]; None for any.
    """

    length: Fraction
    max_speed: Fraction | None = None
    max_speed_by_type: TypeSpeeds = ()
    barred: frozenset[str] = frozenset()
    surcharge: Fraction = Fraction(0)
    max_radius: Fraction | None = None

    def get_speed_limit(self, robot_type: str | None) -> Fraction | None:
        """Return the speed limit of robots of a type [length unit per time unit]."""
        if not self.max_speed_by_type or robot_type is None:
            return self.max_speed
        return dict(self.max_speed_by_type).get(robot_type, self.max_speed)

    def limit_speed(self, speed: Fraction, robot_type: str | None) -> Fraction:
        """Return the speed of a robot of a speed and a type along an edge."""
        limit = self.get_speed_limit(robot_type)
        return speed if limit is None else min(speed, limit)

    def compute_duration(self, speed: Fraction, robot_type: str | None = None) -> Fraction:
        """Return the time of a robot of a speed and a type along an edge [time unit]."""
        speed = self.limit_speed(speed, robot_type)
        return self.length if speed == 1 else self.length / speed

    def is_barred(self, robot_type: str | None, radius: Fraction) -> bool:
        """Return whether the edges are barred for robots of a type and radius."""
        return robot_type in self.barred or (
            self.max_radius is not None and radius > self.max_radius
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """A lane that was split into pieces, in one direction; each piece is an edge.

    Attributes
    ----------
    vertices
        The vertices along the lane in the order of driving, its ends included: at least 3.
    """

    vertices: tuple[VertexId, ...]

    @property
    def ends(self) -> tuple[VertexId, VertexId]:
        """The vertices that the lane leaves and enters."""
        return self.vertices[0], self.vertices[-1]

    @property
    def joints(self) -> tuple[VertexId, ...]:
        """The vertices between two pieces."""
        return self.vertices[1:-1]

    @property
    def pieces(self) -> tuple[tuple[VertexId, VertexId], ...]:
        """Tail and head of each piece."""
        return tuple(pairwise(self.vertices))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Roadmap:
    """A directed graph with edge lengths, in compressed sparse rows.

    Attributes
    ----------
    indptr, heads
        The edges that leave vertex ``v`` are ``indptr[v]`` to ``indptr[v + 1]`` (exclusive) and
        lead to ``heads`` of those; int32, shapes (V + 1,) and (E,).
    class_of_edge
        Index into `edge_classes` of each edge; int32, shape (E,).
    edge_classes
        Common properties of edges; all differ.
    positions
        Where to draw each vertex, x to the right and y down [length unit]; float64, shape (V, 2).
        On a grid, the exact position is a multiple of the cell's side; on other roadmaps it is the
        shortest decimal, but for `fractions`.
    fractions
        Vertices of which some coordinate is no shortest decimal, such as 1/3, with their exact
        positions [length unit].
    labels
        Names of the vertices, or None on a grid, where they are ``N<row-major number>``.
    grid
        The grid this roadmap was cut from, if any.
    frame
        Where the plane of the positions lies in the site's frame.
    barred_vertices
        Vertices with the types of robots that may not be there; every edge into such a vertex is
        barred for these types.
    zones
        Vertices and edges that hold one robot at a time.
    lanes
        The lanes that were split into pieces, each direction by itself. On one curve, both
        directions share the vertices between pieces, or each has its own: see `opposite`.
    obstacles
        The obstacles on blocked cells of a grid, in the site's frame before its yaw. Only for
        people: no plan depends on it, and roadmaps that differ in it alone are equal.
    drawing
        Stations, parking places, the picture below: only for people, too.
    sides
        Side of the square cell round each vertex [length unit], None where vertices have none and
        on a grid.
    drawn_sides
        The same in floating point; float64, shape (V,), empty where vertices have none.
    opposite
        For each vertex between pieces of a lane the vertex of the other direction at the same
        point, where the directions have vertices of their own. No edge joins the two, so that no
        robot turns back there; they are one place, which holds one robot.
    passing
        The vertices that robots only drive through; None without such vertices. Several vertices
        then represent one passed vertex and have its name.
    originals
        The vertices for further directions of a vertex at which robots may not turn, with that
        vertex (`site.directions`). All are one place, which holds one robot.
    fixed
        The vertices at which robots may not turn.
    unmet
        Vertices where robots work in a heading in which no lane ends, and may not turn: which
        headings these are, for people. No robot works there.
    """

    indptr: NDArray[np.int32]
    heads: NDArray[np.int32]
    class_of_edge: NDArray[np.int32]
    edge_classes: tuple[EdgeClass, ...]
    positions: NDArray[np.float64]
    fractions: Mapping[int, Point] = field(default_factory=dict)
    labels: tuple[str, ...] | None = None
    grid: Grid | None = None
    frame: Frame = field(default_factory=Frame)
    barred_vertices: Mapping[VertexId, frozenset[str]] = field(default_factory=dict)
    zones: tuple[Zone, ...] = ()
    lanes: tuple[Lane, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    drawing: Drawing = field(default_factory=Drawing)
    sides: tuple[Fraction, ...] | None = None
    passing: Passing | None = None
    originals: Mapping[VertexId, VertexId] = field(default_factory=dict)
    fixed: frozenset[VertexId] = frozenset()
    unmet: Mapping[VertexId, str] = field(default_factory=dict)
    drawn_sides: NDArray[np.float64] = field(init=False, repr=False)
    opposite: Mapping[VertexId, VertexId] = field(init=False, repr=False)
    _ids: Mapping[str, int] = field(init=False, repr=False)
    _stations: Mapping[str, VertexId] = field(init=False, repr=False)
    _lane_at: Mapping[int, Lane] = field(init=False, repr=False)
    _places: Mapping[VertexId, tuple[VertexId, ...]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for array in (self.indptr, self.heads, self.class_of_edge, self.positions):
            array.flags.writeable = False
        object.__setattr__(self, "drawn_sides", np.array(self.sides or (), np.float64))
        drawn = (self.labels or ())[: self.n_drawn]
        ids = {name: vertex for vertex, name in enumerate(drawn)}
        object.__setattr__(self, "_ids", ids)
        object.__setattr__(self, "_stations", dict(self.drawing.stations))
        object.__setattr__(self, "opposite", self._find_opposite())
        at = {joint: lane for lane in reversed(self.lanes) for joint in lane.joints}
        at |= {joint: at[min(joint, other)] for joint, other in self.opposite.items()}
        object.__setattr__(self, "_lane_at", at)
        object.__setattr__(self, "_places", self._find_places())

    def _find_places(self) -> dict[VertexId, tuple[VertexId, ...]]:
        """Return for each vertex that is not alone at its place the vertices of the place."""
        places: dict[VertexId, tuple[VertexId, ...]] = {}
        places |= {vertex: (vertex, other) for vertex, other in self.opposite.items()}
        copies: dict[VertexId, list[VertexId]] = {}
        for copy, vertex in self.originals.items():
            copies.setdefault(vertex, [vertex]).append(copy)
        for same in copies.values():
            places |= {at: (at, *(other for other in same if other != at)) for at in same}
        return places

    def _find_opposite(self) -> dict[VertexId, VertexId]:
        """Return for each vertex between pieces the one of the other direction at its point."""
        ways: dict[tuple[VertexId, VertexId], list[Lane]] = {}
        for lane in self.lanes:
            ways.setdefault(self._find_drawn_ends(lane), []).append(lane)
        opposite: dict[VertexId, VertexId] = {}
        for lane in self.lanes:
            for back in ways.get(self._find_drawn_ends(lane)[::-1], ()):
                along, across = list(lane.joints), list(back.joints[::-1])
                if set(along).isdisjoint(across) and np.array_equal(
                    self.positions[along], self.positions[across]
                ):
                    opposite |= dict(zip(along, across, strict=True))
        return opposite

    def _find_drawn_ends(self, lane: Lane) -> tuple[VertexId, VertexId]:
        tail, head = lane.ends
        return self.get_original(tail), self.get_original(head)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Roadmap):
            return NotImplemented
        return (
            self.edge_classes == other.edge_classes
            and self.barred_vertices == other.barred_vertices
            and self.zones == other.zones
            and self.lanes == other.lanes
            and self.originals == other.originals
            and self.fixed == other.fixed
            and self.labels == other.labels
            and self.frame == other.frame
            and _has_same_grid(self.grid, other.grid)
            and np.array_equal(self.indptr, other.indptr)
            and np.array_equal(self.heads, other.heads)
            and np.array_equal(self.class_of_edge, other.class_of_edge)
            and np.array_equal(self.positions, other.positions)
            and self.fractions == other.fractions
            and self.sides == other.sides
            and (
                other.passing is None if not self.passing else self.passing.is_equal(other.passing)
            )
        )

    def __hash__(self) -> int:
        some = self.edge_classes[:8]  # a map may have a million, which are slow to hash
        return hash((self.n_vertices, self.n_edges, some))

    def __repr__(self) -> str:
        grid = self.grid
        cut = f", grid of {grid.columns} x {grid.rows} cells" if grid else ""
        return f"Roadmap({self.n_vertices} vertices, {self.n_edges} edges{cut})"

    def get_edge_class(self, edge: int) -> EdgeClass:
        """Return the common properties of the edges of its class."""
        if type(edge) not in WHOLE or not 0 <= edge < self.n_edges:
            raise InputError.at("edge", f"{quote(edge)} is none of {self.n_edges} edges")
        return self.edge_classes[int(self.class_of_edge[edge])]

    @property
    def lengths(self) -> tuple[Fraction, ...]:
        """The length of each class of edges [length unit]."""
        return tuple(edge_class.length for edge_class in self.edge_classes)

    @property
    def has_surcharges(self) -> bool:
        """Whether an edge has a surcharge."""
        return any(edge_class.surcharge for edge_class in self.edge_classes)

    @property
    def types(self) -> frozenset[str]:
        """Types of robots that an edge or a vertex is barred for, or that edges have limits for."""
        barred = (edge_class.barred for edge_class in self.edge_classes)
        limited = (dict(edge_class.max_speed_by_type) for edge_class in self.edge_classes)
        return frozenset().union(*barred, *limited, *self.barred_vertices.values())

    @checks_arguments
    def find_ways_along(self, ends: tuple[VertexId, VertexId]) -> list[tuple[VertexId, ...]]:
        """Return the vertices along an edge or a split lane, both ends included, in any direction.

        One way for each drawing of the lane: its directions may be driven along different curves,
        or have vertices of their own. Empty if no edge or lane has these ends.
        """
        tails, heads = map(self.list_place, ends)
        ways = [
            pair
            for pair in product(tails, heads)
            if self._has_edge(*pair) or self._has_edge(*pair[::-1])
        ]
        pairs = {*product(tails, heads), *product(heads, tails)}
        drawn: dict[frozenset[VertexId], tuple[VertexId, ...]] = {}
        for lane in self.lanes:  # both directions of one curve are one way
            if lane.ends in pairs:
                drawn.setdefault(frozenset(lane.vertices), lane.vertices)
        return [*ways, *drawn.values()]

    @checks_arguments
    def list_pieces(self, ends: tuple[VertexId, VertexId]) -> tuple[tuple[VertexId, VertexId], ...]:
        """Return tail and head of an edge, or of the pieces of a split lane in one direction.

        Empty if no edge or lane has these ends.
        """
        pairs = list(product(self.list_copies(ends[0]), self.list_copies(ends[1])))
        lanes = (lane.pieces for lane in self.lanes if lane.ends in pairs)
        edges = tuple(pair for pair in pairs if self._has_edge(*pair))
        return edges or tuple(dict.fromkeys(chain.from_iterable(lanes)))

    def list_whole_edges(
        self, values: Mapping[tuple[str, str], T]
    ) -> tuple[tuple[VertexId, VertexId, T], ...]:
        """Return tail, head and value of edges; lanes that were split are left out.

        Parameters
        ----------
        values
            Values by the names of tails and heads.
        """
        value_of: dict[tuple[VertexId, VertexId], T] = {}
        for ends, value in values.items():
            tails, heads = (self.list_copies(self.get_vertex(end)) for end in ends)
            pairs = product(tails, heads)
            value_of |= {pair: value for pair in pairs if self._has_edge(*pair)}
        return tuple((tail, head, value) for (tail, head), value in value_of.items())

    @checks_arguments
    def is_along_one_lane(self, vertices: Collection[int]) -> bool:
        """Return whether vertices are joints, or joints and ends, of one lane that was split."""
        lane = next((self._lane_at[vertex] for vertex in vertices if vertex in self._lane_at), None)
        return lane is not None and all(
            self._lane_at.get(vertex) is lane
            or not {*lane.ends}.isdisjoint(self.list_copies(VertexId(vertex)))
            for vertex in vertices
        )

    @property
    def has_shared_places(self) -> bool:
        """Whether several vertices are one place, for robots of different directions."""
        return bool(self._places)

    def list_place(self, vertex: VertexId) -> tuple[VertexId, ...]:
        """Return the vertices at the place of a vertex, itself first."""
        return self._places.get(vertex, (vertex,))

    def get_original(self, vertex: VertexId) -> VertexId:
        """Return the vertex of which a vertex is a copy for a further direction, else itself."""
        return self.originals.get(vertex, vertex)

    def list_copies(self, vertex: VertexId) -> tuple[VertexId, ...]:
        """Return the vertices that are drawn as one with a vertex, itself first.

        Unlike those of `list_place`, lanes lead to them from the same vertices.
        """
        return (vertex,) if vertex in self.opposite else self.list_place(vertex)

    def list_shared_places(self) -> list[list[VertexId]]:
        """Return the places of several vertices, in increasing order."""
        return [sorted(same) for vertex, same in self._places.items() if vertex == min(same)]

    @property
    def n_vertices(self) -> int:
        """Number of vertices."""
        return len(self.indptr) - 1

    @property
    def n_edges(self) -> int:
        """Number of directed edges."""
        return len(self.heads)

    @property
    def n_drawn(self) -> int:
        """Number of vertices as they are drawn, without those of chains through passed vertices."""
        return self.n_vertices if self.passing is None else self.passing.n_drawn

    @checks_arguments
    def is_passed(self, vertex: int) -> bool:
        """Return whether robots only drive through a vertex."""
        return self.passing is not None and self.get_drawn(vertex) in self.passing.vertices

    def get_drawn(self, vertex: int) -> int:
        """Return the drawn vertex of a vertex; only vertices of chains have another one."""
        if self.passing is None:
            return vertex
        self._refuse_unknown("vertex", vertex)
        return int(self.passing.drawn[vertex])

    def fold(self) -> Roadmap:
        """Return a roadmap as it is drawn, with edges to passed vertices and without chains.

        No plan may be made on it: the result does not prevent stops at passed vertices.
        """
        passing = self.passing
        if passing is None or self.heads is passing.heads:
            return self
        n = passing.n_drawn
        return replace(
            self,
            indptr=passing.indptr,
            heads=passing.heads,
            class_of_edge=passing.class_of_edge,
            positions=self.positions[:n],
            labels=None if self.labels is None else self.labels[:n],
            fractions={at: point for at, point in self.fractions.items() if at < n},
            sides=None if self.sides is None else self.sides[:n],
            passing=replace(passing, chains=(), drawn=passing.drawn[:n]),
        )

    @checks_arguments
    def unfold_route(self, vertices: Sequence[int]) -> list[VertexId]:
        """Return a route with the vertices of chains in place of passed vertices."""
        if self.passing is None:
            return list(map(VertexId, vertices))
        return self.passing.unfold_route(vertices)

    @property
    def has_cells(self) -> bool:
        """Whether vertices are square cells, of a grid or of several sizes."""
        return self.grid is not None or self.sides is not None

    def name(self, vertex: int) -> str:
        """Return the name of a vertex: its label, or ``N<row-major number>`` on a grid."""
        self._refuse_unknown("vertex", vertex)
        if self.labels is not None:
            return self.labels[vertex]
        return f"N{int(self.grid.cells[vertex]) if self.grid else vertex}"

    def get_vertex(self, name: str) -> VertexId:
        """Return the vertex of that name.

        Raises
        ------
        UnknownVertex
            An `InputError`, and a `KeyError`, if no free vertex has that name.
        """
        if not isinstance(name, str):
            raise UnknownVertex.named(name, ())
        if self.labels is not None:
            if name not in self._ids:
                raise UnknownVertex.named(name, self._ids)
            return VertexId(self._ids[name])
        number = name[1:]
        if not (name.startswith("N") and number.isascii() and number.isdecimal()):
            raise UnknownVertex.named(name, ())
        vertex = int(number)
        if self.grid is not None:
            cells = self.grid.vertex_at
            vertex = int(cells[vertex]) if vertex < len(cells) else -1
        if not 0 <= vertex < self.n_vertices:
            raise UnknownVertex.named(name, ())
        return VertexId(vertex)

    def get_place(self, name: str) -> VertexId:
        """Return the vertex of that name, or that of the station with the name.

        The name of a vertex counts before that of a station.

        Raises
        ------
        UnknownVertex
            An `InputError`, and a `KeyError`, if neither has that name.
        """
        if self.labels is None or not isinstance(name, str) or name in self._ids:
            return self.get_vertex(name)
        if name not in self._stations:
            raise UnknownVertex.named(name, {**self._ids, **self._stations})
        return self._stations[name]

    def list_hidden_stations(self) -> list[tuple[str, str]]:
        """Return the stations with the name of another vertex, and the names of their own."""
        return [
            (name, self.name(vertex))
            for name, vertex in self.drawing.stations
            if self._ids.get(name, vertex) != vertex
        ]

    def _refuse_unknown(self, place: str, vertex: int) -> None:
        """Refuse a number without a vertex; called for each visit, so it has to be quick."""
        if type(vertex) not in WHOLE or not 0 <= vertex < self.n_vertices:
            last = self.n_vertices - 1
            message = f"{quote(vertex)} is no vertex (give a number from 0 to {last})"
            raise UnknownVertex([InputFault(place, message)])

    def get_point(self, vertex: int) -> Point:
        """Return where a vertex lies in the site's frame; on a grid, the centre of its cell."""
        return self.frame.to_site(self.get_position(vertex))

    def get_position(self, vertex: int) -> Point:
        """Return the exact position of a vertex in the plane."""
        self._refuse_unknown("vertex", vertex)
        if self.grid is not None:
            row, column = self.grid.get_cell(vertex)
            size = self.grid.cell_size
            return column * size, row * size
        known = self.fractions.get(vertex)
        return read_shortest(self.positions[vertex].tolist()) if known is None else known

    def list_positions(self) -> list[Point]:
        """Return the exact position of each vertex in the plane."""
        if self.grid is not None:
            steps = [k * self.grid.cell_size for k in range(max(self.grid.rows, self.grid.columns))]
            rows, columns = np.divmod(self.grid.cells, self.grid.columns)
            cells = zip(rows.tolist(), columns.tolist(), strict=True)
            return [(steps[column], steps[row]) for row, column in cells]
        points = list(map(read_shortest, self.positions.tolist()))
        for vertex, point in self.fractions.items():
            points[vertex] = point
        return points

    @checks_arguments
    def exclude(self, closed: Collection[int], edges: Collection[tuple[int, int]] = ()) -> Roadmap:
        """Return the same vertices without some edges, and without those at closed vertices."""
        tails = np.repeat(np.arange(self.n_vertices), np.diff(self.indptr))
        copies = {} if self.passing is None else self.passing.copies
        shut = [
            at
            for vertex in closed
            for own in self.list_place(VertexId(vertex))
            for at in (own, *copies.get(own, ()))
        ]
        is_open = ~(np.isin(tails, shut) | np.isin(self.heads, shut))
        is_open[[edge for ends in edges for edge in self.list_edges(*ends)]] = False
        degree = np.bincount(tails[is_open], minlength=self.n_vertices)
        open_pairs = set(zip(tails[is_open].tolist(), self.heads[is_open].tolist(), strict=True))
        zones = (
            replace(zone, edges=tuple(ends for ends in zone.edges if ends in open_pairs))
            for zone in self.zones
        )
        return replace(
            self,
            indptr=np.concatenate(([0], np.cumsum(degree))).astype(np.int32),
            heads=self.heads[is_open],
            class_of_edge=self.class_of_edge[is_open],
            zones=tuple(zones),
        )

    def find_edge(self, tail: int, head: int) -> int | None:
        """Return the index of the edge from ``tail`` to ``head``, or None without one."""
        self._refuse_unknown("tail", tail)
        self._refuse_unknown("head", head)
        for index in range(int(self.indptr[tail]), int(self.indptr[tail + 1])):
            if self.heads[index] == head:
                return index
        return None

    @checks_arguments
    def list_edges(self, tail: int, head: int) -> list[int]:
        """Return the edges that represent the edge drawn from ``tail`` to ``head``.

        It is that edge, if there is one; of an edge at a passed vertex, one for each chain on it;
        of an edge at a vertex where robots may not turn, one for each direction.
        """
        drawn = product(self.list_copies(VertexId(tail)), self.list_copies(VertexId(head)))
        pairs = (
            [pair] if self.passing is None else self.passing.list_pairs(*pair) for pair in drawn
        )
        edges = (self.find_edge(*pair) for pair in chain.from_iterable(pairs))
        return [edge for edge in edges if edge is not None]

    @checks_arguments
    def is_drawn(self, tail: int, head: int) -> bool:
        """Return whether an edge is drawn from one vertex to another."""
        drawn = product(self.list_copies(VertexId(tail)), self.list_copies(VertexId(head)))
        return any(self._has_edge(*pair) for pair in drawn)

    def _has_edge(self, tail: int, head: int) -> bool:
        if self.find_edge(tail, head) is not None:
            return True
        return self.passing is not None and self.passing.is_drawn(tail, head)

    @checks_arguments
    def find_edges(self, tails: NDArray[np.int32], heads: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return the indices of the edges from ``tails`` to ``heads``, -1 without one; int32."""
        for place, ends in (("tails", tails), ("heads", heads)):
            is_list = ends.ndim == 1 and ends.dtype.kind in "iu"
            if not is_list or len(ends) != len(tails):
                message = f"{quote(ends)} are no vertices (give as many tails as heads)"
                raise InputError.at(place, message)
            # Negative numbers wrap round to large ones. The least and the largest stand for all.
            if len(ends) and ends.astype(np.uint64).max() >= self.n_vertices:
                self._refuse_unknown(place, ends.min())
                self._refuse_unknown(place, ends.max())
        edge_of_pair = np.full(len(tails), -1, np.int32)
        first, last = self.indptr[tails], self.indptr[tails + 1]
        for offset in reversed(range(int((last - first).max(initial=0)))):  # the first edge counts
            edge = first + offset
            fits = (edge < last) & (self.heads.take(edge, mode="clip") == heads)
            np.copyto(edge_of_pair, edge, where=fits)
        return edge_of_pair


def _has_same_grid(first: Grid | None, other: Grid | None) -> bool:
    if first is None or other is None:
        return first is other
    return (first.rows, first.columns, first.cell_size) == (
        other.rows,
        other.columns,
        other.cell_size,
    ) and np.array_equal(first.cells, other.cells)
