"""Findings on a site before anything is planned: facts, places and remedies.

Everything is exact but the load of shortest routes, which is counted from some of the places where
the site is large; `Inspection.sampled` says so.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np

from rightofway.facts import Fact
from rightofway.metrics.connectivity import (
    Corridor,
    Ways,
    find_corridors,
    find_separations,
    find_strong_parts,
    list_ways,
    measure_distances_from,
    measure_route_load,
    reach_from,
)
from rightofway.metrics.nearness import find_nearness, round_distance
from rightofway.metrics.site import SEVERITIES, Finding, Inspection, Kind, Site, list_trip
from rightofway.metrics.well_formed import find_ill_formed_jobs
from rightofway.site import Roadmap
from rightofway.site.scale import find_odd_sizes
from rightofway.site.walls import find_narrowest, reaches_walls

MOST_PLACES = 200
"""The most places that are compared; of a longer list, this number spread over it."""

EFFORT = 2_000_000
"""Vertices and edges that the search for shortest routes may visit, all sources together."""

FEWEST_SOURCES = 4

SPREAD = 16
"""Vertices between which routes are counted where a site names no place."""

BITS = 10
"""Bits of a coordinate by which vertices are put in order."""

BUSY = Fraction(3, 10)
"""From this share of the shortest routes on, a vertex is a bottleneck."""

AVOIDED = Fraction(1, 10)
"""Below this share of the shortest routes, a corridor with a way round is no finding."""

OUTSIDE: dict[Kind, tuple[str, str]] = {
    "trap": ("no way out", "add a lane back"),
    "unreachable": ("no way in", "add a lane to it"),
    "cut off": ("no way in or out", "add lanes"),
}
"""Fact and remedy on vertices that cannot be reached or left."""

LISTED_CORRIDORS = 10
"""Corridors that are looked at in detail: those that most shortest routes use."""


def inspect(site: Site) -> Inspection:
    """Return the size and the findings of a site.

    Parameters
    ----------
    site
        The site.
    """
    ways = list_ways(site.roadmap, site.places)
    parts = find_strong_parts(ways)
    main = set(parts[0])
    places = [vertex for vertex in sorted(site.places) if vertex in main]
    step = max(1, -(-len(places) // MOST_PLACES))
    apart = find_separations(ways, places[::step])
    load, total, sampled = _load(site, ways, parts[0], places)
    findings = [
        *_find_odd_sizes(site),
        *_find_impossible_trips(site, ways, parts),
        *_find_narrow_trips(site, ways),
        *find_ill_formed_jobs(site),
        *_find_outside(site, ways, parts),
        *find_nearness(site, ways.joints),
        *_find_on_the_way(site, ways, main, apart, load=load, total=total),
        *_find_corridors(site, ways, main, load, total),
        *_find_bottlenecks(site, ways, load, total, named=len(places) > 1),
    ]
    pairs = {(tail, head) for tail, heads in enumerate(ways.along) for head in heads}
    return Inspection(
        vertices=len(ways.vertices),
        edges=sum(map(len, ways.along)),
        one_way=sum((head, tail) not in pairs for tail, head in pairs),
        places=len(site.places),
        parts=tuple(map(len, parts)),
        sampled=sampled,
        findings=tuple(sorted(findings, key=lambda finding: SEVERITIES.index(finding.severity))),
        well_formed=(
            None if site.scenario is None else all(finding.kind != "job" for finding in findings)
        ),
    )


def _load(
    site: Site, ways: Ways, part: Sequence[int], places: Sequence[int]
) -> tuple[dict[int, float], float, tuple[int, int] | None]:
    """Return the load of shortest routes, how many there are, and from how many sources of all."""
    trips: dict[int, dict[int, float]] = defaultdict(dict)
    if site.has_trips:
        inside = set(part)
        for (start, goal), count in site.trips.items():
            if {start, goal} <= inside:
                trips[start][goal] = count
    else:
        ends = (
            places
            if len(places) > 1
            else _sample_evenly(_sort_by_nearness(site.roadmap, part), SPREAD)
        )
        trips.update({start: {goal: 1 for goal in ends if goal != start} for start in ends})
    size = len(ways.along) + sum(map(len, ways.along))
    most = max(FEWEST_SOURCES, EFFORT // max(size, 1))
    chosen = _sample_evenly(sorted(trips), most)
    taken = {start: trips[start] for start in chosen}
    total = sum(sum(goals.values()) for goals in taken.values())
    sources = len(trips) if site.has_trips or len(places) > 1 else len(part)
    is_sampled = len(chosen) < sources
    return measure_route_load(ways, taken), total, (len(chosen), sources) if is_sampled else None


def _sample_evenly(vertices: Sequence[int], most: int) -> list[int]:
    """Return at most ``most`` of some vertices, spread over them."""
    count = min(most, len(vertices))
    return [vertices[k * len(vertices) // count] for k in range(count)]


def _sort_by_nearness(roadmap: Roadmap, vertices: Sequence[int]) -> list[int]:
    """Return vertices so that neighbours in the list are near on the map: in Morton's order."""
    at = roadmap.positions[list(vertices)]
    low, span = at.min(axis=0), np.ptp(at, axis=0).max() or 1
    right, down = (((at - low) / span) * (2**BITS - 1)).astype(int).T
    keys = sum(
        ((right >> bit & 1) << 2 * bit) | ((down >> bit & 1) << 2 * bit + 1) for bit in range(BITS)
    )
    return [vertices[at] for at in np.argsort(keys, kind="stable").tolist()]


def _find_impossible_trips(
    site: Site, ways: Ways, parts: Sequence[Sequence[int]]
) -> Iterator[Finding]:
    """Yield the drives that no way leads along."""
    part_of = {vertex: number for number, part in enumerate(parts) for vertex in part}
    for index, robot in enumerate(site.robots):
        for start, goal in pairwise(list_trip(robot, site.rules)):
            if part_of[start] == part_of[goal]:
                continue
            if goal not in reach_from([start], ways.along, lambda _: True):
                yield Finding(
                    kind="trip",
                    severity="error",
                    fact=Fact("no way", site, robot=index, start=start, goal=goal),
                    remedy=Fact("add a lane"),
                    vertices=site.list_names((start, goal)),
                    robots=(robot.name,),
                )


def _find_odd_sizes(site: Site) -> Iterator[Finding]:
    """Yield sizes that only another unit explains."""
    for fact, remedy in find_odd_sizes(site, site.radii[0]):
        yield Finding(kind="scale", severity="warning", fact=fact, remedy=remedy)


def _find_narrow_trips(site: Site, ways: Ways) -> Iterator[Finding]:
    """Yield for each radius the robots that walls keep from their places, and the room they leave.

    Ways of a grid lead in both directions.
    """
    grid = site.roadmap.grid
    if grid is None or site.rules.walls != "strict":
        return
    radii = {robot.radius for robot in site.robots if 2 * robot.radius > grid.cell_size}
    for radius in sorted(radii):
        barred_trips = _find_robots_kept_out(site, ways, radius)
        for robot, (start, goal) in [*barred_trips.items()][:1]:
            narrowest = find_narrowest(site.roadmap, start, goal)
            if narrowest is None:
                continue  # no robot has a way there
            room, place = narrowest
            yield Finding(
                kind="trip",
                severity="error",
                fact=Fact(
                    "way too narrow",
                    site,
                    robots=len(barred_trips),
                    radius=radius,
                    room=room,
                    robot=robot,
                    start=start,
                    goal=goal,
                    place=place,
                ),
                remedy=Fact("widen the way"),
                vertices=site.list_names((place, start, goal)),
                robots=tuple(site.robots[robot].name for robot in barred_trips),
            )


def _find_robots_kept_out(site: Site, ways: Ways, radius: Fraction) -> dict[int, tuple[int, int]]:
    """Return the robots of a radius that walls keep from a place, and the first such drive."""
    is_clear = (~reaches_walls(site.roadmap, radius)).tolist()
    part_of = dict[int, int]()
    for vertex, clear in enumerate(is_clear):
        if clear and vertex not in part_of:
            reached = reach_from([vertex], ways.along, is_clear.__getitem__)
            part_of.update(dict.fromkeys(reached, vertex))
    barred_trips = dict[int, tuple[int, int]]()
    for index, robot in enumerate(site.robots):
        for start, goal in pairwise(list_trip(robot, site.rules)):
            if robot.radius == radius and part_of.get(start) != part_of.get(goal):
                barred_trips.setdefault(index, (start, goal))
    return barred_trips


def _find_outside(site: Site, ways: Ways, parts: Sequence[Sequence[int]]) -> Iterator[Finding]:
    """Yield the connected pieces that cannot be reached or left from the largest part."""
    main = parts[0]
    ahead = set(reach_from(main, ways.along, lambda _: True))
    behind = set(reach_from(main, ways.against, lambda _: True))
    rest = {vertex for part in parts[1:] for vertex in part}
    kinds: tuple[tuple[Kind, set[int]], ...] = (
        ("trap", ahead & rest),
        ("unreachable", behind & rest),
        ("cut off", rest - ahead - behind),
    )
    for kind, findings_of_kind in kinds:
        pieces, seen = list[list[int]](), set[int]()
        beside = {
            vertex: ways.find_neighbours(vertex) & findings_of_kind
            for vertex in sorted(findings_of_kind)
        }
        for vertex in beside:
            if vertex not in seen:
                reached: list[int] = [vertex]
                seen.add(vertex)
                for neighbour in reached:  # grows as it goes
                    new = beside[neighbour] - seen
                    seen |= new
                    reached += sorted(new)
                pieces.append(sorted(reached))
        for piece in sorted(pieces, key=lambda vertices: (-len(vertices), vertices[0])):
            own = [vertex for vertex in piece if vertex in site.places]
            has_cells = site.roadmap.has_cells
            fact, remedy = OUTSIDE[kind]
            if has_cells:
                fact = "no way to cells" if kind == "cut off" else fact
                remedy = "make a wide way"
            yield Finding(
                kind=kind,
                severity="error" if own else "note" if kind == "cut off" else "warning",
                fact=Fact(fact, site, places=_describe_piece(site, piece, own)),
                remedy=Fact(remedy, number=len(piece)),
                vertices=site.list_names(piece),
            )


def _describe_piece(site: Site, piece: Sequence[int], own: Sequence[int]) -> Fact:
    """Return the places of a connected piece, or its vertices where it has no places."""
    if own and len(piece) > len(own):
        return Fact("places and others", places=tuple(own), vertices=len(piece) - len(own))
    if site.roadmap.has_cells and not own and len(piece) > 1:
        return Fact("cells around", cells=len(piece), place=piece[len(piece) // 2])
    return Fact("places", places=tuple(own or piece))


def _find_on_the_way(
    site: Site,
    ways: Ways,
    main: set[int],
    apart: Mapping[int, set[int]],
    *,
    load: Mapping[int, float],
    total: float,
) -> Iterator[Finding]:
    """Yield places that others have to pass, the worst first, and homes that many routes pass."""
    taken = set(site.places)

    def is_aside(spot: int) -> bool:
        """Whether no place is at a vertex, no two places need it, and no route passes it."""
        return spot in main and spot not in taken and spot not in apart and not load.get(spot)

    def find_remedy(vertex: int) -> Fact:
        if vertex not in site.homes:
            return Fact("move into a bay")
        spot = next(filter(is_aside, measure_distances_from(ways, vertex)[0]), None)
        if spot is None:
            return Fact("keep the way unused")
        taken.add(spot)
        distance = round_distance(site.roadmap, vertex, spot)
        return Fact("park aside", site, place=spot, distance=distance)

    separating = [(vertex, beyond) for vertex, beyond in apart.items() if vertex in site.places]
    inside = main.intersection(site.places)
    for vertex, beyond in sorted(separating, key=lambda pair: (-len(pair[1]), pair[0])):
        rest = inside - beyond - {vertex}
        few = sorted(beyond if len(beyond) <= len(rest) else rest)
        yield Finding(
            kind="through way",
            severity="warning" if vertex in site.homes else "note",
            fact=Fact(
                "on the only way",
                site,
                place=vertex,
                places=tuple(few),
                others=len(inside) - 1 - len(few),
            ),
            remedy=find_remedy(vertex),
            vertices=site.list_names((vertex, *few)),
        )
    busy = [vertex for vertex in inside if vertex in site.homes and _is_busy(load, total, vertex)]
    for vertex in sorted(busy, key=lambda busy_vertex: (-load[busy_vertex], busy_vertex)):
        if vertex not in apart:
            yield Finding(
                kind="through way",
                severity="warning",
                fact=Fact("on many routes", site, place=vertex, share=load[vertex] / total),
                remedy=find_remedy(vertex),
                vertices=site.list_names((vertex,)),
            )


def _is_busy(load: Mapping[int, float], total: float, vertex: int) -> bool:
    """Whether many shortest routes pass a vertex, two at least."""
    return load.get(vertex, 0) >= max(float(BUSY) * total, 2)


def _find_corridors(
    site: Site, ways: Ways, main: set[int], load: Mapping[int, float], total: float
) -> Iterator[Finding]:
    """Yield the corridors without a passing place that most shortest routes use."""

    def use(corridor: Corridor) -> float:
        return max(load.get(vertex, 0) for vertex in corridor.inside)

    long_ones = [
        corridor for corridor in find_corridors(ways) if len(corridor.inside) > 1 and use(corridor)
    ]
    long_ones = [corridor for corridor in long_ones if main.issuperset(corridor.ends)]
    busiest = sorted(long_ones, key=lambda corridor: (-use(corridor), -corridor.steps))
    for corridor in busiest[:LISTED_CORRIDORS]:
        ends, inside = corridor.ends, set(corridor.inside)
        first = set(reach_from(ends[:1], ways.along, _make_outside_test(inside)))
        using = _list_using(site, first, inside)
        is_only = ends[1] not in first
        if site.has_trips and is_only:
            if len(using) < 2:  # noqa: PLR2004 - a robot alone meets nobody
                continue
            users = Fact("robots in corridor", some=len(using), robots=len(site.robots))
        else:
            if not is_only and use(corridor) < AVOIDED * total:
                continue
            users = Fact("routes in corridor", share=use(corridor) / total)
        yield Finding(
            kind="corridor",
            severity="warning" if is_only else "note",
            fact=Fact(
                "corridor",
                site,
                one=corridor.inside[0],
                other=corridor.inside[-1],
                length=corridor.steps * ways.unit,
                users=users,
                round=Fact("no way round" if is_only else "way round"),
            ),
            remedy=Fact("add a passing place"),
            vertices=site.list_names((ends[0], *corridor.inside, ends[1])),
            robots=tuple(using) if is_only else (),
        )


def _make_outside_test(inside: set[int]) -> Callable[[int], bool]:
    return lambda vertex: vertex not in inside


def _list_using(site: Site, side: set[int], inside: set[int]) -> list[str]:
    """Return the robots that have places in a corridor, or on both sides of it."""
    findings = []
    for robot in site.robots:
        trip = set(list_trip(robot, site.rules))
        if trip & inside or len({place in side for place in trip}) > 1:
            findings.append(robot.name)
    return findings


def _find_bottlenecks(
    site: Site, ways: Ways, load: Mapping[int, float], total: float, *, named: bool
) -> Iterator[Finding]:
    """Yield the busiest vertex of each connected set of vertices that many shortest routes pass."""
    busy = {vertex for vertex in load if _is_busy(load, total, vertex)}
    beside = {vertex: ways.find_neighbours(vertex) & busy for vertex in busy}
    seen = set[int]()
    for vertex in sorted(busy, key=lambda busy_vertex: (-load[busy_vertex], busy_vertex)):
        if vertex in seen:
            continue
        around = {vertex}
        front = [vertex]
        for neighbour in front:  # grows as it goes
            new = beside[neighbour] - around
            around |= new
            front += sorted(new)
        seen |= around
        more = len(around) - 1
        kind = "on routes between places" if named else "on routes between vertices"
        fact = Fact(kind, site, place=vertex, share=load[vertex] / total)
        if more:
            fact = Fact("busy around", site, fact=fact, vertices=more, least=BUSY)
        yield Finding(
            kind="bottleneck",
            severity="note",
            fact=fact,
            remedy=Fact("add a second way"),
            vertices=site.list_names((vertex, *sorted(around - {vertex}))),
        )
