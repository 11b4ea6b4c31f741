"""Fleets so small that all joint states can be searched, each with one of what fleets may have."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from math import ceil

from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import VertexId
from tests.builders.closures import with_closures
from tests.builders.sizes import crowded_roadmap, has_room, tiny, zoned
from tests.oracles import joint_space, turning

__all__ = ["KINDS", "least_flowtime"]


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


KINDS: dict[str, Callable[[int], Scenario]] = {
    "sizes": tiny,
    "three": three,
    "zones": zoned,
    "closures": closed,
    "turning": turning_fleet,
}
"""Tiny fleets by seed: one way trips without work, which is what the oracles know."""


def least_flowtime(kind: str, scenario: Scenario) -> int | None:
    """Return the least sum of completions [ticks] by search over joint states, None for no plan."""
    if kind == "turning":
        return turning.least_flowtime(scenario)
    return joint_space.least_flowtime(scenario)
