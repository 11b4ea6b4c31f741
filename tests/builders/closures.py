"""Small fleets with closures."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

from rightofway.model import Closure, Rules, Scenario
from rightofway.site import VertexId
from tests.builders.fleets import random_fleet
from tests.builders.sizes import sized, sized_on_lanes

__all__ = ["closed_fleet", "with_closures"]


def with_closures(scenario: Scenario, seed: int, *, most: int = 4) -> Scenario:
    """Return a fleet with closures anywhere, few of them for ever."""
    draw, roadmap = random.Random(seed), scenario.roadmap.fold()  # noqa: S311 (no secret depends on it)
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
