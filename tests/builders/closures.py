"""Small fleets with closures."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from math import ceil

from rightofway.model import Closure, Robot, Rules, Scenario, Stop, VertexId
from tests.builders.fleets import random_fleet
from tests.builders.sizes import crowded_roadmap, has_room, sized, sized_on_lanes

__all__ = ["closed_fleet", "tiny_closed", "with_closures"]


def with_closures(scenario: Scenario, seed: int, *, most: int = 4) -> Scenario:
    """Return a fleet with closures anywhere, few of them for ever."""
    draw, roadmap = random.Random(seed), scenario.roadmap  # noqa: S311 (no secret depends on it)
    closures = []
    for _ in range(draw.randint(1, most)):
        tail = VertexId(draw.randrange(roadmap.n_vertices))
        first, end = roadmap.indptr[tail : tail + 2].tolist()
        is_edge = first < end and draw.random() < 0.5
        begin = Fraction(draw.randint(0, 30), 4)
        radius = draw.choice([None, None, 0, 1, 2, 4])
        closures.append(
            Closure(
                at=None if is_edge else tail,
                edge=(tail, VertexId(int(roadmap.heads[draw.randrange(first, end)])))
                if is_edge
                else None,
                from_=begin,
                until=None if draw.random() < 0.1 else begin + Fraction(draw.randint(1, 30), 3),
                radius=None if radius is None else Fraction(radius, 4),
            )
        )
    return replace(scenario, closures=tuple(closures))


def closed_fleet(seed: int) -> Scenario:
    """Return points or robots with sizes on a grid or on lanes, and closures."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    if seed % 3 == 0:
        rules = Rules(
            occupancy=draw.choice(["one", "both"]),
            headway=Fraction(draw.choice([0, 0, 1])),
            ends=draw.choice(["home", "none"]),
        )
        fleet = random_fleet(seed, robots=draw.randint(1, 6), walls=0.1, rules=rules)
    else:
        fleet = (sized, sized_on_lanes)[seed % 3 - 1](seed)
    return with_closures(fleet, seed)


def tiny_closed(seed: int) -> Scenario:
    """Return two points or robots with sizes, one way trips and no work, and closures."""
    fleets = (_tiny_closed(seed + 1000 * k) for k in range(1000))
    return next(fleet for fleet in fleets if has_room(fleet))


def _tiny_closed(seed: int) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    drawn = crowded_roadmap(draw, vertices=5, edges=6)
    roadmap = replace(drawn, lengths=tuple(Fraction(ceil(length)) for length in drawn.lengths))
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
