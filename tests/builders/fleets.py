"""Small fleets to plan in tests: the paper's cases, and random ones."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.io import load
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import Roadmap, make_grid_roadmap

__all__ = [
    "PAPER",
    "fleet_on",
    "grid_fleet",
    "largest_part",
    "paper_scenario",
    "random_fleet",
    "random_grid",
]

EXAMPLES = Path(__file__).parents[2] / "examples"

PAPER: list[dict[str, Any]] = [
    case
    for case in json.loads((EXAMPLES / "paper" / "tables.json").read_text(encoding="utf-8"))[
        "tables"
    ]
    if "final" in case
]
"""The tables of the paper whose rows are recorded: 4 to 11."""


def paper_scenario(case: dict[str, Any]) -> Scenario:
    """Return a published case; one tick of the table is one unit of time."""
    return load(EXAMPLES / "paper" / f"{case['name']}.yaml")


def grid_fleet(
    grid: Sequence[str],
    trips: Sequence[tuple[str, str]],
    *,
    rules: Rules | None = None,
    speeds: Sequence[Fraction] = (Fraction(1),),
    work: Sequence[int] = (0,),
) -> Scenario:
    """Return robots R1, R2, … that go from the first place of a trip to the second."""
    roadmap = make_grid_roadmap(grid)
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{index + 1}",
                home=roadmap.get_vertex(home),
                stops=(
                    Stop(at=roadmap.get_vertex(target), work=Fraction(work[index % len(work)])),
                ),
                speed=speeds[index % len(speeds)],
            )
            for index, (home, target) in enumerate(trips)
        ),
        rules=rules or Rules(),
    )


def random_fleet(
    seed: int,
    *,
    size: int = 12,
    robots: int = 8,
    walls: float = 0.1,
    rules: Rules | None = None,
    apart: bool = False,
) -> Scenario:
    """Return a random fleet in the largest open part of a random grid; see `fleet_on`."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    grid = random_grid(draw, size=size, walls=walls)
    return fleet_on(grid, draw, robots=robots, rules=rules, apart=apart)


def fleet_on(
    grid: Sequence[str],
    draw: random.Random,
    *,
    robots: int,
    work: int = 5,
    rules: Rules | None = None,
    apart: bool = False,
) -> Scenario:
    """Return a random fleet in the largest open part of a grid; targets all differ.

    With ``apart``, no robot works at its own home, as laps ask for.
    """
    roadmap = make_grid_roadmap(grid)
    places = largest_part(roadmap)
    homes, targets = draw.sample(places, robots), draw.sample(places, robots)
    while apart and any(home == target for home, target in zip(homes, targets, strict=True)):
        targets = draw.sample(places, robots)
    speeds = [Fraction(1), Fraction(1, 2), Fraction(1, 3)]
    return grid_fleet(
        grid,
        [(roadmap.name(h), roadmap.name(t)) for h, t in zip(homes, targets, strict=True)],
        rules=rules,
        speeds=[draw.choice(speeds) for _ in range(robots)],
        work=[draw.randint(0, work) for _ in range(robots)],
    )


def random_grid(draw: random.Random, *, size: int, walls: float) -> list[str]:
    """Return a square grid in which each cell is blocked with the same probability."""
    return [
        "".join("@" if draw.random() < walls else "." for _ in range(size)) for _ in range(size)
    ]


def largest_part(roadmap: Roadmap) -> list[int]:
    """Return the most vertices that are joined to each other, on a roadmap without one-ways."""
    unseen, parts = set(range(roadmap.n_vertices)), []
    while unseen:
        part, edge = [], [min(unseen)]
        unseen.discard(edge[0])
        while edge:
            vertex = edge.pop()
            part.append(vertex)
            around = roadmap.heads[roadmap.indptr[vertex] : roadmap.indptr[vertex + 1]].tolist()
            edge += [head for head in around if head in unseen]
            unseen.difference_update(around)
        parts.append(sorted(part))
    return max(parts, key=len)
