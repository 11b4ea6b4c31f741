"""Bookings of robots, and which of them exclude each other.

A resource is a vertex or an edge. A point is a robot of size nothing: a vertex excludes itself, an
edge nothing. Robots of different sizes exclude different resources, so a
*row* is a resource as robots of one size class book it: row ``size * (V + E) + resource``, where
the vertices come first. A robot that books a row excludes robots of every size class from the rows
in its list. Safe planning then needs no geometry: a robot marks all rows in the lists of what it
books, and drives only where its own rows are not marked by other robots.

The list of an edge has only what the lists of its two ends lack, because both ends are booked for
as long as the edge is. So it is empty for nearly all edges: edges that pass a vertex nearer than
their ends do, and edges that cross.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from math import isqrt, lcm, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import check_work
from rightofway.errors import InputError, quote
from rightofway.facts import Fact
from rightofway.site import Roadmap, VertexId, measure_squared_distance
from rightofway.site.nearness import Lines, PointGrid
from rightofway.site.zone_guard import ZoneGuard
from rightofway.site.zones import Zone

RADIUS_STEP = Fraction(1, 10**6)
"""The radius of a robot that is given by length and width is rounded up to this [length unit]."""

SLACK = 1e-9
"""Candidates are this part of the roadmap's extent farther apart than resources that exclude each
other; exact arithmetic decides."""

ROUNDING = Fraction(1, 10**9)
"""An edge may be shorter than the straight line by this part."""

LANES_AT_ONCE = 256
"""Vertices or lanes whose neighbours are looked up at once; then the time limit is checked."""

MOST_PAIRS_IN_ZONES = 2_000_000
"""Pairs of vertices and lanes of one zone, at most, all zones together: a zone of 2 000, say."""

LARGEST_FAST = 2**30
"""Below this number, products of two differences of coordinates fit 64 bits."""

FINDING = Fact("finding incompatible bookings")

Ints = NDArray[np.int64]
Pairs = tuple[Ints, Ints]
Candidates = tuple[Pairs, Pairs, Pairs]
"""Pairs of vertices, vertices with lanes, pairs of lanes."""
Exact = NDArray[Any]
"""Integers of 64 bits where they fit, else Python integers of any size."""


def circumscribe(length: Fraction, width: Fraction) -> Fraction:
    """Return the radius of the circle around a rectangle, rounded up to `RADIUS_STEP`.

    Examples
    --------
    >>> circumscribe(Fraction(3), Fraction(4)), circumscribe(Fraction(1), Fraction(1))
    (Fraction(5, 2), Fraction(707107, 1000000))
    """
    square = (length**2 + width**2) / (2 * RADIUS_STEP) ** 2
    below = isqrt(square.numerator // square.denominator)
    return (below + (below**2 < square)) * RADIUS_STEP


def measure_distance(roadmap: Roadmap, first: int, other: int) -> float:
    """Return the distance of two vertices [length unit]."""
    return sqrt(measure_squared_distance(*map(roadmap.get_position, (first, other))))


def find_too_short_edges(roadmap: Roadmap) -> Iterator[tuple[int, int, Fraction, float]]:
    """Yield tail, head, length and straight distance of edges that are shorter than straight.

    A part in 10**9 is rounding, of positions or of the length.
    """
    if roadmap.grid is not None:
        return
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    lengths = np.array([float(length) for length in roadmap.lengths])[roadmap.class_of_edge]
    begin, end = roadmap.positions[tails], roadmap.positions[roadmap.heads]
    doubt = 1e-14 * np.abs(roadmap.positions).max()  # of coordinates and their differences
    straight = np.hypot(*(end - begin).T) + doubt
    for edge in np.flatnonzero(straight > lengths * (1 + float(ROUNDING) / 2)).tolist():
        length = roadmap.get_edge_class(edge).length
        ends = int(tails[edge]), int(roadmap.heads[edge])
        square = measure_squared_distance(*map(roadmap.get_position, ends))
        if square > (length * (1 + ROUNDING)) ** 2:
            yield *ends, length, sqrt(square)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosePairs:
    """Places that are close together on a drawing; a lane is its two ends, in either direction.

    Attributes
    ----------
    vertices
        Pairs of vertices that are nearer than a distance.
    beside
        Vertices that lie nearer than that beside a lane, whose ends are not as near.
    crossings
        Pairs of lanes that cross in a point that is an end of neither, but for those that a zone
        keeps robots apart on.
    """

    vertices: list[tuple[int, int]]
    beside: list[tuple[int, tuple[int, int]]]
    crossings: list[tuple[tuple[int, int], tuple[int, int]]]


def close_pairs(roadmap: Roadmap, distance: Fraction) -> ClosePairs:
    """Return the vertices and lanes nearer than a distance, and lanes that cross; exact.

    Vertices of one place are not near to each other.
    """
    pairs = _Drawing(roadmap, [distance]).close_pairs(distance)
    if roadmap.has_shared_places:
        pairs = _merge_copies(roadmap, pairs)
    if not pairs.crossings or not roadmap.zones:
        return pairs
    guard = ZoneGuard(roadmap)
    open_pairs = [lanes for lanes in pairs.crossings if not guard.are_apart(lanes[:1], lanes[1:])]
    return replace(pairs, crossings=open_pairs)


def _merge_copies(roadmap: Roadmap, pairs: ClosePairs) -> ClosePairs:
    """Return pairs without those of one place; copies of a vertex count as the vertex."""
    drawn = {at: roadmap.get_original(VertexId(at)) for at in range(roadmap.n_vertices)}

    def merge(lane: tuple[int, int]) -> tuple[int, int]:
        return drawn[lane[0]], drawn[lane[1]]

    vertices = [
        merge(pair)
        for pair in pairs.vertices
        if pair[1] not in roadmap.list_place(VertexId(pair[0]))
    ]
    return ClosePairs(
        vertices=list(dict.fromkeys(min(pair, pair[::-1]) for pair in vertices)),
        beside=list(dict.fromkeys((drawn[at], merge(lane)) for at, lane in pairs.beside)),
        crossings=list(dict.fromkeys((merge(a), merge(b)) for a, b in pairs.crossings)),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, weakref_slot=True)
class Resources:
    """Possible bookings of a fleet, in rows; `rightofway.native` finds those that exclude others.

    Attributes
    ----------
    roadmap
        The vertices, the edges and the zones.
    sizes
        The radius of each size class, the smallest first [length unit].
    clearance
        Least distance between two robots of which one has a size [length unit].
    size_of
        Size class of each robot; int32, shape (R,).
    n_vertices, n_edges
        Vertices and edges of the roadmap.
    are_points
        Whether no robot has a size, and there is neither a zone nor a passed vertex, nor a place
        of several vertices: a vertex excludes itself.
    """

    roadmap: Roadmap
    sizes: tuple[Fraction, ...]
    clearance: Fraction
    size_of: NDArray[np.int32]
    n_vertices: int = field(init=False)  # these are read for each booking
    n_edges: int = field(init=False)
    are_points: bool = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "n_vertices", self.roadmap.n_vertices)
        object.__setattr__(self, "n_edges", self.roadmap.n_edges)
        roadmap = self.roadmap
        is_plain = not (roadmap.zones or roadmap.passing or roadmap.has_shared_places)
        object.__setattr__(self, "are_points", not any(self.sizes) and is_plain)

    @property
    def n_rows(self) -> int:
        """Rows of all size classes."""
        return len(self.sizes) * (self.n_vertices + self.n_edges)

    def get_vertex_row(self, robot: int, vertex: int) -> int:
        """Return the row that a robot books at a vertex."""
        return int(self.size_of[robot]) * (self.n_vertices + self.n_edges) + vertex

    def get_edge_row(self, robot: int, edge: int) -> int:
        """Return the row that a robot books along an edge."""
        return self.get_vertex_row(robot, self.n_vertices + edge)

    def list_rows_of_lap(
        self, roadmap: Roadmap, robot: int, vertices: Sequence[int]
    ) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return the rows of a lap's vertices, and of the edges driven out of them.

        Parameters
        ----------
        roadmap
            The vertices and edges.
        robot
            The robot that makes the lap.
        vertices
            Where it goes; an edge leads from the last one to the first.
        """
        visited = np.array(vertices, np.int32)
        edges = roadmap.find_edges(visited, np.concatenate((visited[1:], visited[:1])))
        return visited + self.get_vertex_row(robot, 0), edges + self.get_edge_row(robot, 0)


def bind_resources(roadmap: Roadmap, radii: Sequence[Fraction], clearance: Fraction) -> Resources:
    """Return the resources of a fleet.

    Raises
    ------
    InputError
        For zones that hold more than `MOST_PAIRS_IN_ZONES` pairs.
    """
    _refuse_large_zones(roadmap)
    sizes = tuple(sorted(set(radii)))
    return Resources(
        roadmap=roadmap,
        sizes=sizes,
        clearance=clearance,
        size_of=np.array([sizes.index(radius) for radius in radii], np.int32),
    )


def make_points(roadmap: Roadmap, n_robots: int) -> Resources:
    """Return the resources of a fleet of points."""
    return Resources(
        roadmap=(
            replace(roadmap, zones=(), passing=None, lanes=(), originals={})
            if roadmap.zones or roadmap.passing is not None or roadmap.has_shared_places
            else roadmap
        ),
        sizes=(Fraction(0),),
        clearance=Fraction(0),
        size_of=np.zeros(n_robots, np.int32),
    )


def list_members(roadmap: Roadmap, zone: Zone) -> list[int]:
    """Return the resources of a zone.

    An edge that ends at a vertex of the zone is left out, because the vertex is booked as long.
    """
    inside = {*zone.vertices}
    numbers = [
        edge for ends in zone.edges if inside.isdisjoint(ends) for edge in roadmap.list_edges(*ends)
    ]
    copies = {} if roadmap.passing is None else roadmap.passing.copies
    vertices = [at for vertex in zone.vertices for at in copies.get(vertex, [vertex])]
    return [*vertices, *(roadmap.n_vertices + edge for edge in numbers)]


def _refuse_large_zones(roadmap: Roadmap) -> None:
    n_pairs = 0
    for zone in roadmap.zones:
        n_members = len(list_members(roadmap, zone))
        n_pairs += n_members * (n_members - 1) // 2
        if n_pairs > MOST_PAIRS_IN_ZONES:
            message = f"zone {quote(zone.name)} holds {n_members} vertices and lanes, and zones"
            message += f" up to it {n_pairs} pairs of them, more than {MOST_PAIRS_IN_ZONES}"
            raise InputError.at(("map", "zones"), f"{message} (draw smaller zones)")


def scale_positions(roadmap: Roadmap, lengths: Sequence[Fraction]) -> tuple[list[int], int]:
    """Return x and y of each vertex in turn, in whole multiples of 1 / scale, and the scale.

    The lengths are whole multiples, too.
    """
    scale = lcm(*(length.denominator for length in lengths))
    if roadmap.grid is not None:
        grid = roadmap.grid
        scale = lcm(scale, grid.cell_size.denominator)
        step = int(grid.cell_size * scale)
        rows, columns = np.divmod(grid.cells, grid.columns)
        return [step * k for k in np.column_stack((columns, rows)).ravel().tolist()], scale
    decimals = [Decimal(repr(x)) for x in roadmap.positions.ravel().tolist()]
    places = max([0, *(-int(number.as_tuple().exponent) for number in decimals)])
    scale = lcm(scale, 10**places)
    scale = lcm(scale, *(x.denominator for point in roadmap.fractions.values() for x in point))
    factor = scale // 10**places
    whole = [int(number.scaleb(places)) * factor for number in decimals]
    for vertex, point in roadmap.fractions.items():
        whole[2 * vertex : 2 * vertex + 2] = [int(x * scale) for x in point]
    return whole, scale


class _Drawing:
    """The positions of a roadmap as whole multiples of one length, and its lanes.

    A lane is the straight line between two vertices, whichever way it is driven.
    """

    def __init__(self, roadmap: Roadmap, lengths: Sequence[Fraction]) -> None:
        whole, self.scale = scale_positions(roadmap, lengths)
        self.x, self.y = (self._convert_from_least(whole[axis::2]) for axis in (0, 1))
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        heads = roadmap.heads.astype(np.int64)
        ends = np.minimum(tails, heads) * roadmap.n_vertices + np.maximum(tails, heads)
        self.a, self.b = np.divmod(np.unique(ends), roadmap.n_vertices)

    @staticmethod
    def _convert_from_least(values: list[int]) -> Exact:
        least, most = min(values), max(values)
        kind = np.int64 if most - least < LARGEST_FAST else object
        return np.array([value - least for value in values], kind)

    @property
    def n_parts(self) -> int:
        """Number of parts that `candidates` yields: some vertices at a time, then some lanes."""
        return sum(-(-len(all_) // LANES_AT_ONCE) for all_ in (self.x, self.a))

    def find_candidates(self, reach: Fraction) -> Iterator[Candidates]:
        """Yield vertex pairs, vertices with lanes, lane pairs: all within reach, and few more.

        They come in `n_parts` parts.
        """
        points = np.array(
            [[x / self.scale, y / self.scale] for x, y in zip(self.x, self.y, strict=True)]
        )
        slack = SLACK * float(np.abs(points).max() + reach)
        near = float(reach) + slack
        none: Pairs = (np.zeros(0, np.int64), np.zeros(0, np.int64))
        check_work(FINDING)
        vertices = PointGrid(points, near)
        for begin in range(0, len(points), LANES_AT_ONCE):
            left, right = vertices.find_near(points[begin : begin + LANES_AT_ONCE])
            upwards = left + begin < right
            yield ((left + begin)[upwards], right[upwards]), none, none
        lanes = Lines(points[self.a], points[self.b])
        vertices = PointGrid(points, near + lanes.piece / 2 + slack)
        middles = PointGrid(lanes.middles, lanes.piece + 2 * slack)
        for begin in range(0, len(self.a), LANES_AT_ONCE):
            some = slice(begin, begin + LANES_AT_ONCE)
            lane, vertex = lanes.find_near_points(vertices, some, near)
            yield none, (vertex, lane), lanes.find_crossing(middles, some, slack)

    def close_pairs(self, distance: Fraction) -> ClosePairs:
        """Return vertices and lanes nearer than a distance, and lanes that cross."""
        limit = int(distance * self.scale) ** 2
        lanes = list(zip(self.a.tolist(), self.b.tolist(), strict=True))
        pairs = ClosePairs(vertices=[], beside=[], crossings=[])
        for done, part in enumerate(self.find_candidates(distance)):
            (left, right), (vertex, lane), (first, other) = part
            check_work(Fact("part done", doing=FINDING, done=done, parts=self.n_parts))
            near = self._measure_square(left, right) < limit
            beside = self._is_passing(vertex, lane, limit)
            crossing = self._is_crossing(first, other)
            pairs.vertices.extend(zip(left[near].tolist(), right[near].tolist(), strict=True))
            passed = zip(vertex[beside].tolist(), lane[beside].tolist(), strict=True)
            pairs.beside.extend((vertex, lanes[passing]) for vertex, passing in passed)
            crossed = zip(first[crossing].tolist(), other[crossing].tolist(), strict=True)
            pairs.crossings.extend((lanes[left], lanes[right]) for left, right in crossed)
        return pairs

    def _measure_square(self, left: Ints, right: Ints) -> Exact:
        """Return the squared distance of vertices."""
        square: Exact = (self.x[left] - self.x[right]) ** 2 + (self.y[left] - self.y[right]) ** 2
        return square

    def _compute_side(self, vertex: Ints, lane: Ints) -> Exact:
        """Return the cross product that tells on which side of a lane's line a vertex lies."""
        a, b = self.a[lane], self.b[lane]
        dx, dy = self.x[b] - self.x[a], self.y[b] - self.y[a]
        cross_product: Exact = dx * (self.y[vertex] - self.y[a]) - dy * (self.x[vertex] - self.x[a])
        return cross_product

    def _is_passing(self, vertex: Ints, lane: Ints, limit: int) -> NDArray[np.bool_]:
        """Return where a lane comes nearer to a vertex than the limit, and its ends do not."""
        a, b = self.a[lane], self.b[lane]
        dx, dy = self.x[b] - self.x[a], self.y[b] - self.y[a]
        square = dx * dx + dy * dy
        along = (self.x[vertex] - self.x[a]) * dx + (self.y[vertex] - self.y[a]) * dy
        inside = (along > 0) & (along < square)
        ends_are_clear = (self._measure_square(vertex, a) >= limit) & (
            self._measure_square(vertex, b) >= limit
        )
        is_beside: NDArray[np.bool_] = (inside & ends_are_clear).astype(bool)
        side = self._compute_side(vertex[is_beside], lane[is_beside]).astype(object)
        is_beside[is_beside] = side**2 < limit * square[is_beside].astype(object)
        return is_beside

    def _is_crossing(self, first: Ints, other: Ints) -> NDArray[np.bool_]:
        """Return where two lanes cross in a point that is an end of neither."""
        ends_of_other = (
            self._compute_side(self.a[other], first),
            self._compute_side(self.b[other], first),
        )
        ends_of_one = (
            self._compute_side(self.a[first], other),
            self._compute_side(self.b[first], other),
        )
        crosses: NDArray[np.bool_] = np.array(
            (np.sign(ends_of_other[0]) * np.sign(ends_of_other[1]) < 0)
            & (np.sign(ends_of_one[0]) * np.sign(ends_of_one[1]) < 0),
            bool,
        )
        return crosses
