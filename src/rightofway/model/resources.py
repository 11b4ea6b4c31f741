"""What robots book, and which bookings exclude each other.

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

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from itertools import combinations_with_replacement
from math import isqrt, lcm, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, shown
from rightofway.model.deadline import check_work
from rightofway.site import Point, Roadmap, squared_distance
from rightofway.site.nearness import Lines, PointGrid
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

KEYS_AT_ONCE = 1 << 20
"""Pairs of rows that are sorted at once, about."""

LARGEST_FAST = 2**30
"""Below this number, products of two differences of coordinates fit 64 bits."""

FINDING = "finding vertices and lanes that two robots may not book at once"

Ints = NDArray[np.int64]
Pairs = tuple[Ints, Ints]
Candidates = tuple[Pairs, Pairs, Pairs]
"""Pairs of vertices, vertices with lanes, pairs of lanes."""
Exact = NDArray[Any]
"""Integers of 64 bits where they fit, else Python integers of any size."""


def refuse_sizes(resources: Resources, what: str, remedy: str) -> None:
    """Refuse a fleet in which a robot has a size, or whose roadmap has zones.

    Raises
    ------
    InputError
        If a robot has a size, or there is a zone.
    """
    if not resources.are_points:
        message = f"{what} does not know robots with a size or zones ({remedy})"
        raise InputError.at("", message)


def circle_around(length: Fraction, width: Fraction) -> Fraction:
    """Return the radius of the circle around a rectangle, rounded up to `RADIUS_STEP`.

    Examples
    --------
    >>> circle_around(Fraction(3), Fraction(4)), circle_around(Fraction(1), Fraction(1))
    (Fraction(5, 2), Fraction(707107, 1000000))
    """
    square = (length**2 + width**2) / (2 * RADIUS_STEP) ** 2
    below = isqrt(square.numerator // square.denominator)
    return (below + (below**2 < square)) * RADIUS_STEP


def exact_positions(roadmap: Roadmap) -> list[Point]:
    """Return the position of each vertex; a coordinate is its shortest decimal."""
    if roadmap.grid is not None:
        grid = roadmap.grid
        steps = [k * grid.cell_size for k in range(max(grid.rows, grid.columns))]
        rows, columns = np.divmod(grid.cells, grid.columns)
        cells = zip(rows.tolist(), columns.tolist(), strict=True)
        return [(steps[column], steps[row]) for row, column in cells]
    return [(Fraction(repr(x)), Fraction(repr(y))) for x, y in roadmap.positions.tolist()]


def are_nearer(roadmap: Roadmap, first: int, other: int, distance: Fraction) -> bool:
    """Return whether two vertices are nearer than a distance; exact."""
    at = exact_positions(roadmap)
    return squared_distance(at[first], at[other]) < distance**2


def distance(roadmap: Roadmap, first: int, other: int) -> float:
    """Return the distance of two vertices [length unit]."""
    at = exact_positions(roadmap)
    return sqrt(squared_distance(at[first], at[other]))


def too_short_edges(roadmap: Roadmap) -> Iterator[tuple[int, int, Fraction, float]]:
    """Yield tail, head, length and straight distance of edges that are shorter than straight.

    A part in 10**9 is rounding: positions are decimals, and pieces of lanes are not.
    """
    if roadmap.grid is not None:
        return
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    lengths = np.array([float(length) for length in roadmap.lengths])[roadmap.class_of_edge]
    begin, end = roadmap.positions[tails], roadmap.positions[roadmap.heads]
    doubt = 1e-14 * np.abs(roadmap.positions).max()  # of coordinates and their differences
    straight = np.hypot(*(end - begin).T) + doubt
    for edge in np.flatnonzero(straight > lengths * (1 + float(ROUNDING) / 2)).tolist():
        length = roadmap.edge_class(edge).length
        (x, y), (to_x, to_y) = begin[edge].tolist(), end[edge].tolist()
        tail = Fraction(repr(x)), Fraction(repr(y))
        square = squared_distance(tail, (Fraction(repr(to_x)), Fraction(repr(to_y))))
        if square > (length * (1 + ROUNDING)) ** 2:
            yield int(tails[edge]), int(roadmap.heads[edge]), length, sqrt(square)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosePairs:
    """What a drawing brings close together; a lane is its two ends, whichever way it is driven.

    Attributes
    ----------
    vertices
        Pairs of vertices that are nearer than a distance.
    beside
        Vertices that lie nearer than that beside a lane, whose ends are not as near.
    crossings
        Pairs of lanes that cross in a point that is an end of neither.
    """

    vertices: list[tuple[int, int]]
    beside: list[tuple[int, tuple[int, int]]]
    crossings: list[tuple[tuple[int, int], tuple[int, int]]]


def close_pairs(roadmap: Roadmap, distance: Fraction) -> ClosePairs:
    """Return the vertices and lanes nearer than a distance, and lanes that cross; exact."""
    return _Drawing(roadmap, [distance]).close_pairs(distance)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExcludedRows:
    """The rows that each row excludes.

    Attributes
    ----------
    first, excluded
        Robots that book row ``r`` exclude others from the rows ``excluded[first[r]:first[r + 1]]``,
        in increasing order; int32, shapes (rows + 1,) and (n,).
    """

    first: NDArray[np.int32]
    excluded: NDArray[np.int32]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Resources:
    """Which bookings of a fleet exclude each other.

    Attributes
    ----------
    n_vertices, n_edges
        Vertices and edges of the roadmap.
    size_of
        Size class of each robot; int32, shape (R,).
    lists
        The rows that each row excludes; None for points without zones, which need none.
    """

    n_vertices: int
    n_edges: int
    size_of: NDArray[np.int32]
    lists: ExcludedRows | None = field(default=None, repr=False)

    @property
    def are_points(self) -> bool:
        """Whether no robot has a size and there is no zone: a vertex excludes itself."""
        return self.lists is None

    def vertex_row(self, robot: int, vertex: int) -> int:
        """Return the row that a robot books at a vertex."""
        return int(self.size_of[robot]) * (self.n_vertices + self.n_edges) + vertex

    def edge_row(self, robot: int, edge: int) -> int:
        """Return the row that a robot books along an edge."""
        return self.vertex_row(robot, self.n_vertices + edge)

    def rows_of_lap(
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
        edges = roadmap.edges(visited, np.concatenate((visited[1:], visited[:1])))
        return visited + self.vertex_row(robot, 0), edges + self.edge_row(robot, 0)

    def excluded_by(self, row: int) -> list[int]:
        """Return the rows that a booking of a row excludes; called for each visit."""
        if self.lists is None:
            return [row] if row < self.n_vertices else []
        first, end = self.lists.first[row : row + 2].tolist()
        excluded: list[int] = self.lists.excluded[first:end].tolist()
        return excluded

    def vertices_near(self, robot: int, vertex: int) -> list[int]:
        """Return the vertices that robots of some size cannot book while a robot is at a vertex."""
        n_resources = self.n_vertices + self.n_edges
        resources = (row % n_resources for row in self.excluded_by(self.vertex_row(robot, vertex)))
        return [resource for resource in resources if resource < self.n_vertices]

    def clashes(self, places: Sequence[int]) -> Iterator[tuple[int, int]]:
        """Yield pairs of robots (i, j), i < j, that cannot stay at their places at one time.

        Parameters
        ----------
        places
            A vertex for each robot.
        """
        rows = [self.vertex_row(robot, vertex) for robot, vertex in enumerate(places)]
        holders: dict[int, list[int]] = {}
        for robot, row in enumerate(rows):
            holders.setdefault(row, []).append(robot)
        for robot, row in enumerate(rows):
            for other in self.excluded_by(row):
                yield from ((robot, holder) for holder in holders.get(other, ()) if robot < holder)


def resources_of(roadmap: Roadmap, radii: Sequence[Fraction], clearance: Fraction) -> Resources:
    """Return the resources of a fleet.

    Raises
    ------
    InputError
        For zones that hold more than `MOST_PAIRS_IN_ZONES` pairs.
    """
    sizes = tuple(sorted(set(radii)))
    has_lists = any(radii) or bool(roadmap.zones)
    return Resources(
        n_vertices=roadmap.n_vertices,
        n_edges=roadmap.n_edges,
        size_of=np.array([sizes.index(radius) for radius in radii], np.int32),
        lists=_excluded(roadmap, sizes, clearance) if has_lists else None,
    )


def points_on(roadmap: Roadmap, n_robots: int) -> Resources:
    """Return the resources of a fleet of points."""
    return Resources(
        n_vertices=roadmap.n_vertices,
        n_edges=roadmap.n_edges,
        size_of=np.zeros(n_robots, np.int32),
    )


@lru_cache(maxsize=8)
def _excluded(roadmap: Roadmap, sizes: tuple[Fraction, ...], clearance: Fraction) -> ExcludedRows:
    """Return the lists of all rows in compressed sparse rows."""
    n_vertices, n_rows = roadmap.n_vertices, roadmap.n_vertices + roadmap.n_edges
    check_work(FINDING)
    drawing = _Drawing(roadmap, [*sizes, clearance])
    reach = 2 * sizes[-1] + clearance
    same = np.arange(n_vertices)
    n_keys = len(sizes) * n_rows
    keys = list[Ints]()  # of pairs of rows: row * n_keys + column

    def exclude(size: int, other: int, pairs: Iterable[Pairs]) -> None:
        pairs_between = [
            (a * n_rows + left) * n_keys + b * n_rows + right
            for x, y in pairs
            for a, b in {(size, other), (other, size)}
            for left, right in ((x, y), (y, x))
        ]
        keys.append(np.sort(np.concatenate(pairs_between)))

    combinations = list(combinations_with_replacement(range(len(sizes)), 2))
    for size, other in combinations:
        exclude(size, other, [(same, same), *_in_zones(roadmap)])
    for done, part in enumerate(drawing.candidates(reach) if sizes[-1] > 0 else ()):
        crossing = list(drawing.crossing(part))
        for size, other in combinations:
            check_work(f"{FINDING}, {done} of {drawing.n_parts} parts of the roadmap done")
            if sizes[other] > 0:
                distance = sizes[size] + sizes[other] + clearance
                exclude(size, other, [*drawing.nearer(distance, part), *crossing])
    first, excluded = _rows_of(keys, n_keys)
    return ExcludedRows(first=first, excluded=excluded)


def _rows_of(parts: list[Ints], n_rows: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return compressed sparse rows of sorted parts of keys ``row * n_rows + column``."""
    sample = np.sort(np.concatenate([part[::1000] for part in parts]))
    ends = [*sample[KEYS_AT_ONCE // 1000 :: KEYS_AT_ONCE // 1000].tolist(), n_rows * n_rows]
    begins = np.zeros(len(parts), np.int64)
    counts, columns = np.zeros(n_rows + 1, np.int64), list[NDArray[np.int32]]()
    for end in ends:
        check_work("sorting vertices and lanes that two robots may not book at once")
        upto = np.array([np.searchsorted(part, end) for part in parts])
        some = zip(parts, begins, upto, strict=True)
        row, column = np.divmod(np.unique(np.concatenate([p[a:b] for p, a, b in some])), n_rows)
        counts += np.bincount(row + 1, minlength=n_rows + 1)
        columns.append(column.astype(np.int32))
        begins = upto
    return np.cumsum(counts).astype(np.int32), np.concatenate(columns)


def members_of(roadmap: Roadmap, zone: Zone) -> list[int]:
    """Return the resources of a zone.

    An edge that ends at a vertex of the zone is left out, because the vertex is booked as long.
    """
    inside = {*zone.vertices}
    numbers = [roadmap.edge(*ends) for ends in zone.edges if inside.isdisjoint(ends)]
    return [*zone.vertices, *(roadmap.n_vertices + edge for edge in numbers if edge is not None)]


def _in_zones(roadmap: Roadmap) -> Iterator[Pairs]:
    """Yield pairs of resources of one zone."""
    n_pairs = 0
    for zone in roadmap.zones:
        members = np.array(members_of(roadmap, zone), np.int64)
        n_pairs += len(members) * (len(members) - 1) // 2
        if n_pairs > MOST_PAIRS_IN_ZONES:
            message = f"zone {shown(zone.name)} holds {len(members)} vertices and lanes, and zones"
            message += f" up to it {n_pairs} pairs of them, more than {MOST_PAIRS_IN_ZONES}"
            raise InputError.at(("map", "zones"), f"{message} (draw smaller zones)")
        left, right = np.triu_indices(len(members), k=1)
        yield members[left], members[right]


class _Drawing:
    """The positions of a roadmap as whole multiples of one length, and its lanes.

    A lane is the straight line between two vertices, whichever way it is driven.
    """

    def __init__(self, roadmap: Roadmap, lengths: Sequence[Fraction]) -> None:
        positions = exact_positions(roadmap)
        coordinates = [coordinate for position in positions for coordinate in position]
        self.scale = lcm(*(number.denominator for number in (*coordinates, *lengths)))
        whole = [int(coordinate * self.scale) for coordinate in coordinates]
        self.x, self.y = (self._from_least(whole[axis::2]) for axis in (0, 1))
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        heads = roadmap.heads.astype(np.int64)
        ends = np.minimum(tails, heads) * roadmap.n_vertices + np.maximum(tails, heads)
        lanes, lane_of = np.unique(ends, return_inverse=True)
        self.a, self.b = np.divmod(lanes, roadmap.n_vertices)
        self._edges_by_lane = np.argsort(lane_of, kind="stable") + roadmap.n_vertices
        self._first_edge = np.searchsorted(np.sort(lane_of), np.arange(len(lanes) + 1))

    @staticmethod
    def _from_least(values: list[int]) -> Exact:
        least, most = min(values), max(values)
        kind = np.int64 if most - least < LARGEST_FAST else object
        return np.array([value - least for value in values], kind)

    @property
    def n_parts(self) -> int:
        """How many parts `candidates` yields: some vertices at a time, then some lanes."""
        return sum(-(-len(all_) // LANES_AT_ONCE) for all_ in (self.x, self.a))

    def candidates(self, reach: Fraction) -> Iterator[Candidates]:
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
            left, right = vertices.near(points[begin : begin + LANES_AT_ONCE])
            upwards = left + begin < right
            yield ((left + begin)[upwards], right[upwards]), none, none
        lanes = Lines(points[self.a], points[self.b])
        vertices = PointGrid(points, near + lanes.piece / 2 + slack)
        middles = PointGrid(lanes.middles, lanes.piece + 2 * slack)
        for begin in range(0, len(self.a), LANES_AT_ONCE):
            some = slice(begin, begin + LANES_AT_ONCE)
            lane, vertex = lanes.near_points(vertices, some, near)
            yield none, (vertex, lane), lanes.crossing(middles, some, slack)

    def crossing(self, candidates: Candidates) -> Iterator[Pairs]:
        """Yield pairs of edges that cross, both directions of a lane."""
        first, other = candidates[2]
        crossing = self._crosses(first, other)
        lanes, edges = self._with_edges(first[crossing], other[crossing])
        yield self._with_edges(edges, lanes)

    def nearer(self, distance: Fraction, candidates: Candidates) -> Iterator[Pairs]:
        """Yield vertices that are nearer than a distance to others and to edges."""
        (left, right), (vertex, lane), _ = candidates
        limit = int(distance * self.scale) ** 2
        near = self._square(left, right) < limit
        yield left[near], right[near]
        near = self._passes(vertex, lane, limit)
        yield self._with_edges(vertex[near], lane[near])

    def close_pairs(self, distance: Fraction) -> ClosePairs:
        """Return vertices and lanes nearer than a distance, and lanes that cross."""
        limit = int(distance * self.scale) ** 2
        lanes = list(zip(self.a.tolist(), self.b.tolist(), strict=True))
        pairs = ClosePairs(vertices=[], beside=[], crossings=[])
        for done, part in enumerate(self.candidates(distance)):
            (left, right), (vertex, lane), (first, other) = part
            check_work(f"{FINDING}, {done} of {self.n_parts} parts of the roadmap done")
            near = self._square(left, right) < limit
            beside = self._passes(vertex, lane, limit)
            crossing = self._crosses(first, other)
            pairs.vertices.extend(zip(left[near].tolist(), right[near].tolist(), strict=True))
            passed = zip(vertex[beside].tolist(), lane[beside].tolist(), strict=True)
            pairs.beside.extend((vertex, lanes[passing]) for vertex, passing in passed)
            crossed = zip(first[crossing].tolist(), other[crossing].tolist(), strict=True)
            pairs.crossings.extend((lanes[left], lanes[right]) for left, right in crossed)
        return pairs

    def _with_edges(self, left: Ints, lane: Ints) -> tuple[Ints, Ints]:
        """Repeat each left one for every edge of its lane."""
        counts = self._first_edge[lane + 1] - self._first_edge[lane]
        begins = np.repeat(self._first_edge[lane] - (np.cumsum(counts) - counts), counts)
        return np.repeat(left, counts), self._edges_by_lane[begins + np.arange(counts.sum())]

    def _square(self, left: Ints, right: Ints) -> Exact:
        """Return the squared distance of vertices."""
        square: Exact = (self.x[left] - self.x[right]) ** 2 + (self.y[left] - self.y[right]) ** 2
        return square

    def _side(self, vertex: Ints, lane: Ints) -> Exact:
        """Return the cross product that tells on which side of a lane's line a vertex lies."""
        a, b = self.a[lane], self.b[lane]
        dx, dy = self.x[b] - self.x[a], self.y[b] - self.y[a]
        cross_product: Exact = dx * (self.y[vertex] - self.y[a]) - dy * (self.x[vertex] - self.x[a])
        return cross_product

    def _passes(self, vertex: Ints, lane: Ints, limit: int) -> NDArray[np.bool_]:
        """Return where a lane comes nearer to a vertex than the limit, and its ends do not."""
        a, b = self.a[lane], self.b[lane]
        dx, dy = self.x[b] - self.x[a], self.y[b] - self.y[a]
        square = dx * dx + dy * dy
        along = (self.x[vertex] - self.x[a]) * dx + (self.y[vertex] - self.y[a]) * dy
        inside = (along > 0) & (along < square)
        ends_are_clear = (self._square(vertex, a) >= limit) & (self._square(vertex, b) >= limit)
        is_beside: NDArray[np.bool_] = (inside & ends_are_clear).astype(bool)
        side = self._side(vertex[is_beside], lane[is_beside]).astype(object)
        is_beside[is_beside] = side**2 < limit * square[is_beside].astype(object)
        return is_beside

    def _crosses(self, first: Ints, other: Ints) -> NDArray[np.bool_]:
        """Return where two lanes cross in a point that is an end of neither."""
        ends_of_other = self._side(self.a[other], first), self._side(self.b[other], first)
        ends_of_one = self._side(self.a[first], other), self._side(self.b[first], other)
        crosses: NDArray[np.bool_] = np.array(
            (np.sign(ends_of_other[0]) * np.sign(ends_of_other[1]) < 0)
            & (np.sign(ends_of_one[0]) * np.sign(ends_of_one[1]) < 0),
            bool,
        )
        return crosses
