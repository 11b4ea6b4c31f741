"""Small fleets whose robots have several stops in a row at one place."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

from rightofway.model import Robot, Rules, Scenario, Stop
from tests.builders.fleets import random_fleet

__all__ = ["in_a_row"]


def in_a_row(seed: int) -> Scenario:
    """Return a random fleet; some first and last stops are at home."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    rules = Rules(
        laps=draw.choice([1, 2]),
        headway=Fraction(draw.choice([0, 0, 1])),
        turn=draw.choice([None, Fraction(2)]),
        turn_rate=draw.choice([None, None, Fraction(45)]),
        occupancy=draw.choice(["one", "both"]),
    )
    fleet = random_fleet(seed, size=5, robots=draw.randint(1, 4), rules=rules)
    return replace(fleet, robots=tuple(_robot(draw, robot) for robot in fleet.robots))


def _robot(draw: random.Random, robot: Robot) -> Robot:
    places = [robot.stops[0].at] * draw.randint(1, 3)
    places = [robot.home] * draw.randint(0, 2) + places + [robot.home] * draw.randint(0, 1)
    stops = tuple(Stop(at=place, work=Fraction(draw.randint(0, 3))) for place in places)
    return replace(robot, stops=stops)
