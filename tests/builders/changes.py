"""Random changes of a scenario, as of somebody who draws: a robot, a place, a rule."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from rightofway.model import Closure, Rules, Scenario, Stop
from rightofway.site import VertexId

__all__ = ["CHANGES"]

Change = Callable[[Scenario, random.Random], Scenario]


def _one_robot(scenario: Scenario, draw: random.Random, **change: Any) -> Scenario:
    robots, index = list(scenario.robots), draw.randrange(len(scenario.robots))
    robots[index] = replace(robots[index], **change)
    return replace(scenario, robots=tuple(robots))


def _free(scenario: Scenario, draw: random.Random) -> VertexId:
    taken = {robot.home for robot in scenario.robots}
    return draw.choice([place for place in _places(scenario) if place not in taken])


def _places(scenario: Scenario) -> list[VertexId]:
    """Return the vertices where robots may stop."""
    roadmap = scenario.roadmap
    return [VertexId(v) for v in range(roadmap.n_drawn) if not roadmap.is_passed(v)]


def _stop(scenario: Scenario, draw: random.Random) -> Stop:
    return Stop(at=draw.choice(_places(scenario)), work=Fraction(draw.randint(0, 6)))


def _added(scenario: Scenario, draw: random.Random) -> Scenario:
    new = replace(
        draw.choice(scenario.robots),
        name="new",
        home=_free(scenario, draw),
        stops=(_stop(scenario, draw),),
    )
    return replace(scenario, robots=(*scenario.robots, new))


def _removed(scenario: Scenario, draw: random.Random) -> Scenario:
    kept = list(scenario.robots)
    if len(kept) > 1:
        kept.pop(draw.randrange(len(kept)))
    return replace(scenario, robots=tuple(kept))


def _closed(scenario: Scenario, draw: random.Random) -> Scenario:
    start = Fraction(draw.choice([0, 0, 3, 8]))
    until = draw.choice([None, start + draw.randint(1, 20)])
    roadmap = scenario.roadmap.fold()
    edge = draw.randrange(roadmap.n_edges)
    tail = next(v for v in range(roadmap.n_vertices) if roadmap.indptr[v + 1] > edge)
    closure = Closure(
        edge=(VertexId(tail), VertexId(int(roadmap.heads[edge]))), from_=start, until=until
    )
    if draw.random() < 0.5:
        closure = Closure(at=_free(scenario, draw), from_=start, until=until)
    return replace(scenario, closures=(*scenario.closures, closure))


def _ruled(scenario: Scenario, draw: random.Random) -> Scenario:
    rules: list[Rules] = [
        replace(scenario.rules, headway=Fraction(1)),
        replace(scenario.rules, rotations=False),
        replace(scenario.rules, laps=1 if scenario.rules.laps > 1 else 2),
    ]
    return replace(scenario, rules=draw.choice(rules))


CHANGES: dict[str, Change] = {
    "nothing": lambda scenario, _: replace(scenario),
    "a home": lambda scenario, draw: _one_robot(scenario, draw, home=_free(scenario, draw)),
    "a stop": lambda scenario, draw: _one_robot(scenario, draw, stops=(_stop(scenario, draw),)),
    "a speed": lambda scenario, draw: _one_robot(
        scenario, draw, speed=Fraction(draw.choice(["1/3", "1/2", "3", "7/5"]))
    ),
    "a name": lambda scenario, draw: _one_robot(scenario, draw, name="renamed"),
    "a robot more": _added,
    "a robot less": _removed,
    "something closed": _closed,
    "a rule": _ruled,
}
"""What changes, and a function that changes it."""
