"""Every planner on mixed scenarios: roadmaps, laps, headways, several stops, own speeds."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.metrics import measure
from rightofway.model import (
    Edge,
    Roadmap,
    Robot,
    Rules,
    Scenario,
    Stop,
    VertexId,
    roadmap_of_edges,
    roadmap_of_grid,
)
from tests.builders.small import STRICT


def mixed(seed: int) -> Scenario:
    """Return a random scenario; at most a third of the vertices hold a robot."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    roadmap = _grid(draw) if draw.random() < 0.5 else _drawn(draw)
    places = [VertexId(vertex) for vertex in range(roadmap.n_vertices)]
    n_robots = draw.randint(1, max(1, min(6, len(places) // 3)))
    targets = draw.sample(places, n_robots)
    robots = [
        Robot(
            name=f"R{index}",
            home=home,
            stops=(
                *(Stop(at=draw.choice(places)) for _ in range(draw.choice([0, 0, 1]))),
                Stop(at=targets[index], work=Fraction(draw.randint(0, 7), 2)),
            ),
            speed=draw.choice([Fraction(1), Fraction(2), Fraction(1, 3), Fraction(3, 7)]),
        )
        for index, home in enumerate(draw.sample(places, n_robots))
    ]
    return Scenario(roadmap=roadmap, robots=tuple(robots), rules=_rules(draw))


def _grid(draw: random.Random) -> Roadmap:
    cells = ["." if draw.random() < 0.85 else "@" for _ in range(35)]
    return roadmap_of_grid(["." * 7, *("".join(cells[row : row + 7]) for row in range(0, 35, 7))])


def _drawn(draw: random.Random) -> Roadmap:
    """Return a tree of ways both ways, and a few one-way shortcuts."""
    names = [f"v{index}" for index in range(draw.randint(6, 15))]
    ways: dict[tuple[str, str], Fraction] = {}
    for index, name in enumerate(names[1:], start=1):
        length = Fraction(draw.randint(1, 6), draw.choice([1, 2]))
        other = names[draw.randrange(index)]
        ways[name, other] = ways[other, name] = length
    for _ in range(len(names) // 2):
        tail, head = draw.sample(names, 2)
        ways.setdefault((tail, head), Fraction(draw.randint(1, 6)))
    edges = [Edge(tail=tail, head=head, length=length) for (tail, head), length in ways.items()]
    return roadmap_of_edges({name: (float(k), 0.0) for k, name in enumerate(names)}, edges)


def _rules(draw: random.Random) -> Rules:
    home = draw.random() < 0.7
    return Rules(
        occupancy="both" if draw.random() < 0.5 else "one",
        headway=draw.choice([Fraction(0), Fraction(0), Fraction(1), Fraction(1, 3)]),
        turn=draw.choice([None, Fraction(0), Fraction(5, 2)]),
        ends="home" if home else "none",
        laps=draw.choice([1, 2, 3]) if home else 1,
        rotations=draw.random() < 0.7,
    )


@pytest.mark.parametrize("planner", STRICT)
@pytest.mark.parametrize("seed", range(150))
def test_a_plan_is_valid_or_proven_impossible(planner: str, seed: int) -> None:
    scenario = mixed(seed)
    try:
        plan = rightofway.solve(scenario, planner, time_limit=60)
    except NoPlanExists:
        return
    assert rightofway.check(plan).ok
    assert measure(plan).flowtime >= measure(plan).lower_bound
