"""Bookings of what is closed, and drives along barred edges.

The judge has its own geometry: it asks of each place that a robot books at the time of a closure
how near it is, in fractions.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from itertools import pairwise, product
from math import ceil, floor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.check.faults import Fault
from rightofway.check.visits import Visits
from rightofway.model import NEVER, Closure, Scenario, Tick
from rightofway.site import Roadmap, VertexId

Place = tuple[int, int]
"""A vertex, twice; or the ends of an edge, the lower number first."""

Vector = tuple[Fraction, Fraction]


def judge_barred(visits: Visits) -> Iterator[Fault]:
    """Find drives along edges that are barred for the robot's type, or too near to a wall."""
    scenario, following = visits.scenario, np.roll(visits.vertex, -1)
    for visit in np.flatnonzero(visits.barred).tolist():
        robot, tail, head = (
            int(value) for value in (visits.robot[visit], visits.vertex[visit], following[visit])
        )
        robot_type = scenario.robots[robot].type
        kind = int(scenario.roadmap.class_of_edge[visits.edge[visit]])
        is_barred = robot_type in scenario.roadmap.edge_classes[kind].barred
        yield Fault(
            kind="barred",
            robots=(robot,),
            vertices=(VertexId(tail), VertexId(head)),
            tick=Tick(int(visits.leave[visit])),
            numbers={"type": robot_type if is_barred else None},
            scenario=scenario,
        )


def judge_closures(visits: Visits) -> Iterator[Fault]:
    """Find bookings of what is closed.

    A robot books its vertices, headway included, and the edges that it drives along. A closure
    begins at the tick at or before its ``from`` and ends at the tick at or after its ``until``.
    """
    scenario = visits.scenario
    if not scenario.closures:
        return
    tick, booked = scenario.problem.clock.tick, _list_bookings(visits)
    reaches = [robot.radius + scenario.rules.clearance for robot in scenario.robots]
    sizes = sorted(set(reaches))
    size = np.array([sizes.index(reach) for reach in reaches])[booked.robot]
    n = scenario.roadmap.n_vertices
    codes, kind = np.unique((booked.places @ [n, 1]) * len(sizes) + size, return_inverse=True)
    for closure in scenario.closures:
        shut = _Shut(closure, scenario.roadmap)
        begin = floor(closure.from_ / tick)
        end = None if closure.until is None else ceil(closure.until / tick)
        at_the_time = booked.end > begin
        if end is not None:
            at_the_time &= booked.start < end
        at_once = np.flatnonzero(at_the_time.astype(bool))
        is_shut = np.zeros(len(codes), bool)
        present = np.unique(kind[at_once])
        if closure.radius is None:
            present = present[np.isin(codes[present] // len(sizes), shut.list_own_codes(n))]
        for index in present.tolist():
            place, own = divmod(int(codes[index]), len(sizes))
            is_shut[index] = shut.holds(divmod(place, n), sizes[own])
        for k in at_once[is_shut[kind[at_once]]].tolist():
            first, second = booked.places[k].tolist()
            moment = max(int(booked.start[k]), begin)
            yield _make_fault(int(booked.robot[k]), (first, second), moment, end, scenario)


class _Booked(NamedTuple):
    """All bookings of a plan: robots, places and times [ticks]; arrays of n rows."""

    robot: NDArray[np.int64]
    places: NDArray[np.int64]
    start: NDArray[Any]
    end: NDArray[Any]


def _list_bookings(visits: Visits) -> _Booked:
    """Return what robots book: vertices, and edges while they drive along them."""
    headway = visits.scenario.problem.booking_rules.headway
    never = max(visits.leave.max(), NEVER) + headway
    stays, drives = np.flatnonzero(visits.known), np.flatnonzero(visits.edge >= 0)
    tails, heads = visits.vertex[drives], np.roll(visits.vertex, -1)[drives]
    lanes = np.column_stack((np.minimum(tails, heads), np.maximum(tails, heads)))
    ends = np.where(visits.last, never, visits.vertex_end + headway)
    return _Booked(
        robot=np.concatenate((visits.robot[stays], visits.robot[drives])),
        places=np.concatenate((visits.vertex[stays][:, None].repeat(2, axis=1), lanes)),
        start=np.concatenate((visits.vertex_start[stays], visits.edge_start[drives])),
        end=np.concatenate((ends[stays], (visits.edge_end + headway)[drives])),
    )


class _Shut:
    """The places that a closure closes."""

    def __init__(self, closure: Closure, roadmap: Roadmap) -> None:
        self.closure, self.roadmap = closure, roadmap
        ends = closure.edge or ()
        self.ends = frozenset(at for end in ends for at in roadmap.list_place(end))
        self.ways = list(self._list_ways())

    def _list_ways(self) -> Iterator[list[int]]:
        """Yield the vertices along each drawing of the closed lane, or the closed vertex."""
        if self.closure.edge is None:
            assert self.closure.at is not None, "the scenario has refused this"
            yield [self.closure.at]
            return
        drawn = self.roadmap.passing or self.roadmap
        indptr, heads = drawn.indptr, drawn.heads
        places = [self.roadmap.list_place(end) for end in self.closure.edge]
        for ends in product(*places):
            if any(
                head in heads[indptr[tail] : indptr[tail + 1]] for tail, head in (ends, ends[::-1])
            ):
                yield [*ends]
        for lane in self.roadmap.lanes:
            if lane.ends in {*product(*places), *product(*places[::-1])}:
                yield list(lane.vertices)

    @cached_property
    def _inside(self) -> set[Place]:
        """The closure's own places: the vertex; or the pieces of the lane, and what joins them."""
        if self.closure.at is not None:
            at = self.closure.at
            return {(vertex, vertex) for vertex in self.roadmap.list_place(at)}
        joints = {(vertex, vertex) for path in self.ways for vertex in path[1:-1]}
        lanes = (ends for path in self.ways for ends in pairwise(path))
        return joints | {(min(ends), max(ends)) for ends in lanes}

    def list_own_codes(self, n: int) -> list[int]:
        """Return the closure's own places as one number each, of n vertices."""
        return [tail * n + head for tail, head in self._inside]

    def holds(self, place: Place, reach: Fraction) -> bool:
        """Return whether a robot of a radius, clearance included, may not book a place."""
        if place in self._inside:
            return True
        if self.closure.radius is None:
            return False
        if not self.ends.isdisjoint(place):
            return False
        limit = (self.closure.radius + reach) ** 2
        start, other = (self._place_of(vertex) for vertex in place)
        lines = (
            ends for path in self.ways for ends in (pairwise(path) if len(path) > 1 else [path * 2])
        )
        return any(
            _measure_square_between(start, other, self._place_of(begin), self._place_of(end))
            < limit
            for begin, end in lines
        )

    def _place_of(self, vertex: int) -> Vector:
        return self.roadmap.get_position(vertex)


def _measure_square_between(p: Vector, q: Vector, r: Vector, s: Vector) -> Fraction:
    """Return the square of the distance of two straight lines, p to q and r to s."""

    def cross(o: Vector, a: Vector, b: Vector) -> Fraction:
        return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])

    def from_point(o: Vector, a: Vector, b: Vector) -> Fraction:
        along = (b[0] - a[0], b[1] - a[1])
        square = along[0] ** 2 + along[1] ** 2
        part = Fraction(0)
        if square:
            part = ((o[0] - a[0]) * along[0] + (o[1] - a[1]) * along[1]) / square
            part = max(Fraction(0), min(Fraction(1), part))
        return (o[0] - a[0] - part * along[0]) ** 2 + (o[1] - a[1] - part * along[1]) ** 2

    if cross(p, q, r) * cross(p, q, s) < 0 and cross(r, s, p) * cross(r, s, q) < 0:
        return Fraction(0)
    return min(from_point(p, r, s), from_point(q, r, s), from_point(r, p, q), from_point(s, p, q))


def _make_fault(
    robot: int, place: Place, moment: int, end: int | None, scenario: Scenario
) -> Fault:
    return Fault(
        kind="closed",
        robots=(robot,),
        vertices=tuple(VertexId(vertex) for vertex in dict.fromkeys(place)),
        tick=Tick(moment),
        numbers={"end": end},
        scenario=scenario,
    )
