"""Small fleets of robots that need time to turn on the spot."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

from rightofway.model import Robot, Rules, Scenario, Stop, VertexId
from tests.builders.sizes import crowded_roadmap, tiny

__all__ = ["few_turning", "fleet_on_lanes", "turning"]

RATES = (None, Fraction(30), Fraction(45), Fraction(90), Fraction(200, 3))
"""Degrees per time unit."""


def turning(scenario: Scenario, draw: random.Random) -> Scenario:
    """Return the same fleet with turn rates drawn at random; at least one robot has one."""
    rates = [draw.choice(RATES) for _ in scenario.robots]
    rates[0] = rates[0] or Fraction(60)
    robots = tuple(
        replace(robot, turn_rate=rate) for robot, rate in zip(scenario.robots, rates, strict=True)
    )
    return replace(scenario, robots=robots)


def fleet_on_lanes(
    seed: int, *, robots: int, work: int = 1, rules: Rules | None = None
) -> Scenario:
    """Return points that go out and home on nine vertices and lanes in all directions."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    roadmap = crowded_roadmap(draw, one_way=0)
    homes, targets = (draw.sample(range(roadmap.n_vertices), robots) for _ in range(2))
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{k + 1}",
                home=VertexId(home),
                stops=(Stop(at=VertexId(target), work=Fraction(work)),),
            )
            for k, (home, target) in enumerate(zip(homes, targets, strict=True))
        ),
        rules=rules or Rules(),
    )


def few_turning(seed: int, *, sizes: bool) -> Scenario:
    """Return two robots that turn and book ahead, one way trips and no work, on six vertices."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    fleet = tiny(seed)
    robots = tuple(
        replace(
            robot,
            radius=robot.radius if sizes else Fraction(0),
            turn_rate=Fraction(draw.choice([60, 90, 180])),
        )
        for robot in fleet.robots
    )
    return replace(fleet, robots=robots, rules=replace(fleet.rules, occupancy="both"))
