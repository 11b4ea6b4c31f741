"""Robots with a size: bookings that exclude each other and overlap, and discs that meet.

The judge has its own geometry. A shape is a vertex, or the straight lane between two vertices. Two
shapes that may be too near are found in a hash of square cells; then the motions on each of the
two is compared in order of time. Whole multiples of one length, of a tick and of each drive decide
exactly; floating-point numbers only leave out pairs that are far apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import floor, lcm, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault
from rightofway.check.visits import Visits
from rightofway.model import Tick
from rightofway.model.sorting import order_by
from rightofway.site import Roadmap, VertexId

Indices = NDArray[np.int64]
Exact = NDArray[Any]

CHUNK = 2**20
"""About how many pairs are made together."""

LEEWAY = 1e-7
"""Floating-point distances are trusted up to this part of the roadmap's size."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Times:
    """Stays and drives on shapes, with their times; each array has shape (n,)."""

    shape: Indices
    robot: Indices
    visit: Indices
    start: NDArray[Any]  # [ticks]
    end: NDArray[Any]  # [ticks]

    def sort(self) -> _Times:
        """Return all that has a duration, by shape, then by start."""
        order = order_by(self.shape, self.start)
        order = order[np.array(self.start < self.end, bool)[order]]
        return _Times(
            shape=self.shape[order],
            robot=self.robot[order],
            visit=self.visit[order],
            start=self.start[order],
            end=self.end[order],
        )


def judge_space(visits: Visits) -> Iterator[Fault]:
    """Find bookings of different places that exclude each other, and robots that come too near."""
    if any(robot.radius for robot in visits.scenario.robots):
        shapes = _Shapes(visits)
        yield from _judge_bookings(visits, shapes)
        yield from _judge_discs(visits, shapes)


class _Near(NamedTuple):
    """Of each shape k the shapes near it: those from first[k] to first[k + 1]."""

    first: Indices
    shapes: Indices


class _Shapes:
    """The shapes that a plan uses: vertices first, then lanes, in whole multiples of a length."""

    def __init__(self, visits: Visits) -> None:
        roadmap, clearance = visits.scenario.roadmap, visits.scenario.rules.clearance
        radii = [robot.radius for robot in visits.scenario.robots]
        n = roadmap.n_vertices
        drives = visits.edge >= 0
        tail, head = visits.vertex[drives], np.roll(visits.vertex, -1)[drives]
        lanes, lane = np.unique(
            np.minimum(tail, head) * n + np.maximum(tail, head), return_inverse=True
        )
        self.of_drive = np.full(len(visits.vertex), -1)
        self.of_drive[drives] = n + lane
        self.one = np.concatenate((np.arange(n), lanes // n))
        self.other = np.concatenate((np.arange(n), lanes % n))
        axes, sizes = _collect_coordinates(roadmap), set(radii)
        numbers = (*axes[0][0], *axes[1][0], *sizes, clearance)
        self._scale = lcm(*(value.denominator for value in numbers))
        self.x, self.y = (
            np.array([int(value * self._scale) for value in values], object)[index]
            for values, index in axes
        )
        scaled = {radius: int(radius * self._scale) for radius in sizes}
        self._radius = np.array([scaled[radius] for radius in radii], object)
        self._clearance = int(clearance * self._scale)
        is_used = np.zeros(len(self.one), bool)
        is_used[visits.vertex[visits.known]] = is_used[n:] = True
        first, second = self._find_nearby(np.flatnonzero(is_used))
        self.near = self._list_near(first, second)
        ends = self.one[first], self.other[first]
        meet = [end == far[second] for end in ends for far in (self.one, self.other)]
        without = ~np.logical_or.reduce(meet)
        self.near_without_common_vertex = self._list_near(first[without], second[without])

    def _list_near(self, first: Indices, second: Indices) -> _Near:
        """Return pairs of shapes, sorted by the first, as a list for each shape."""
        return _Near(np.searchsorted(first, np.arange(len(self.one) + 1)), second)

    def compute_least_distances(self, i: Indices, j: Indices) -> Exact:
        """Return the least distance of robots, 0 where none of the two has a size."""
        both = self._radius[i] + self._radius[j]
        distance: Exact = np.where(both == 0, 0, both + self._clearance)
        return distance

    def compute_length(self, square: Fraction) -> float:
        """Return the length [length unit] of which the square in whole multiples is given."""
        return sqrt(square) / self._scale

    @staticmethod
    def together(times: _Times, near: _Near) -> Iterator[tuple[Indices, Indices]]:
        """Yield pairs of entries of different robots, near each other, that overlap in time."""
        moments, rank = np.unique(np.concatenate((times.start, times.end)), return_inverse=True)
        start, end = np.split(rank.reshape(-1), 2)
        keys = times.shape * len(moments) + start
        counts = near.first[times.shape + 1] - near.first[times.shape]
        ends = np.cumsum(counts)
        begin = 0
        while begin < len(counts):
            before = ends[begin] - counts[begin]
            stop = max(int(np.searchsorted(ends, before + CHUNK)), begin + 1)
            left_shape, place = _expand_ranges(
                near.first[times.shape[begin:stop]], counts[begin:stop]
            )
            left_shape += begin
            near_times = near.shapes[place] * len(moments)
            first = np.searchsorted(keys, near_times + start[left_shape])
            after = np.searchsorted(keys, near_times + end[left_shape])
            which, place = _expand_ranges(first, np.maximum(after - first, 0))
            left, right = left_shape[which], place
            is_first = (start[left] < start[right]) | (left < right)
            wanted = is_first & (times.robot[left] != times.robot[right])
            yield left[wanted], right[wanted]
            begin = stop

    def exclude(self, first: Indices, second: Indices, limit: Exact) -> NDArray[np.bool_]:
        """Return whether two shapes without a common vertex come nearer than a distance."""
        a, b, c, d = self.one[first], self.other[first], self.one[second], self.other[second]
        apart = (a != c) & (a != d) & (b != c) & (b != d) & (limit > 0)
        excluded = np.zeros(len(first), bool)
        a, b, c, d, square = a[apart], b[apart], c[apart], d[apart], limit[apart] ** 2
        near = self._is_within(a, c, d, square) | self._is_within(b, c, d, square)
        near |= self._is_within(c, a, b, square) | self._is_within(d, a, b, square)
        near |= (self._turn(a, b, c) * self._turn(a, b, d) < 0) & (
            self._turn(c, d, a) * self._turn(c, d, b) < 0
        )
        excluded[apart] = near
        return excluded

    def _turn(self, p: Indices, q: Indices, r: Indices) -> Exact:
        """Return a number above 0 where p, q, r turn one way, below 0 the other way."""
        x, y = self.x, self.y
        turns: Exact = (x[q] - x[p]) * (y[r] - y[p]) - (y[q] - y[p]) * (x[r] - x[p])
        return turns

    def _is_within(self, p: Indices, a: Indices, b: Indices, square: Exact) -> NDArray[np.bool_]:
        """Return whether a point is nearer to a straight line than the root of a number."""
        x, y = self.x, self.y
        run, rise = x[b] - x[a], y[b] - y[a]
        along = (x[p] - x[a]) * run + (y[p] - y[a]) * rise
        whole = run**2 + rise**2
        to_a = (x[p] - x[a]) ** 2 + (y[p] - y[a]) ** 2 < square
        to_b = (x[p] - x[b]) ** 2 + (y[p] - y[b]) ** 2 < square
        beside = (along > 0) & (along < whole) & (self._turn(a, b, p) ** 2 < square * whole)
        return np.array(to_a | to_b | beside, bool)

    def _find_nearby(self, used: Indices) -> tuple[Indices, Indices]:
        """Return pairs of shapes, sorted, that robots may be too near on; each with itself, too."""
        x = np.array([value / self._scale for value in self.x - self.x.min()], float)
        y = np.array([value / self._scale for value in self.y - self.y.min()], float)
        widest = sum(sorted(self._radius)[-2:]) + self._clearance
        reach = widest / self._scale + LEEWAY * float(max(x.max(), y.max(), 1.0))
        p, q = np.column_stack((x, y))[self.one[used]], np.column_stack((x, y))[self.other[used]]
        size = np.hypot(*(q - p).T)
        cell = max(reach, float(np.median(size[size > 0], keepdims=False)) if size.any() else 0.0)
        pieces = np.maximum(np.ceil(size / cell).astype(np.int64), 1)
        owner, piece = _expand_ranges(np.zeros(len(used), np.int64), pieces)
        step = ((q - p) / pieces[:, None])[owner]
        begin = p[owner] + step * piece[:, None]
        low = np.floor((np.minimum(begin, begin + step) - reach / 2) / cell).astype(np.int64)
        high = np.floor((np.maximum(begin, begin + step) + reach / 2) / cell).astype(np.int64)
        width, height = (high - low + 1).T
        which, square = _expand_ranges(np.zeros(len(owner), np.int64), width * height)
        column, row = low[which, 0] + square % width[which], low[which, 1] + square // width[which]
        order = order_by(row, column)
        which, column, row = which[order], column[order], row[order]
        begins = np.flatnonzero(np.append(True, (np.diff(row) != 0) | (np.diff(column) != 0)))
        counts = np.diff(np.append(begins, len(order)))
        left, right = _expand_ranges(np.repeat(begins, counts), np.repeat(counts, counts))
        # Two pieces share several cells; they are compared in the one of greatest low corners.
        i, j = which[left], which[right]
        corner = (column[left] == np.maximum(low[i, 0], low[j, 0])) & (
            row[left] == np.maximum(low[i, 1], low[j, 1])
        )
        pairs = np.sort(owner[i[corner]] * len(used) + owner[j[corner]])
        pairs = pairs[np.append(True, np.diff(pairs) != 0)]
        first, second = np.divmod(pairs, len(used))
        near = _estimate_distances(p[first], q[first], p[second], q[second]) <= reach
        return used[first[near]], used[second[near]]


def _collect_coordinates(roadmap: Roadmap) -> list[tuple[list[Fraction], Indices]]:
    """Return numbers, and which of them is x of each vertex; the same for y.

    The numbers are exact.
    """
    grid = roadmap.grid
    if grid is not None:
        rows, columns = np.divmod(grid.cells, grid.columns)
        steps = [k * grid.cell_size for k in range(max(grid.rows, grid.columns))]
        return [(steps, columns), (steps, rows)]
    axes = zip(*roadmap.list_positions(), strict=True)
    return [(list(axis), np.arange(len(axis))) for axis in axes]


def _expand_ranges(first: Indices, counts: Indices) -> tuple[Indices, Indices]:
    """Return (k, first[k]), (k, first[k] + 1), … : for each k as many as counts[k]."""
    owner = np.repeat(np.arange(len(counts)), counts)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, first[owner] + rank


def _estimate_distances(
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    c: NDArray[np.float64],
    d: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return about how far straight lines a to b and c to d are apart."""

    def cross(u: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    def to_line(
        p: NDArray[np.float64], u: NDArray[np.float64], v: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        direction = v - u
        square = np.maximum((direction**2).sum(axis=1), np.finfo(float).tiny)
        share = np.clip(((p - u) * direction).sum(axis=1) / square, 0, 1)
        gap: NDArray[np.float64] = np.hypot(*(p - u - share[:, None] * direction).T)
        return gap

    ends = (to_line(a, c, d), to_line(b, c, d), to_line(c, a, b), to_line(d, a, b))
    crossing = (cross(b - a, c - a) * cross(b - a, d - a) < 0) & (
        cross(d - c, a - c) * cross(d - c, b - c) < 0
    )
    distances: NDArray[np.float64] = np.where(crossing, 0.0, np.minimum.reduce(ends))
    return distances


def _find_first_of_each(
    times: _Times, first: Indices, second: Indices, worth: Exact
) -> Iterator[int]:
    """Yield of each meeting of two robots the pair of least worth; its parts overlap in time."""
    i, j = times.robot[first], times.robot[second]
    start = np.maximum(times.start[first], times.start[second])
    end = np.minimum(times.end[first], times.end[second])
    order = order_by(np.minimum(i, j), np.maximum(i, j), start)
    best, until, robots = -1, None, None
    for k in order.tolist():
        pair = {int(i[k]), int(j[k])}
        if pair == robots and start[k] <= until:
            until = max(until, end[k])
            best = k if worth[k] < worth[best] else best
            continue
        if best >= 0:
            yield best
        best, until, robots = k, end[k], pair
    if best >= 0:
        yield best


def _judge_bookings(visits: Visits, shapes: _Shapes) -> Iterator[Fault]:
    headway = visits.scenario.problem.booking_rules.headway
    stays, drives = np.flatnonzero(visits.known), np.flatnonzero(visits.edge >= 0)
    bookings = _Times(
        shape=np.concatenate((visits.vertex[stays], shapes.of_drive[drives])),
        robot=np.concatenate((visits.robot[stays], visits.robot[drives])),
        visit=np.concatenate((stays, drives)),
        start=np.concatenate((visits.vertex_start[stays], visits.edge_start[drives])),
        end=np.concatenate((visits.vertex_end[stays], visits.edge_end[drives])) + headway,
    ).sort()
    pairs: list[tuple[Indices, Indices]] = []
    for first, second in shapes.together(bookings, shapes.near_without_common_vertex):
        limit = shapes.compute_least_distances(bookings.robot[first], bookings.robot[second])
        excluded = shapes.exclude(bookings.shape[first], bookings.shape[second], limit)
        pairs.append((first[excluded], second[excluded]))
    first, second = (np.concatenate(part) for part in zip(*pairs, strict=True))
    start = np.maximum(bookings.start[first], bookings.start[second])
    for k in _find_first_of_each(bookings, first, second, start):
        pair = sorted((int(first[k]), int(second[k])), key=lambda entry: int(bookings.robot[entry]))
        robots = tuple(int(bookings.robot[entry]) for entry in pair)
        places = [_list_ends(visits, bookings, entry) for entry in pair]
        yield Fault(
            kind="space conflict",
            robots=robots,
            vertices=(*places[0], *places[1]),
            tick=Tick(int(start[k])),
            numbers={"places": places},
            scenario=visits.scenario,
        )


def _list_ends(visits: Visits, times: _Times, entry: int) -> tuple[VertexId, ...]:
    """Return the vertex of an entry, or tail and head of its edge."""
    visit = int(times.visit[entry])
    tail = VertexId(int(visits.vertex[visit]))
    if times.shape[entry] < visits.scenario.roadmap.n_vertices:
        return (tail,)
    return tail, VertexId(int(visits.vertex[visit + 1]))


def _judge_discs(visits: Visits, shapes: _Shapes) -> Iterator[Fault]:
    """Find robots that come too near at any instant of their stays and straight drives."""
    begun = np.where(
        visits.edge >= 0, np.maximum(visits.leave - visits.drive, visits.enter), visits.leave
    )
    stays, drives = np.flatnonzero(visits.known), np.flatnonzero(visits.edge >= 0)
    motions = _Times(
        shape=np.concatenate((visits.vertex[stays], shapes.of_drive[drives])),
        robot=np.concatenate((visits.robot[stays], visits.robot[drives])),
        visit=np.concatenate((stays, drives)),
        start=np.concatenate((visits.enter[stays], begun[drives])),
        end=np.concatenate((begun[stays], visits.leave[drives])),
    ).sort()
    parts = [
        _find_encounters(visits, shapes, motions, *pair)
        for pair in shapes.together(motions, shapes.near)
    ]
    first, second, square, when = (np.concatenate(part) for part in zip(*parts, strict=True))
    for k in _find_first_of_each(motions, first, second, square):
        pair = sorted((int(first[k]), int(second[k])), key=lambda entry: int(motions.robot[entry]))
        robots = tuple(int(motions.robot[entry]) for entry in pair)
        places = [_list_ends(visits, motions, entry) for entry in pair]
        needed = int(
            shapes.compute_least_distances(
                motions.robot[first[k : k + 1]], motions.robot[second[k : k + 1]]
            )[0]
        )
        yield Fault(
            kind="too close",
            robots=robots,
            vertices=(*places[0], *places[1]),
            tick=Tick(floor(when[k])),
            numbers={
                "places": places,
                "distance": shapes.compute_length(square[k]),
                "needed": shapes.compute_length(Fraction(needed**2)),
                "instant": when[k],
            },
            scenario=visits.scenario,
        )


def _find_encounters(
    visits: Visits, shapes: _Shapes, motions: _Times, first: Indices, second: Indices
) -> tuple[Indices, Indices, Exact, Exact]:
    """Return the pairs of motions that come too near: the least squared distance, and when.

    The difference of two uniform motions is one, too: offset + speed * time, here multiplied by the
    durations of both. It is least at the ends of their common time, or where its square has its
    least value.
    """
    limit = shapes.compute_least_distances(motions.robot[first], motions.robot[second])
    sized = np.array(limit > 0, bool)
    first, second, limit = first[sized], second[sized], limit[sized]
    x1, y1, u1, v1, whole1 = _trace_line(visits, shapes, motions, first)
    x2, y2, u2, v2, whole2 = _trace_line(visits, shapes, motions, second)
    start = np.maximum(motions.start[first], motions.start[second]).astype(object)
    end = np.minimum(motions.end[first], motions.end[second]).astype(object)
    u, v = u1 * whole2 - u2 * whole1, v1 * whole2 - v2 * whole1
    x = x1 * whole2 - x2 * whole1 + u * start
    y = y1 * whole2 - y2 * whole1 + v * start
    last = end - start
    toward, speed = -(x * u + y * v), u * u + v * v
    at_start, at_end = toward <= 0, toward >= speed * last
    x_end, y_end = x + u * last, y + v * last
    top = np.where(
        at_start, x * x + y * y, np.where(at_end, x_end**2 + y_end**2, (x * v - y * u) ** 2)
    )
    between = ~np.array(at_start | at_end, bool)
    bottom = (whole1 * whole2) ** 2 * np.where(between, speed, 1)
    near = np.array(top < limit**2 * bottom, bool)
    rows = np.flatnonzero(near).tolist()
    squares = np.empty(len(rows), object)
    moments = np.empty(len(rows), object)
    for k, row in enumerate(rows):
        squares[k] = Fraction(top[row], bottom[row])
        after = Fraction(toward[row], speed[row]) if between[row] else Fraction(0)
        moments[k] = start[row] + (after if at_start[row] or between[row] else last[row])
    return first[near], second[near], squares, moments


def _trace_line(
    visits: Visits, shapes: _Shapes, motions: _Times, entry: Indices
) -> tuple[Exact, Exact, Exact, Exact, Exact]:
    """Return a motion as ((x, y) + (u, v) * time) / whole, all whole numbers."""
    visit, start = motions.visit[entry], motions.start[entry].astype(object)
    stays = motions.shape[entry] < len(shapes.x)
    tail = visits.vertex[visit]
    head = np.where(stays, tail, np.roll(visits.vertex, -1)[visit])
    whole = np.where(stays, 1, motions.end[entry].astype(object) - start)
    u, v = shapes.x[head] - shapes.x[tail], shapes.y[head] - shapes.y[tail]
    return shapes.x[tail] * whole - u * start, shapes.y[tail] * whole - v * start, u, v, whole
