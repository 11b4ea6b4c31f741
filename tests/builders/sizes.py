"""Small fleets of robots with sizes: on grids, and on roadmaps with lanes that cross."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.native import find_clashes
from rightofway.site import Edge, Roadmap, VertexId, make_grid_roadmap, make_roadmap
from rightofway.site.zones import Zone
from tests.builders.fleets import grid_fleet, largest_part, random_fleet, random_grid

__all__ = [
    "crossing",
    "crowded_roadmap",
    "dense",
    "has_room",
    "sized",
    "sized_on_lanes",
    "tiny",
    "with_radii",
    "zoned",
]


def with_radii(
    scenario: Scenario, radii: Sequence[Fraction], clearance: Fraction = Fraction(0)
) -> Scenario:
    """Return the same fleet with radii dealt out in turn."""
    robots = tuple(
        replace(robot, radius=radii[k % len(radii)]) for k, robot in enumerate(scenario.robots)
    )
    rules = replace(scenario.rules, occupancy=None, clearance=clearance)
    return replace(scenario, robots=robots, rules=rules)


def has_room(scenario: Scenario) -> bool:
    """Tell whether all robots can stand at their homes at one time, and where they end."""
    resources = scenario.problem.resources
    itineraries = scenario.problem.itineraries
    ends = [one.home for one in itineraries], [one.last for one in itineraries]
    return not any(any(find_clashes(resources, places)) for places in ends)


def sized(seed: int, *, robots: int = 4, headway: int = 0) -> Scenario:
    """Return a random fleet on a grid with radii from 0.3 to 1.4 cells, some of them mixed."""
    fleets = (_sized(seed + 1000 * k, robots, headway) for k in range(1000))
    return next(fleet for fleet in fleets if has_room(fleet))


def _sized(seed: int, robots: int, headway: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    radii = [Fraction(draw.randint(3, 14), 10) for _ in range(draw.choice([1, 1, 3]))]
    if draw.random() < 0.3:
        radii[-1:] = [Fraction(0), Fraction(1, 2)]
    rules = Rules(headway=Fraction(headway), ends=draw.choice(["home", "none"]))
    return with_radii(random_fleet(seed, robots=robots, walls=0.05, rules=rules), radii)


def dense(seed: int, *, size: int, robots: int, radii: Sequence[str]) -> Scenario:
    """Return a large fleet on an open grid with few walls; one way trips."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    grid = random_grid(draw, size=size, walls=0.05)
    roadmap = make_grid_roadmap(grid)
    exact = [Fraction(radius) for radius in radii]

    def places() -> list[str]:
        taken: list[tuple[tuple[int, int], Fraction]] = []
        names = []
        for vertex in draw.sample(largest_part(roadmap), len(largest_part(roadmap))):
            row, column = divmod(int(roadmap.name(vertex)[1:]), size)
            radius = exact[len(taken) % len(exact)]
            if len(taken) < robots and all(
                (row - there[0]) ** 2 + (column - there[1]) ** 2 >= (radius + other) ** 2
                for there, other in taken
            ):
                taken.append(((row, column), radius))
                names.append(roadmap.name(vertex))
        assert len(names) == robots, "the grid is too small"
        return names

    trips = list(zip(places(), places(), strict=True))
    return with_radii(grid_fleet(grid, trips, rules=Rules(ends="none")), exact)


def crowded_roadmap(
    draw: random.Random, *, vertices: int = 9, edges: int = 14, one_way: float = 0.2
) -> Roadmap:
    """Return vertices anywhere and lanes anyhow: many cross, or pass near other vertices."""
    places = draw.sample([(x, y) for x in range(7) for y in range(7)], vertices)
    names = [f"V{k}" for k in range(vertices)]
    tree = [(names[draw.randrange(k)], names[k]) for k in range(1, vertices)]
    more = [tuple(draw.sample(names, 2)) for _ in range(edges - len(tree))]
    lanes = {frozenset(pair): pair for pair in [*tree, *more]}
    at = dict(zip(names, places, strict=True))
    found = []
    for tail, head in lanes.values():
        square = sum((a - b) ** 2 for a, b in zip(at[tail], at[head], strict=True))
        length = next(Fraction(n, 4) for n in range(1, 99) if n**2 >= 16 * square)
        found += [Edge(tail=tail, head=head, length=length)]
        if draw.random() < 1 - one_way:
            found += [Edge(tail=head, head=tail, length=length)]
    return make_roadmap({name: (float(x), float(y)) for name, (x, y) in at.items()}, found)


def sized_on_lanes(seed: int, *, robots: int = 3) -> Scenario:
    """Return a random fleet with sizes on a roadmap of lanes that cross."""
    fleets = (_sized_on_lanes(seed + 1000 * k, robots) for k in range(1000))
    return next(fleet for fleet in fleets if has_room(fleet))


def _sized_on_lanes(seed: int, robots: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    roadmap = crowded_roadmap(draw)
    homes = draw.sample(range(roadmap.n_vertices), robots)
    targets = draw.sample(range(roadmap.n_vertices), robots)
    speeds = [Fraction(1), Fraction(1, 2), Fraction(2)]
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{k + 1}",
                home=VertexId(home),
                stops=(Stop(at=VertexId(target), work=Fraction(draw.randint(0, 2))),),
                speed=draw.choice(speeds),
                radius=Fraction(draw.randint(0 if k else 1, 8), 10),
            )
            for k, (home, target) in enumerate(zip(homes, targets, strict=True))
        ),
        rules=Rules(
            headway=Fraction(draw.choice([0, 0, 1])),
            ends="none",
            clearance=Fraction(draw.choice([0, 1]), 10),
        ),
    )


def tiny(seed: int, *, robots: int = 2) -> Scenario:
    """Return a few robots with sizes, one way trips and no work, on a few vertices.

    There are six vertices for two robots, and five to eight for more.
    """
    fleets = (_tiny(seed + 1000 * k, robots) for k in range(1000))
    return next(
        fleet for fleet in fleets if has_room(fleet) and fleet.problem.clock.tick >= Fraction(1, 8)
    )


def _tiny(seed: int, robots: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    vertices = 6 if robots == 2 else draw.randint(5, 8)
    roadmap = crowded_roadmap(draw, vertices=vertices, edges=vertices + 1)
    homes, targets = (draw.sample(range(roadmap.n_vertices), robots) for _ in range(2))
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{k + 1}",
                home=VertexId(home),
                stops=(Stop(at=VertexId(target)),),
                speed=Fraction(draw.choice([1, 2, 4])),
                radius=Fraction(draw.randint(2, 8), 10),
            )
            for k, (home, target) in enumerate(zip(homes, targets, strict=True))
        ),
        rules=Rules(ends="none"),
    )


def zoned(seed: int) -> Scenario:
    """Return two robots on six vertices, some of them points, with zones of a few edges.

    Most zones have vertices only where two of their edges meet.
    """
    fleets = (_zoned(seed + 1000 * k) for k in range(1000))
    return next(fleet for fleet in fleets if fleet.problem.clock.tick >= Fraction(1, 8))


def _zoned(seed: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = _tiny(seed, 2)
    roadmap = fleet.roadmap
    edges = [
        (VertexId(tail), VertexId(int(head)))
        for tail in range(roadmap.n_vertices)
        for head in roadmap.heads[roadmap.indptr[tail] : roadmap.indptr[tail + 1]]
    ]
    zones = tuple(
        Zone(
            name=f"Z{k}",
            vertices=tuple(map(VertexId, draw.sample(range(6), draw.choice([0, 1])))),
            edges=tuple(draw.sample(edges, draw.choice([2, 3, 4]))),
        )
        for k in range(draw.choice([1, 2]))
    )
    points = [draw.random() < 0.5 for _ in fleet.robots]
    robots = tuple(
        replace(robot, radius=Fraction(0) if is_point else robot.radius)
        for robot, is_point in zip(fleet.robots, points, strict=True)
    )
    return replace(fleet, roadmap=replace(roadmap, zones=zones), robots=robots)


def crossing(radius: str = "0.4", clearance: str = "0.1") -> Scenario:
    """Return two robots on lanes that cross at (2, 0): A to B and C to D, 4 long each."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (2.0, -2.0), "D": (2.0, 2.0)}
    edges = [
        Edge(tail=tail, head=head, length=Fraction(4)) for tail, head in ("AB", "BA", "CD", "DC")
    ]
    roadmap = make_roadmap(at, edges)
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=name,
                home=roadmap.get_vertex(home),
                stops=(Stop(at=roadmap.get_vertex(target), work=Fraction(1)),),
                ends="none",
                radius=Fraction(radius),
            )
            for name, home, target in [("R1", "A", "B"), ("R2", "C", "D")]
        ),
        rules=Rules(clearance=Fraction(clearance)),
    )


def repeated(seed: int) -> Scenario:
    """Return a random fleet with sizes that repeats its laps, on a grid or on lanes both ways."""
    fleets = ((_on_grid if seed % 2 else _both_ways)(seed + 1000 * k) for k in range(1000))
    return next(
        fleet
        for fleet in fleets
        if has_room(fleet) and all(one.stops[0].at != one.home for one in fleet.robots)
    )


def _on_grid(seed: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    rules = Rules(headway=Fraction(draw.choice([0, 0, 1])))
    scenario = random_fleet(seed, size=8, robots=draw.randint(2, 4), walls=0.05, rules=rules)
    return with_radii(
        scenario, [Fraction(draw.randint(2, 8), 10) for _ in range(draw.randint(1, 3))]
    )


def _both_ways(seed: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    one_way, robots = crowded_roadmap(draw, vertices=12, edges=22), draw.randint(2, 3)
    names = [one_way.name(vertex) for vertex in range(one_way.n_vertices)]
    lanes = {
        frozenset((tail, int(one_way.heads[edge]))): one_way.get_edge_class(edge).length
        for tail in range(one_way.n_vertices)
        for edge in range(int(one_way.indptr[tail]), int(one_way.indptr[tail + 1]))
    }
    edges = [
        Edge(tail=names[tail], head=names[head], length=length)
        for ends, length in lanes.items()
        for tail, head in (sorted(ends), sorted(ends)[::-1])
    ]
    at = {name: (float(x), float(y)) for name, (x, y) in zip(names, one_way.positions, strict=True)}
    places = draw.sample(range(one_way.n_vertices), 2 * robots)
    return Scenario(
        roadmap=make_roadmap(at, edges),
        robots=tuple(
            Robot(
                name=f"R{k + 1}",
                home=VertexId(places[k]),
                stops=(Stop(at=VertexId(places[robots + k]), work=Fraction(draw.randint(0, 3))),),
                speed=draw.choice([Fraction(1), Fraction(1, 2), Fraction(2)]),
                radius=Fraction(draw.randint(0 if k else 1, 5), 10),
            )
            for k in range(robots)
        ),
        rules=Rules(
            headway=Fraction(draw.choice([0, 0, 1])), clearance=Fraction(draw.choice([0, 1]), 10)
        ),
    )
