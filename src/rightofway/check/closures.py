"""What is closed or barred, and who is there all the same.

The judge has its own geometry: it asks of each place that a robot books at the time of a closure
how near it is, in fractions.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import ceil, floor

import numpy as np

from rightofway.check.faults import Fault, FaultCollector, Names
from rightofway.check.visits import Visits
from rightofway.model import Closure, Plan, Roadmap, Tick, VertexId

Place = tuple[int, int]
"""A vertex, twice; or the ends of an edge, the lower number first."""

Vector = tuple[Fraction, Fraction]


def judge_barred(visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find drives along edges that are barred for the robot's type, or too near to a wall."""
    following = np.roll(visits.vertex, -1)
    for visit in np.flatnonzero(visits.barred).tolist():
        robot, tail, head = (
            int(value) for value in (visits.robot[visit], visits.vertex[visit], following[visit])
        )
        why = f"is barred for type {names.scenario.robots[robot].type}"
        if names.scenario.roadmap.widest:
            why = "is nearer to a wall than the robot's radius"
        collector.add(
            Fault(
                kind="barred",
                robots=(robot,),
                vertices=(VertexId(tail), VertexId(head)),
                tick=Tick(int(visits.leave[visit])),
                message=f"{names.robot(robot)} drives from {names.vertex(tail)} to"
                f" {names.vertex(head)}, which {why} (choose another way)",
            )
        )


def judge_closures(plan: Plan, visits: Visits, names: Names, collector: FaultCollector) -> None:
    """Find bookings of what is closed.

    A robot books its vertices, headway included, and the edges that it drives along. A closure
    begins at the tick at or before its ``from`` and ends at the tick at or after its ``until``.
    """
    if not plan.scenario.closures:
        return
    tick = plan.scenario.problem.clock.tick
    stays = list(_bookings(plan, visits))
    for closure in plan.scenario.closures:
        shut = _Shut(closure, plan.scenario.roadmap)
        begin = floor(closure.from_ / tick)
        end = None if closure.until is None else ceil(closure.until / tick)
        is_shut: dict[tuple[Place, Fraction], bool] = {}
        for robot, place, start, until in stays:
            if (until is not None and until <= begin) or (end is not None and start >= end):
                continue
            reach = plan.scenario.robots[robot].radius + plan.scenario.rules.clearance
            key = (place, reach)
            if key not in is_shut:
                is_shut[key] = shut.holds(place, reach)
            if is_shut[key]:
                moment = max(start, begin)
                collector.add(_fault(robot, place, moment, end, names))


def _bookings(plan: Plan, visits: Visits) -> list[tuple[int, Place, int, int | None]]:
    """Return robot, place, start and end of all bookings [ticks]; a last visit has no end."""
    headway, found = plan.scenario.problem.headway, []
    ahead = plan.scenario.rules.occupancy == "both"
    robot, vertex = visits.robot.tolist(), visits.vertex.tolist()
    enter, leave = visits.enter.tolist(), visits.leave.tolist()
    drive, last, edge = visits.drive.tolist(), visits.last.tolist(), visits.edge.tolist()
    approach = 0
    for k, at in enumerate(vertex):
        if visits.known[k]:
            end = None if last[k] else leave[k] + headway
            found.append((robot[k], (at, at), enter[k] - approach, end))
        if not last[k] and edge[k] >= 0:
            head = vertex[k + 1]
            place = (min(at, head), max(at, head))
            found.append((robot[k], place, leave[k] - drive[k], leave[k] + headway))
        approach = drive[k] if ahead and not last[k] else 0
    return found


class _Shut:
    """The places that a closure closes."""

    def __init__(self, closure: Closure, roadmap: Roadmap) -> None:
        self.closure, self.roadmap = closure, roadmap
        self.ends = frozenset(closure.edge or ())
        self.ways = list(self._ways())

    def _ways(self) -> Iterator[list[int]]:
        """Yield the vertices along each drawing of the closed lane, or the closed vertex."""
        if self.closure.edge is None:
            assert self.closure.at is not None, "the scenario has refused this"
            yield [self.closure.at]
            return
        one, other = self.closure.edge
        if self._is_edge(one, other):
            yield [one, other]
        labels = self.roadmap.labels or ()
        for begin, end in ((one, other), (other, one)) if labels else ():
            pieces: dict[int, int] = {}
            prefix = f"{labels[begin]}-{labels[end]}/"
            for vertex, label in enumerate(labels):
                if label.startswith(prefix) and label[len(prefix) :].isdecimal():
                    pieces[int(label[len(prefix) :])] = vertex
            way = [begin, *(pieces[k] for k in sorted(pieces)), end]
            if pieces and all(self._is_edge(*ends) for ends in pairwise(way)):
                yield way

    def _is_edge(self, one: int, other: int) -> bool:
        indptr, heads = self.roadmap.indptr, self.roadmap.heads
        return any(
            head in heads[indptr[tail] : indptr[tail + 1]]
            for tail, head in ((one, other), (other, one))
        )

    @cached_property
    def _inside(self) -> set[Place]:
        """The closure's own places: the vertex; or the pieces of the lane, and what joins them."""
        if self.closure.at is not None:
            return {(self.closure.at, self.closure.at)}
        joints = {(vertex, vertex) for way in self.ways for vertex in way[1:-1]}
        lanes = (ends for way in self.ways for ends in pairwise(way))
        return joints | {(min(ends), max(ends)) for ends in lanes}

    def holds(self, place: Place, reach: Fraction) -> bool:
        """Return whether a robot of a radius, clearance included, may not book a place."""
        if place in self._inside:
            return True
        if self.closure.radius is None:
            return False
        if not self.ends.isdisjoint(place):
            return False
        limit = (self.closure.radius + reach) ** 2
        one, other = (self._at(vertex) for vertex in place)
        lines = (
            ends for way in self.ways for ends in (pairwise(way) if len(way) > 1 else [way * 2])
        )
        return any(
            _square_between(one, other, self._at(begin), self._at(end)) < limit
            for begin, end in lines
        )

    def _at(self, vertex: int) -> Vector:
        grid = self.roadmap.grid
        if grid is not None:
            row, column = divmod(int(grid.cells[vertex]), grid.columns)
            return column * grid.cell_size, row * grid.cell_size
        x, y = self.roadmap.positions[vertex].tolist()
        return Fraction(repr(x)), Fraction(repr(y))


def _square_between(p: Vector, q: Vector, r: Vector, s: Vector) -> Fraction:
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


def _fault(robot: int, place: Place, moment: int, end: int | None, names: Names) -> Fault:
    one, other = place
    where = f"the edge between {names.vertex(one)} and {names.vertex(other)}"
    where = names.vertex(one) if one == other else where
    until = "for ever" if end is None else f"until {names.until(end)}"
    return Fault(
        kind="closed",
        robots=(robot,),
        vertices=tuple(VertexId(vertex) for vertex in dict.fromkeys(place)),
        tick=Tick(moment),
        message=f"{names.robot(robot)} books {where} at {names.moment(moment)}, which is closed"
        f" {until} (come after that, or leave before it begins)",
    )
