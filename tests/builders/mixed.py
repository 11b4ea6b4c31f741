"""Small fleets on lanes with whatever a scenario can say of space, and plans that are broken."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from math import dist
from typing import Any

from rightofway.io import scenario_of
from rightofway.model import Plan, Scenario, Track

__all__ = ["mixed", "nudged"]

FEATURES = ("sizes", "zones", "closures", "turns", "spacing", "headway", "limits", "laps")


def mixed(seed: int) -> Scenario:
    """Return a random fleet; homes may be too near to each other, and there may be no plan."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    has = set(draw.sample(FEATURES, draw.randint(1, 5)))
    at = _places(draw, draw.randint(6, 14))
    lanes = _lanes(draw, at)
    roadmap: dict[str, Any] = {"vertices": at, "edges": [_edge(draw, has, lane) for lane in lanes]}
    if "zones" in has:
        roadmap["zones"] = [
            {
                "name": f"Z{k}",
                "vertices": draw.sample(sorted(at), draw.randint(0, 2)),
                "edges": draw.sample(lanes, 2),
            }
            for k in range(draw.randint(1, 2))
        ]
    rules: dict[str, Any] = {"headway": draw.choice([1, "1/2"])} if "headway" in has else {}
    rules |= {"clearance": "0.1"} if {"sizes", "limits"} <= has else {}
    rules |= {"laps": 2} if "laps" in has else {}
    rules |= {"rotations": draw.choice([True, False])}
    homes = draw.sample(sorted(at), draw.randint(2, 4))
    return scenario_of(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": roadmap, **({"spacing": 2} if "spacing" in has else {})},
            "robots": [_robot(draw, has, k, home, at) for k, home in enumerate(homes)],
            "rules": rules,
            "closures": _closures(draw, at, lanes) if "closures" in has else [],
        }
    )


def _places(draw: random.Random, count: int) -> dict[str, list[float]]:
    found: list[list[float]] = []
    while len(found) < count:
        place = [draw.randint(0, 24) / 2, draw.randint(0, 20) / 2]
        if all(dist(place, other) > 0.8 for other in found):
            found.append(place)
    return {f"v{k}": place for k, place in enumerate(found)}


def _lanes(draw: random.Random, at: dict[str, list[float]]) -> list[list[str]]:
    """Return lanes that join all vertices, and some that cross them or run beside them."""
    names = sorted(at)

    def near(one: str, others: Sequence[str]) -> list[str]:
        return sorted(
            [one, min(others, key=lambda two: dist(at[one], at[two]) + 4 * draw.random())]
        )

    found = [near(names[k], names[:k]) for k in range(1, len(names))]
    found += [near(one, [two for two in names if two != one]) for one in draw.sample(names, 5)]
    return sorted({tuple(lane): lane for lane in found}.values())


def _edge(draw: random.Random, has: set[str], lane: list[str]) -> dict[str, Any]:
    edge: dict[str, Any] = {"from": lane[0], "to": lane[1]}
    if "limits" in has:
        edge |= {"max_speed": draw.choice(["1/2", 1])} if draw.random() < 0.3 else {}
        edge |= {"barred": ["big"]} if draw.random() < 0.1 else {}
        edge |= {"surcharge": 3} if draw.random() < 0.1 else {}
    return edge


def _robot(
    draw: random.Random, has: set[str], number: int, home: str, at: dict[str, list[float]]
) -> dict[str, Any]:
    robot: dict[str, Any] = {"name": f"R{number}", "home": home}
    robot |= {"target": draw.choice(sorted(at)), "work": draw.randint(0, 3)}
    robot |= {"speed": draw.choice([1, "1/2", 2])}
    robot |= {"radius": draw.choice(["0.2", "0.3", "0.45"])} if "sizes" in has else {}
    robot |= {"turn_rate": draw.choice([30, 45, 90])} if "turns" in has else {}
    robot |= {"type": "big"} if draw.random() < 0.2 else {}
    return robot


def _closures(
    draw: random.Random, at: dict[str, list[float]], lanes: list[list[str]]
) -> list[dict[str, Any]]:
    found = []
    for _ in range(draw.randint(1, 3)):
        start = draw.randint(0, 20)
        closure: dict[str, Any] = {"from": start, "until": start + draw.randint(1, 20)}
        closure |= (
            {"at": draw.choice(sorted(at))} if draw.random() < 0.5 else {"edge": draw.choice(lanes)}
        )
        found.append(closure | ({"radius": "0.5"} if draw.random() < 0.3 else {}))
    return found


def nudged(plan: Plan, draw: random.Random) -> Plan:
    """Return a plan in which one robot is at some visits earlier or later, or elsewhere."""
    tracks = list(plan.tracks)
    robot = draw.randrange(len(tracks))
    vertices, enter = tracks[robot].vertices.tolist(), tracks[robot].enter.tolist()
    if len(vertices) < 3:
        return plan
    visit, what = draw.randrange(1, len(vertices)), draw.random()
    quickest = int(plan.scenario.problem.itineraries[robot].quickest_edge)
    if what < 0.7:
        by = draw.choice([-2, -1, 1, 2, 3, 5]) * draw.choice([1, quickest])
        enter[visit:] = [tick + by for tick in enter[visit:]]
    elif what < 0.9:
        enter[visit] += draw.choice([-1, 1])
    else:
        vertices[visit - 1 : visit + 1] = vertices[visit - 1 : visit + 1][::-1]
    tracks[robot] = Track.of(vertices, enter)
    return replace(plan, tracks=tuple(tracks))
