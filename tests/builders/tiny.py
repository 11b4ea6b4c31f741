"""Fleets so small that all joint states can be searched, each with one of what fleets may have."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from math import ceil

import numpy as np

from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import VertexId, make_grid_roadmap
from rightofway.site.chains import unfold
from tests.builders.closures import with_closures
from tests.builders.sizes import crowded_roadmap, has_room, tiny, zoned
from tests.oracles import joint_space, turning

__all__ = ["KINDS", "least_cost"]


def closed(seed: int) -> Scenario:
    """Return two points or robots with sizes, one way trips and no work, and closures."""
    fleets = (_closed(seed + 1000 * k) for k in range(1000))
    return next(fleet for fleet in fleets if has_room(fleet))


def _closed(seed: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    drawn = crowded_roadmap(draw, vertices=5, edges=6)
    roadmap = replace(
        drawn,
        edge_classes=tuple(
            replace(each, length=Fraction(ceil(each.length))) for each in drawn.edge_classes
        ),
    )
    homes, targets = (draw.sample(range(roadmap.n_vertices), 2) for _ in range(2))
    radius, occupancy = draw.choice([(0, "one"), (0, "both"), (3, None), (6, None)])
    robots = tuple(
        Robot(
            name=f"R{k + 1}",
            home=VertexId(home),
            stops=(Stop(at=VertexId(target)),),
            radius=Fraction(radius, 10),
        )
        for k, (home, target) in enumerate(zip(homes, targets, strict=True))
    )
    rules = Rules(ends="none", occupancy=occupancy)  # type: ignore[arg-type]
    return with_closures(Scenario(roadmap=roadmap, robots=robots, rules=rules), seed, most=3)


def turning_fleet(seed: int) -> Scenario:
    """Return two robots that turn and book ahead, points or with sizes, on six vertices."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = tiny(seed)
    robots = tuple(
        replace(
            robot,
            radius=robot.radius if seed % 2 else Fraction(0),
            turn_rate=Fraction(draw.choice([60, 90, 180])),
        )
        for robot in fleet.robots
    )
    return replace(fleet, robots=robots, rules=replace(fleet.rules, occupancy="both"))


def three(seed: int) -> Scenario:
    """Return three robots with sizes."""
    return tiny(seed, robots=3)


def trips(seed: int) -> Scenario:
    """Return two or three points of own speeds, with work, ways back and all booking rules."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    robots = draw.choice([2, 2, 3])
    rows, columns = (2, 3) if robots == 3 else draw.choice([(2, 3), (1, 4), (3, 3), (2, 4)])
    free = rows * columns - draw.choice([0, 0, 1])
    blocked = draw.sample(range(rows * columns), rows * columns - free)
    cells = ["@" if cell in blocked else "." for cell in range(rows * columns)]
    lines = ["".join(cells[row * columns : (row + 1) * columns]) for row in range(rows)]
    places = range(free)
    homes, ends = draw.sample(places, robots), draw.sample(places, robots)
    rules = Rules(
        occupancy=draw.choice(["one", "both"]),
        headway=Fraction(draw.choice([0, 0, 1])),
        turn=Fraction(draw.choice([0, 1])),
        ends="home" if draw.random() < 0.4 else "none",
        rotations=draw.random() < 0.6,
    )
    fleet = tuple(
        Robot(
            name=f"R{k + 1}",
            home=VertexId(home),
            stops=(
                *(
                    (Stop(at=VertexId(draw.choice(places)), work=Fraction(1)),)
                    * draw.choice([0, 1])
                ),
                Stop(at=VertexId(end), work=Fraction(draw.choice([0, 0, 1, 3]))),
            ),
            speed=draw.choice([Fraction(1), Fraction(1), Fraction(1, 2)]),
        )
        for k, (home, end) in enumerate(zip(homes, ends, strict=True))
    )
    return Scenario(roadmap=make_grid_roadmap(lines), robots=fleet, rules=rules)


def closed_trips(seed: int) -> Scenario:
    """Return a fleet of `trips` with closures, which may close homes and stops."""
    return with_closures(trips(seed), seed, most=2)


def charged(seed: int) -> Scenario:
    """Return a fleet of `trips` in which some edges have surcharges."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = trips(seed)
    plain = fleet.roadmap.edge_classes[0]
    classes = [replace(plain, surcharge=Fraction(surcharge)) for surcharge in (0, 1, 4)]
    edges = range(len(fleet.roadmap.heads))
    class_of_edge = np.array([draw.choice([0, 0, 0, 1, 2]) for _ in edges], np.int32)
    roadmap = replace(fleet.roadmap, edge_classes=tuple(classes), class_of_edge=class_of_edge)
    return replace(fleet, roadmap=roadmap)


def passed(seed: int) -> Scenario:
    """Return a fleet of another kind that only drives through some vertices of its roadmap."""
    fleets = (_passed(seed + 1000 * k) for k in range(1000))
    return next(fleet for fleet in fleets if fleet is not None and has_room(fleet))


def _passed(seed: int) -> Scenario | None:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = draw.choice([tiny, zoned, closed, trips, charged])(seed)
    drawn = replace(fleet.roadmap, grid=None)
    places = {at for robot in fleet.robots for at in (robot.home, *(s.at for s in robot.stops))}
    free = sorted(set(range(drawn.n_vertices)) - places)
    through = draw.sample(free, min(len(free), draw.choice([1, 1, 2, 3])))
    roadmap = unfold(drawn, list(map(VertexId, through)))
    if roadmap.passing is None or not roadmap.passing.chains:
        return None
    return replace(fleet, roadmap=roadmap, rules=replace(fleet.rules, occupancy="both"))


KINDS: dict[str, Callable[[int], Scenario]] = {
    "sizes": tiny,
    "three": three,
    "zones": zoned,
    "closures": closed,
    "closed trips": closed_trips,
    "turning": turning_fleet,
    "trips": trips,
    "surcharges": charged,
    "passed": passed,
}
"""Tiny fleets by seed; those that turn are one way trips without work, as their oracle knows."""


def least_cost(kind: str, scenario: Scenario) -> int | None:
    """Return the least cost [ticks] by a search over joint states, None where there is no plan."""
    if kind == "turning":
        return turning.least_flowtime(scenario)
    return joint_space.least_flowtime(scenario)
