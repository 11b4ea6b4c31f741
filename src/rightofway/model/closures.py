"""Closures: vertices and edges that nobody may book for a while.

A closure is a booking of nobody. It takes *rows*, as robots of each size class book them: see
`rightofway.model.resources`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import check_work
from rightofway.errors import InputFault
from rightofway.facts import Fact
from rightofway.kinds.table import NOT_NEGATIVE, NUMBER, VERTEX, allow_none, coerce_fields, tuple_of
from rightofway.model.units import NEVER, Clock, Tick
from rightofway.site import Point, Roadmap, VertexId, measure_squared_distance

Ends = tuple[VertexId, VertexId]
"""The two ends of an edge or a lane, whichever way it is driven."""

Segment = tuple[Point, Point]
"""Both ends of a straight line; of a point, the point twice."""

FINDING = Fact("finding closed places")

LEEWAY = 1e-9
"""Relative error allowed in floating-point distances before exact ones decide [roadmap sizes]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Closure:
    """A vertex, or an edge in both directions, that no robot may book for a time.

    Attributes
    ----------
    at
        The vertex; None for an edge.
    edge
        The vertices at both ends of the edge; None for a vertex. A lane that `spacing` has split is
        meant as a whole.
    from_
        When it begins [time unit].
    until
        When it ends [time unit]; None for never.
    radius
        Everything nearer to the vertex or edge than this, the radius of a robot and the clearance
        is closed for that robot, too [length unit]; None for the vertex or edge alone.

    Raises
    ------
    InputError
        With every value of another kind or out of range.
    """

    at: VertexId | None = None
    edge: Ends | None = None
    from_: Fraction = Fraction(0)
    until: Fraction | None = None
    radius: Fraction | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "closure",
            at=allow_none(VERTEX),
            edge=allow_none(tuple_of(VERTEX, "tail", "head")),
            from_=NOT_NEGATIVE,
            until=allow_none(NUMBER),
            radius=allow_none(NOT_NEGATIVE),
        )


def find_closure_faults(closure: Closure, roadmap: Roadmap) -> Iterator[InputFault]:
    """Yield the faults of a closure."""
    if (closure.at is None) == (closure.edge is None):
        yield InputFault("", "closes not exactly one of a vertex and an edge (give at, or edge)")
    if closure.until is not None and closure.until <= closure.from_:
        message = f"{closure.until} is not after from, {closure.from_}"
        yield InputFault("until", f"{message} (give a later time, or leave it out: permanently)")
    places = [("at", closure.at)] if closure.edge is None else [("edge", v) for v in closure.edge]
    unknown = [
        (key, place)
        for key, place in places
        if place is not None and not 0 <= place < roadmap.n_drawn
    ]
    for key, place in unknown:
        last = roadmap.n_drawn - 1
        yield InputFault(key, f"vertex {place} is not on the roadmap (give 0 to {last})")
    if closure.edge is not None and not unknown and not roadmap.find_ways_along(closure.edge):
        tail, head = map(roadmap.name, closure.edge)
        yield InputFault("edge", f"no edge joins {tail} and {head} (name the ends of an edge)")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Closures:
    """The closed intervals of each row, by row, then by time; gaps separate those of one row.

    Attributes
    ----------
    row
        A vertex, or ``n_vertices`` + an edge, as robots of a size class book it: ``size *
        (n_vertices + n_edges)`` more; int32, shape (n,).
    start, end
        The time [ticks]; `NEVER` without an end; int64, shape (n,).
    n_vertices, n_edges
        Vertices and edges of the roadmap.
    size_of
        Size class of each robot.
    """

    row: NDArray[np.int32]
    start: NDArray[np.int64]
    end: NDArray[np.int64]
    n_vertices: int
    n_edges: int
    size_of: tuple[int, ...]
    _of: dict[int, list[tuple[Tick, Tick]]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        of: dict[int, list[tuple[Tick, Tick]]] = {}
        for row, start, end in zip(
            self.row.tolist(), self.start.tolist(), self.end.tolist(), strict=True
        ):
            of.setdefault(row, []).append((Tick(start), Tick(end)))
        object.__setattr__(self, "_of", of)

    @property
    def close_edges(self) -> bool:
        """Whether an edge is closed for some robot."""
        resource = self.row % (self.n_vertices + self.n_edges)
        return bool((resource >= self.n_vertices).any())

    def list_at_vertex(self, robot: int, vertex: int) -> list[tuple[Tick, Tick]]:
        """Return when a vertex is closed for a robot [ticks]."""
        size = self.size_of[robot]
        return self._of.get(size * (self.n_vertices + self.n_edges) + vertex, [])

    def list_along_edge(self, robot: int, edge: int) -> list[tuple[Tick, Tick]]:
        """Return when an edge is closed for a robot [ticks]."""
        return self.list_at_vertex(robot, self.n_vertices + edge)


class _Closed(NamedTuple):
    row: int
    start: Tick
    end: Tick


def book_closures(
    closures: Sequence[Closure],
    roadmap: Roadmap,
    radii: Sequence[Fraction],
    clearance: Fraction,
    clock: Clock,
) -> Closures | None:
    """Return the bookings of nobody, or None without a closure."""
    if not closures:
        return None
    sizes, n_rows = sorted(set(radii)), roadmap.n_vertices + roadmap.n_edges
    bookings, plane = list[_Closed](), _Plane(roadmap)
    for closure in closures:
        start = Tick(closure.from_ // clock.tick)
        end = NEVER if closure.until is None else clock.count_ticks(closure.until)
        for size, radius in enumerate(sizes):
            check_work(FINDING)
            reach = None if closure.radius is None else radius + closure.radius + clearance
            bookings += [
                _Closed(size * n_rows + resource, start, end)
                for resource in _list_closed_resources(plane, closure, reach)
            ]
    merged = list[_Closed]()
    for booking in sorted(bookings):
        if merged and merged[-1].row == booking.row and booking.start <= merged[-1].end:
            merged[-1] = merged[-1]._replace(end=max(merged[-1].end, booking.end))
        else:
            merged.append(booking)
    return Closures(
        row=np.array([booking.row for booking in merged], np.int32),
        start=np.array([booking.start for booking in merged], np.int64),
        end=np.array([booking.end for booking in merged], np.int64),
        n_vertices=roadmap.n_vertices,
        n_edges=roadmap.n_edges,
        size_of=tuple(sizes.index(radius) for radius in radii),
    )


class _Plane:
    """Positions of the vertices and edges of a roadmap, computed when a closure has a radius."""

    def __init__(self, roadmap: Roadmap) -> None:
        self.roadmap = roadmap

    @cached_property
    def exact(self) -> list[Point]:
        """The exact position of each vertex."""
        return self.roadmap.list_positions()

    @cached_property
    def drawn(self) -> NDArray[np.float64]:
        """The same in floating point; shape (V, 2)."""
        grid = self.roadmap.grid
        if grid is None:
            return self.roadmap.positions
        rows, columns = np.divmod(grid.cells, grid.columns)
        return np.column_stack((columns, rows)) * float(grid.cell_size)

    @cached_property
    def tails(self) -> NDArray[np.int64]:
        """The tail of each edge; shape (E,)."""
        return np.repeat(np.arange(self.roadmap.n_vertices), np.diff(self.roadmap.indptr))

    def find_near(
        self, segments: Sequence[Segment], reach: Fraction, ends: Collection[int]
    ) -> Iterator[int]:
        """Yield vertices and edges nearer than a distance to segments, but for some vertices.

        Edges are numbered after the vertices; those from and to the vertices kept are left out.
        """
        at, heads = self.exact, self.roadmap.heads
        for place in _find_boxed(self.drawn, self.drawn, segments, reach):
            if place not in ends and _is_nearer((at[place], at[place]), segments, reach):
                yield place
        for edge in _find_boxed(self.drawn[self.tails], self.drawn[heads], segments, reach):
            check_work(FINDING)
            tail, head = int(self.tails[edge]), int(heads[edge])
            if not {tail, head} & set(ends) and _is_nearer((at[tail], at[head]), segments, reach):
                yield self.roadmap.n_vertices + edge


def _list_closed_resources(plane: _Plane, closure: Closure, reach: Fraction | None) -> set[int]:
    """Return the vertices and edges that are closed for robots; edges are numbered after vertices.

    ``reach`` is the distance below which what is near is closed, too; None for nothing.
    """
    roadmap = plane.roadmap
    ways = [] if closure.edge is None else roadmap.find_ways_along(closure.edge)
    own = {ends for lane in ways for pair in pairwise(lane) for ends in (pair, pair[::-1])}
    edges = (edge for ends in own for edge in roadmap.list_edges(*ends))
    closed: set[int] = {roadmap.n_vertices + edge for edge in edges}
    closed.update(place for lane in ways for place in lane[1:-1])
    if closure.at is not None:
        closed.update(roadmap.list_place(closure.at))
    copies = {} if roadmap.passing is None else roadmap.passing.copies
    closed.update(at for place in [*closed] for at in copies.get(place, ()))
    if reach:
        at = plane.exact
        segments = [(at[tail], at[head]) for lane in ways for tail, head in pairwise(lane)]
        if closure.at is not None:
            segments.append((at[closure.at], at[closure.at]))
        ends = [
            at
            for end in closure.edge or ()
            for own in roadmap.list_place(end)
            for at in (own, *copies.get(own, ()))
        ]
        closed.update(plane.find_near(segments, reach, ends))
    return closed if roadmap.passing is None else closed | _list_along_chains(roadmap, closed)


def _list_along_chains(roadmap: Roadmap, closed: Collection[int]) -> set[int]:
    """Return the vertices of chains of which a part is closed: a chain is booked as a whole."""
    assert roadmap.passing is not None, "there are chains"
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    touched = set[int]()
    for place in closed:
        edge = place - roadmap.n_vertices
        # An edge of a chain has an end of its own on the chain.
        parts = [place] if edge < 0 else [tails[edge], int(roadmap.heads[edge])]
        inside = [part for part in parts if edge < 0 or part >= roadmap.n_drawn]
        touched.update(*(roadmap.passing.chains_at.get(part, ()) for part in inside))
    return {vertex for chain in touched for vertex in roadmap.passing.chains[chain][1:-1]}


def _find_boxed(
    first: NDArray[np.float64],
    other: NDArray[np.float64],
    segments: Sequence[Segment],
    reach: Fraction,
) -> list[int]:
    """Return which straight lines may come within reach of segments, by boxes around both."""
    points = np.array([[float(x) for x in point] for ends in segments for point in ends])
    slack = float(reach) + LEEWAY * (np.abs(first).max(initial=0) + float(reach))
    low, high = points.min(axis=0) - slack, points.max(axis=0) + slack
    meets = (np.maximum(first, other) >= low) & (np.minimum(first, other) <= high)
    return np.flatnonzero(meets.all(axis=1)).tolist()


def _is_nearer(segment: Segment, others: Sequence[Segment], reach: Fraction) -> bool:
    return any(_measure_squared_gap(segment, other) < reach**2 for other in others)


def _measure_squared_gap(first: Segment, other: Segment) -> Fraction:
    """Return the squared distance of two segments, exactly."""
    a, b = first
    c, d = other
    sides = (
        _compute_side(a, b, c) * _compute_side(a, b, d),
        _compute_side(c, d, a) * _compute_side(c, d, b),
    )
    if sides[0] < 0 and sides[1] < 0:
        return Fraction(0)
    return min(
        _measure_to_point(a, other),
        _measure_to_point(b, other),
        _measure_to_point(c, first),
        _measure_to_point(d, first),
    )


def _compute_side(a: Point, b: Point, c: Point) -> Fraction:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _measure_to_point(point: Point, segment: Segment) -> Fraction:
    """Return the squared distance of a point and a segment."""
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    if not square:
        return measure_squared_distance(point, segment[0])
    share = ((point[0] - ax) * dx + (point[1] - ay) * dy) / square
    share = min(max(share, Fraction(0)), Fraction(1))
    return measure_squared_distance(point, (ax + share * dx, ay + share * dy))
