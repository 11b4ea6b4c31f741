"""Robots with a size, the slow way: all pairs of bookings and of motions, in fractions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache, lru_cache, partial
from itertools import combinations, pairwise, permutations, product
from typing import NamedTuple

from rightofway.model import Scenario, Track
from rightofway.site import Roadmap
from rightofway.site.passing import Passing

Point = tuple[Fraction, Fraction]
Shape = tuple[int, ...]
"""A vertex (v,), an edge (tail, head), or a zone (-1 - number,)."""

FAR_AWAY = Fraction(10**9)
"""The end of last visits [ticks]."""


class Booked(NamedTuple):
    shape: Shape
    start: Fraction
    end: Fraction


def point(roadmap: Roadmap, vertex: int) -> Point:
    """Return the exact position of a vertex."""
    if roadmap.grid is not None:
        row, column = roadmap.grid.get_cell(vertex)
        return column * roadmap.grid.cell_size, row * roadmap.grid.cell_size
    if vertex in roadmap.fractions:
        return roadmap.fractions[vertex]
    x, y = roadmap.positions[vertex]
    return Fraction(str(float(x))), Fraction(str(float(y)))


def needed(scenario: Scenario, i: int, j: int) -> Fraction:
    """Return the least distance of two robots, 0 where none has a size."""
    radii = scenario.robots[i].radius, scenario.robots[j].radius
    return sum(radii) + scenario.rules.clearance if any(radii) else Fraction(0)


def square_to_line(p: Point, a: Point, b: Point) -> Fraction:
    """Return the squared distance of a point to a straight line."""
    run, rise = b[0] - a[0], b[1] - a[1]
    whole = run**2 + rise**2
    share = ((p[0] - a[0]) * run + (p[1] - a[1]) * rise) / whole if whole else Fraction(0)
    share = min(max(share, Fraction(0)), Fraction(1))
    return (p[0] - a[0] - share * run) ** 2 + (p[1] - a[1] - share * rise) ** 2


def square_between(roadmap: Roadmap, one: Shape, other: Shape) -> Fraction:
    """Return the squared distance of two shapes."""

    def side(p: Point, q: Point, r: Point) -> Fraction:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    a, b = point(roadmap, one[0]), point(roadmap, one[-1])
    c, d = point(roadmap, other[0]), point(roadmap, other[-1])
    if side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0:
        return Fraction(0)
    return min(
        square_to_line(a, c, d),
        square_to_line(b, c, d),
        square_to_line(c, a, b),
        square_to_line(d, a, b),
    )


def list_parts(roadmap: Roadmap, shape: Shape) -> tuple[Shape, ...]:
    """Return the drawn shapes that are booked with one: at a vertex of a chain, the whole chain."""
    passing = roadmap.passing
    if passing is None or shape[0] < 0:
        return (shape,)
    drawn = tuple(passing.drawn[list(shape)].tolist())
    return _list_chains(passing).get(shape[0], (drawn,)) if len(shape) == 1 else (drawn,)


@lru_cache(maxsize=4)
def _list_chains(passing: Passing) -> dict[int, tuple[Shape, ...]]:
    """Return all shapes of the chain of each vertex that is on one, but for its ends."""
    drawn = [passing.drawn[list(chain)].tolist() for chain in passing.chains]
    shapes = [(*((vertex,) for vertex in chain), *pairwise(chain)) for chain in drawn]
    return {
        vertex: parts
        for chain, parts in zip(passing.chains, shapes, strict=True)
        for vertex in chain[1:-1]
    }


def incompatible(scenario: Scenario, i: int, one: Shape, j: int, other: Shape) -> bool:
    """Return whether robot i on one shape excludes robot j from another."""
    mine, yours = (list_parts(scenario.roadmap, shape) for shape in (one, other))
    return any(_exclude(scenario, (i, j), *shapes) for shapes in product(mine, yours))


def _exclude(scenario: Scenario, robots: tuple[int, int], one: Shape, other: Shape) -> bool:
    if one == other or (len(one) == len(other) == 1 and are_one_place(scenario, *one, *other)):
        return len(one) == 1  # two robots on one edge have booked its ends
    if one[0] < 0 or other[0] < 0:
        return False
    if one == other[::-1]:
        return True
    if set(one) & set(other):
        return False
    least = needed(scenario, *robots)
    return least > 0 and square_between(scenario.roadmap, one, other) < least**2


def are_one_place(scenario: Scenario, one: int, other: int) -> bool:
    """Return whether vertices at one point are those of several directions of driving."""
    roadmap = scenario.roadmap
    lanes = [lane.vertices for lane in roadmap.lanes]
    if min(one, other) < 0 or one == other or point(roadmap, one) != point(roadmap, other):
        return False
    if any(roadmap.name(vertex).endswith("/end") for vertex in (one, other)):
        return True
    return any(
        one in there[1:-1]
        and other in back[1:-1]
        and point(roadmap, there[0]) == point(roadmap, back[-1])
        and point(roadmap, there[-1]) == point(roadmap, back[0])
        for there in lanes
        for back in lanes
    )


def drive(scenario: Scenario, robot: int, tail: int, head: int) -> Fraction:
    """Return the ticks of a drive."""
    roadmap = scenario.roadmap
    kind = roadmap.get_edge_class(roadmap.list_edges(tail, head)[0])
    limit = dict(kind.max_speed_by_type).get(scenario.robots[robot].type or "", kind.max_speed)
    own, tick = scenario.robots[robot].speed, scenario.problem.clock.tick
    speed = own if limit is None else min(own, limit)
    return Fraction(-(-(kind.length / speed) // tick))


def zones_of(roadmap: Roadmap, shape: Shape) -> set[int]:
    """Return the numbers of the zones that a shape books.

    A zone has its vertices, its edges, and the vertices where two of its edges meet.
    """
    return {
        number
        for number, zone in enumerate(roadmap.zones)
        for part in list_parts(roadmap, shape)
        if part in zone.edges
        or (len(part) == 1 and (part[0] in zone.vertices or _meet_at(part[0], zone.edges)))
    }


def _meet_at(vertex: int, edges: Sequence[tuple[int, int]]) -> bool:
    return sum(vertex in edge for edge in edges) > 1


def bookings(scenario: Scenario, robot: int, track: Track) -> Iterator[Booked]:
    """Yield what a robot books: vertices with approach and headway, edges, zones."""
    roadmap = scenario.roadmap
    headway = Fraction(scenario.problem.booking_rules.headway)
    vertices, enter = track.vertices.tolist(), [Fraction(t) for t in track.enter.tolist()]
    ends = [*(tick + headway for tick in enter[1:]), FAR_AWAY]
    for k, vertex in enumerate(vertices):
        approach = drive(scenario, robot, vertices[k - 1], vertex) if k else Fraction(0)
        yield Booked((vertex,), enter[k] - approach, ends[k])
        for zone in zones_of(roadmap, (vertex,)):
            yield Booked((-1 - zone,), enter[k] - approach, ends[k])
        if k:
            yield Booked((vertices[k - 1], vertex), enter[k] - approach, enter[k] + headway)
            for zone in zones_of(roadmap, (vertices[k - 1], vertex)):
                yield Booked((-1 - zone,), enter[k] - approach, enter[k] + headway)


def overlaps(scenario: Scenario, tracks: list[Track]) -> set[tuple[int, int]]:
    """Return the pairs of robots with incompatible bookings that overlap."""
    booked = [list(bookings(scenario, robot, track)) for robot, track in enumerate(tracks)]
    return {
        (i, j)
        for i, j in combinations(range(len(tracks)), 2)
        for one, other in product(booked[i], booked[j])
        if one.start < other.end
        and other.start < one.end
        and incompatible(scenario, i, one.shape, j, other.shape)
    }


def whereabouts(scenario: Scenario, robot: int, track: Track, tick: Fraction) -> Point:
    """Return where a robot is at an instant."""
    vertices, enter = track.vertices.tolist(), [Fraction(t) for t in track.enter.tolist()]
    for k in range(len(vertices) - 1):
        if tick < enter[k + 1]:
            a, b = (point(scenario.roadmap, vertex) for vertex in vertices[k : k + 2])
            ticks = drive(scenario, robot, vertices[k], vertices[k + 1])
            share = max((tick - (enter[k + 1] - ticks)) / ticks, Fraction(0))
            return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
    return point(scenario.roadmap, vertices[-1])


def moments(scenario: Scenario, robot: int, track: Track) -> list[Fraction]:
    """Return the instants at which a robot starts or ends a drive."""
    vertices, enter = track.vertices.tolist(), [Fraction(t) for t in track.enter.tolist()]
    found = [Fraction(0)]
    for k in range(1, len(vertices)):
        found += [enter[k] - drive(scenario, robot, vertices[k - 1], vertices[k]), enter[k]]
    return found


def encounters(scenario: Scenario, tracks: list[Track]) -> dict[tuple[int, int], Fraction]:
    """Return the pairs of robots that come too near, each with the least squared distance."""
    found = {}
    for i, j in combinations(range(len(tracks)), 2):
        turns = sorted({t for k in (i, j) for t in moments(scenario, k, tracks[k])})
        least = None
        for begin, end in zip(turns, [*turns[1:], turns[-1] + 1], strict=True):
            gaps = []
            for tick in (begin, end):
                p, q = (whereabouts(scenario, k, tracks[k], tick) for k in (i, j))
                gaps.append((p[0] - q[0], p[1] - q[1]))
            square = square_to_line((Fraction(0), Fraction(0)), *gaps)
            least = square if least is None else min(least, square)
        assert least is not None
        if least < needed(scenario, i, j) ** 2:
            found[i, j] = least
    return found


class Held(NamedTuple):
    """A booking by index: from the start of visit ``start`` to the end of visit ``end``."""

    shape: Shape
    start: int
    end: int


def held(track: Track) -> list[Held]:
    """Return what a track books, visit by visit: its vertex, and the edge driven out of it."""
    vertices = track.vertices.tolist()
    edges = list(pairwise(vertices))
    return [
        *(Held((vertex,), k, k) for k, vertex in enumerate(vertices)),
        *(Held(edge, k + 1, k) for k, edge in enumerate(edges)),
    ]


def executed(
    scenario: Scenario,
    tracks: Sequence[Track],
    dwell: Sequence[Sequence[int]],
    drive: Sequence[Sequence[int]],
) -> tuple[list[list[int]], list[list[int]]]:
    """Return when visits start to be driven to and when they begin, in the order of a plan.

    A drive starts when the stay before is done and all bookings that exclude what it books, and
    come first in the plan, are over. Goes over all pairs until nothing changes.
    """
    headway = int(scenario.problem.booking_rules.headway)
    waits = list(_waits(scenario, tracks))
    enter = [[0] * len(track) for track in tracks]
    start = [[0] * len(track) for track in tracks]
    changed = True
    while changed:
        before = [list(each) for each in enter]
        for robot, track in enumerate(tracks):
            for k in range(1, len(track)):
                done = enter[robot][k - 1] + dwell[robot][k - 1]
                start[robot][k] = max(start[robot][k], done)
                enter[robot][k] = start[robot][k] + drive[robot][k]
        for first, ends, second, starts in waits:
            over = enter[first][ends + 1] + headway
            start[second][starts] = max(start[second][starts], over)
        changed = enter != before
    return start, enter


def _waits(scenario: Scenario, tracks: Sequence[Track]) -> Iterator[tuple[int, int, int, int]]:
    """Yield robot and visit that ends, then robot and visit whose drive in starts only after."""
    excludes = cache(partial(incompatible, scenario))
    for i, j in permutations(range(len(tracks)), 2):
        for one, other in product(held(tracks[i]), held(tracks[j])):
            if not excludes(i, one.shape, j, other.shape):
                continue
            is_last = one.end == len(tracks[i]) - 1
            if not is_last and tracks[i].enter[one.end + 1] < _end(tracks[j], other):
                yield i, one.end, j, other.start


def _end(track: Track, booking: Held) -> float:
    is_last = booking.end == len(track) - 1
    return float("inf") if is_last else float(track.enter[booking.end + 1])


def first_overlap(
    scenario: Scenario, tracks: Sequence[Track], start: Sequence[Sequence[int]]
) -> int | None:
    """Return when bookings overlap first, if they do; ``start``: of the drive into each visit."""
    headway = int(scenario.problem.booking_rules.headway)
    excludes = cache(partial(incompatible, scenario))
    begins = []
    for i, j in combinations(range(len(tracks)), 2):
        for one, other in product(held(tracks[i]), held(tracks[j])):
            begin = max(start[i][one.start], start[j][other.start])
            end = min(_end(tracks[i], one), _end(tracks[j], other)) + headway
            if begin < end and excludes(i, one.shape, j, other.shape):
                begins.append(begin)
    return min(begins, default=None)


def discs_meet(scenario: Scenario, tracks: Sequence[Track], start: Sequence[Sequence[int]]) -> bool:
    """Return whether robots that drive uniformly from start to enter come too near anywhere."""

    def at(robot: int, tick: Fraction) -> Point:
        track = tracks[robot]
        for k in range(1, len(track)):
            arrives = Fraction(int(track.enter[k]))
            if tick < arrives:
                begins = Fraction(start[robot][k])
                share = max((tick - begins) / (arrives - begins), Fraction(0))
                a, b = (point(scenario.roadmap, int(v)) for v in track.vertices[k - 1 : k + 1])
                return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
        return point(scenario.roadmap, int(track.vertices[-1]))

    for i, j in combinations(range(len(tracks)), 2):
        ticks = {int(tick) for k in (i, j) for tick in (*tracks[k].enter, *start[k])}
        turns = sorted(map(Fraction, ticks))
        for begin, end in pairwise(turns):
            gaps = []
            for tick in (begin, end):
                p, q = at(i, tick), at(j, tick)
                gaps.append((p[0] - q[0], p[1] - q[1]))
            square = square_to_line((Fraction(0), Fraction(0)), *gaps)
            if square < needed(scenario, i, j) ** 2:
                return True
    return False
