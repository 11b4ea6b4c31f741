"""The judge, written a second time from the design: every pair of bookings and of motions.

It reads what a scenario and a plan say (positions, edges, zones, radii, rules, tracks) and works
the rest out in fractions: durations, turns, work, bookings, closures, and the closest approach of
every two robots at any instant.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable, Collection, Iterator, Sequence
from fractions import Fraction
from itertools import combinations, pairwise, permutations, product
from math import ceil, degrees, floor, inf
from typing import NamedTuple

from rightofway.model import ExecutionTrace, Plan, Robot, Scenario
from rightofway.site import Roadmap

__all__ = ["Booking", "Site", "faults", "is_shut"]

Point = tuple[Fraction, Fraction]
Shape = tuple[int, ...]
"""A vertex (v,) or an edge (tail, head)."""


class Booking(NamedTuple):
    """A robot books a shape, and some zones with it, from start to end [ticks]."""

    shape: Shape
    zones: frozenset[int]
    start: float
    end: float


class Motion(NamedTuple):
    """A robot moves evenly between two places, or stands at one, from start to end [ticks]."""

    tail: Point
    head: Point
    start: float
    end: float


class Way(NamedTuple):
    """The visits of a robot: where, since when, and the drive to the next one [ticks]."""

    vertices: list[int]
    enter: list[int]
    drives: list[int]


Fault = tuple[str, tuple[int, ...]]
"""What is wrong (trip, booking, meeting, swap, rotation, closure), and with which robots."""


class Site:
    """What the judge knows of a scenario."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario, self.rules = scenario, scenario.rules
        self.roadmap = scenario.roadmap.fold()
        self.tick = scenario.problem.clock.tick
        self.at = [_place(self.roadmap, vertex) for vertex in range(self.roadmap.n_vertices)]
        self.has_sizes = any(robot.radius > 0 for robot in scenario.robots)
        self.is_both = self.has_sizes or self.rules.occupancy == "both"
        self.headway = ceil(self.rules.headway / self.tick)
        self.squares: dict[tuple[Shape, Shape], Fraction] = {}
        # Vertices of both directions of a lane at one point, and those of all directions.
        lanes, at = [lane.vertices for lane in self.roadmap.lanes], self.at
        self.both_ways = {
            frozenset((one, other))
            for there, back in permutations(lanes, 2)
            if (at[there[0]], at[there[-1]]) == (at[back[-1]], at[back[0]])
            for one, other in product(there[1:-1], back[1:-1])
            if at[one] == at[other]
        } | {
            frozenset((one, other))
            for one, other in permutations(range(self.roadmap.n_vertices), 2)
            if self.roadmap.name(one).endswith("/end") and at[one] == at[other]
        }
        self.edges = {
            (tail, int(self.roadmap.heads[edge])): self.roadmap.get_edge_class(edge)
            for tail in range(self.roadmap.n_vertices)
            for edge in range(int(self.roadmap.indptr[tail]), int(self.roadmap.indptr[tail + 1]))
        }

    def drive(self, robot: Robot, edge: Shape) -> int | None:
        """Return how long a robot drives along an edge [ticks], None if it may not."""
        kind = self.edges.get((edge[0], edge[-1]))
        if kind is None or len(edge) == 1:
            return None
        barred: list[Collection[str]] = [kind.barred]
        barred += [self.roadmap.barred_vertices.get(vertex, ()) for vertex in edge]  # type: ignore[call-overload]
        if any(robot.type in types for types in barred):
            return None
        limit = dict(kind.max_speed_by_type).get(robot.type or "", kind.max_speed)
        speed = robot.speed if limit is None else min(robot.speed, limit)
        return ceil(kind.length / speed / self.tick)

    def turn(self, robot: Robot, before: int, here: int, after: int) -> int:
        """Return how long a robot turns at a vertex from one edge to the next [ticks]."""
        rate = self.rules.turn_rate if robot.turn_rate is None else robot.turn_rate
        if rate is None:
            return 0
        a, b, c = (complex(*map(float, self.at[vertex])) for vertex in (before, here, after))
        angle = Fraction(round(abs(degrees(phase((c - b) / (b - a)))) * 10**6), 10**6)
        return ceil(angle / rate / self.tick)

    def square(self, one: Shape, other: Shape) -> Fraction:
        """Return the squared distance of two shapes."""
        key = (one, other)
        if key not in self.squares:
            self.squares[key] = _square(self._line(one), self._line(other))
        return self.squares[key]

    def _line(self, shape: Shape) -> tuple[Point, Point]:
        return self.at[shape[0]], self.at[shape[-1]]

    def needed(self, i: int, j: int) -> Fraction:
        """Return the least distance of two robots, 0 for two points."""
        radii = [self.scenario.robots[robot].radius for robot in (i, j)]
        return sum(radii) + self.rules.clearance if any(radii) else Fraction(0)

    def excludes(self, one: Booking, other: Booking, needed: Fraction) -> bool:
        """Tell whether two robots may not book these at once."""
        a, b = one.shape, other.shape
        if one.zones & other.zones or (a == b and len(a) == 1):
            return True
        if len(a) == len(b) == 1 and frozenset((*a, *b)) in self.both_ways:
            return True
        if not self.has_sizes:
            return False
        if len(a) == len(b) == 2 and a == b[::-1]:
            return True
        return not set(a) & set(b) and self.square(a, b) < needed**2


def _place(roadmap: Roadmap, vertex: int) -> Point:
    if roadmap.grid is not None:
        row, column = roadmap.grid.get_cell(vertex)
        return column * roadmap.grid.cell_size, row * roadmap.grid.cell_size
    if vertex in roadmap.fractions:
        return roadmap.fractions[vertex]
    x, y = roadmap.positions[vertex].tolist()
    return Fraction(repr(x)), Fraction(repr(y))


def _minus(p: Point, q: Point) -> Point:
    return p[0] - q[0], p[1] - q[1]


def _dot(p: Point, q: Point) -> Fraction:
    return p[0] * q[0] + p[1] * q[1]


def _cross(p: Point, q: Point) -> Fraction:
    return p[0] * q[1] - p[1] * q[0]


def _nearest(start: Point, change: Point) -> Fraction:
    """Return the least square of ``start + s * change`` for s from 0 to 1."""
    whole = _dot(change, change)
    share = min(max(-_dot(start, change) / whole, Fraction(0)), Fraction(1)) if whole else 0
    point = start[0] + share * change[0], start[1] + share * change[1]
    return _dot(point, point)


def _square(one: tuple[Point, Point], other: tuple[Point, Point]) -> Fraction:
    """Return the squared distance of two segments."""
    (a, b), (c, d) = one, other
    u, v, w = _minus(b, a), _minus(d, c), _minus(c, a)
    spread = _cross(u, v)
    if spread and 0 <= _cross(w, v) / spread <= 1 and 0 <= _cross(w, u) / spread <= 1:
        return Fraction(0)
    ends = [(_minus(a, p), u) for p in other] + [(_minus(c, p), v) for p in one]
    return min(_nearest(start, change) for start, change in ends)


def faults(plan: Plan, trace: ExecutionTrace | None = None) -> set[Fault]:
    """Return what is wrong with a plan, or with one execution of it.

    Parameters
    ----------
    plan
        Any plan. If a robot cannot make its trip as planned, pairs of robots are not judged.
    trace
        What became of it: then the times of the trace are judged, but not how long the robots
        need, nor closures, which depend on what was known of delays.
    """
    site, robots = Site(plan.scenario), plan.scenario.robots
    given = (plan if trace is None else trace).tracks
    drawn = plan.scenario.roadmap.get_drawn
    tracks = [[drawn(int(vertex)) for vertex in track.vertices] for track in given]
    times = [list(map(int, track.enter)) for track in given]
    found: set[Fault] = set()
    for k, robot in enumerate(robots):
        if trace is None and not _makes_its_trip(site, robot, tracks[k], times[k]):
            found.add(("trip", (k,)))
    if found:
        return found
    drives = [
        [site.drive(robot, edge) or 0 for edge in pairwise(vertices)]
        for robot, vertices in zip(robots, tracks, strict=True)
    ]
    if trace is not None:
        drives = [list(map(int, drive))[1:] for drive in trace.drive]
    ways = [Way(*each) for each in zip(tracks, times, drives, strict=True)]
    booked = [list(_bookings(site, way)) for way in ways]
    driven = [list(_motions(site, way)) for way in ways]
    if trace is None:
        found |= {
            ("closure", (k,)) for k, robot in enumerate(robots) if is_shut(site, robot, booked[k])
        }
    for i, j in combinations(range(len(robots)), 2):
        both = (booked[i], booked[j]), (driven[i], driven[j])
        found |= {(kind, (i, j)) for kind in _between(site, *both, site.needed(i, j))}
    if not site.rules.rotations:
        found |= set(_rotations(ways))
    return found


def _between(
    site: Site,
    booked: tuple[Sequence[Booking], Sequence[Booking]],
    driven: tuple[Sequence[Motion], Sequence[Motion]],
    needed: Fraction,
) -> Iterator[str]:
    """Yield what is wrong between two robots."""
    if any(
        one.start < other.end and other.start < one.end and site.excludes(one, other, needed)
        for one, other in product(*booked)
    ):
        yield "booking"
    if not site.is_both and not site.headway and _swaps(site, *booked):
        yield "swap"
    if needed and any(_is_too_near(one, other, needed) for one, other in product(*driven)):
        yield "meeting"


def _stages(robot: Robot, site: Site) -> Iterator[tuple[int, int, int]]:
    """Yield where a robot has to be, how long it works and how long it turns then [ticks]."""
    rules, tick, grid = site.rules, site.tick, site.roadmap.grid
    turn = rules.turn if robot.turn is None else robot.turn
    rate = rules.turn_rate if robot.turn_rate is None else robot.turn_rate
    if turn is None:
        turn = "cell" if grid is not None and rate is None else Fraction(0)
    if turn == "cell":
        assert grid is not None, "cells have a size"
        turn = grid.cell_size / robot.speed
    trip = []
    for _ in range(rules.laps if robot.laps is None else robot.laps):
        trip += [(stop.at, stop.work) for stop in robot.stops]
        if (robot.ends or rules.ends) == "home":
            trip.append((robot.home, Fraction(0)))
    for number, (at, work) in enumerate(trip):
        stays = number + 1 < len(trip) and trip[number + 1][0] == at
        yield at, ceil(work / tick), 0 if stays else ceil(turn / tick)


def _makes_its_trip(
    site: Site, robot: Robot, vertices: Sequence[int], enter: Sequence[int]
) -> bool:
    """Tell whether a robot drives as fast and as far as it can, and does all its work."""
    if vertices[0] != robot.home or enter[0] != 0:
        return False
    spare: list[float] = []
    for visit, edge in enumerate(pairwise(vertices)):
        drive = site.drive(robot, edge)
        if drive is None:
            return False
        turn = site.turn(robot, vertices[visit - 1], *edge) if visit else 0
        spare.append(enter[visit + 1] - enter[visit] - drive - turn)
    spare.append(inf)
    stages = list(_stages(robot, site))
    done = {0}  # how many stages may be served by now
    for vertex, rest in zip(vertices, spare, strict=True):
        for served in sorted(done):
            time = 0
            for number in range(served, len(stages)):
                at, work, turn = stages[number]
                time += work + turn
                if at != vertex or time > rest:
                    break
                done.add(number + 1)
    stops = any(
        site.roadmap.is_passed(vertex) and rest
        for vertex, rest in zip(vertices, spare, strict=True)
    )
    return min(spare) >= 0 and len(stages) in done and vertices[-1] == stages[-1][0] and not stops


def _bookings(site: Site, way: Way) -> Iterator[Booking]:
    """Yield what a robot books."""
    zones = site.roadmap.zones
    edges = list(pairwise(way.vertices))
    begins = [
        enter - drive for enter, drive in zip(way.enter[1:], way.drives, strict=True)
    ]  # of the drives
    ends = list(way.enter[1:])
    for visit in range(1, len(edges)):  # a drive goes on through a vertex without a stop
        if site.roadmap.is_passed(way.vertices[visit]):
            begins[visit] = begins[visit - 1]
    for visit in reversed(range(1, len(edges))):
        if site.roadmap.is_passed(way.vertices[visit]):
            ends[visit - 1] = ends[visit]
    for visit, vertex in enumerate(way.vertices):
        came, goes = edges[visit - 1 : visit] if visit else [], edges[visit : visit + 1]
        start = begins[visit - 1] if came and site.is_both else way.enter[visit]
        inside = {
            number
            for number, zone in enumerate(zones)
            if vertex in zone.vertices or sum(vertex in edge for edge in zone.edges) > 1
        }
        end = ends[visit] + site.headway if goes else inf
        yield Booking((vertex,), frozenset(inside), start, end)
        if goes:
            along = frozenset(n for n, zone in enumerate(zones) if goes[0] in zone.edges)
            yield Booking(goes[0], along, begins[visit], end)


def _motions(site: Site, way: Way) -> Iterator[Motion]:
    for visit, edge in enumerate(pairwise(way.vertices)):
        tail, head = (site.at[vertex] for vertex in edge)
        leave = way.enter[visit + 1]
        begin = leave - way.drives[visit]
        yield Motion(tail, tail, way.enter[visit], begin)
        yield Motion(tail, head, begin, leave)
    last = site.at[way.vertices[-1]]
    yield Motion(last, last, way.enter[-1], inf)


def _is_too_near(mine: Motion, yours: Motion, needed: Fraction) -> bool:
    """Tell whether two robots are nearer than they may be at some instant of both motions."""
    start, end = max(mine.start, yours.start), min(mine.end, yours.end)
    if start > end:
        return False
    begin = _minus(_on(mine, start), _on(yours, start))
    change = _minus(_minus(_on(mine, end), _on(yours, end)), begin)
    return _nearest(begin, change) < needed**2


def _on(motion: Motion, tick: float) -> Point:
    if motion.tail == motion.head or tick == motion.start:
        return motion.tail
    share = Fraction(int(tick - motion.start), int(motion.end - motion.start))
    run, rise = _minus(motion.head, motion.tail)
    return motion.tail[0] + share * run, motion.tail[1] + share * rise


def _swaps(site: Site, one: Sequence[Booking], other: Sequence[Booking]) -> bool:
    """Tell whether each robot takes at one instant what the other one leaves."""

    def hand_overs(giver: Sequence[Booking], taker: Sequence[Booking]) -> set[float]:
        return {
            given.end
            for given, taken in product(giver, taker)
            if given.end == taken.start
            and len(taken.shape) == 1
            and site.excludes(given, taken, Fraction(0))
        }

    return bool(hand_overs(one, other) & hand_overs(other, one))


def _rotations(ways: Sequence[Way]) -> Iterator[Fault]:
    """Yield robots, three or more, that move to each other's vertices at one tick."""
    moves: dict[int, dict[int, tuple[int, int]]] = {}
    for number, way in enumerate(ways):
        for (tail, head), tick in zip(pairwise(way.vertices), way.enter[1:], strict=True):
            moves.setdefault(tick, {})[tail] = (head, number)
    for heads in moves.values():
        for first in heads:
            circle, at = list[int](), first
            while at in heads and len(circle) <= len(ways) and (at != first or not circle):
                at, robot = heads[at]
                circle.append(robot)
            if at == first and len(circle) > 2:
                yield "rotation", tuple(sorted(circle))


def is_shut(site: Site, robot: Robot, booked: Sequence[Booking]) -> bool:
    """Tell whether a robot books something while it is closed."""
    for closure in site.scenario.closures:
        start = floor(closure.from_ / site.tick)
        end = inf if closure.until is None else ceil(closure.until / site.tick)
        shuts = _shut(site, robot, closure.at, closure.edge, closure.radius)
        if any(one.start < end and start < one.end and shuts(one.shape) for one in booked):
            return True
    return False


def _shut(
    site: Site,
    robot: Robot,
    at: int | None,
    edge: tuple[int, int] | None,
    radius: Fraction | None,
) -> Callable[[Shape], bool]:
    """Return what tells whether a closure closes a shape for a robot."""
    ends: Collection[int] = edge or ()
    own: Shape = edge or (at,)  # type: ignore[assignment]
    inner = set(_pieces(site.roadmap, *edge)) if edge else set()
    reach = None if radius is None else robot.radius + radius + site.rules.clearance

    def shuts(shape: Shape) -> bool:
        is_own = len(shape) == len(own) and any(
            all(_is_one_place(site, one, other) for one, other in zip(own, way, strict=True))
            for way in (shape, shape[::-1])
        )
        if is_own or inner & set(shape):
            return True
        return (
            reach is not None
            and not any(_is_one_place(site, end, at) for end, at in product(ends, shape))
            and (site.square(shape, own) < reach**2)
        )

    return shuts


def _is_one_place(site: Site, one: int, other: int) -> bool:
    """Whether two vertices are one, or those of different directions at one place."""
    return one == other or frozenset((one, other)) in site.both_ways


def _pieces(roadmap: Roadmap, one: int, other: int) -> Iterator[int]:
    """Yield the vertices between the pieces of a lane that was split."""
    for tail, head in ((one, other), (other, one)):
        name = f"{roadmap.name(tail)}-{roadmap.name(head)}/"
        for vertex in range(roadmap.n_vertices):
            if roadmap.name(vertex).startswith(name) and not roadmap.name(vertex).endswith("/end"):
                yield vertex
