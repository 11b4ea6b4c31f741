"""Random fleets of cases: same seed, same fleet, on every machine and every Python.

Only `random.Random.random` promises that, so everything here is drawn with it. The first robots of
a larger fleet are the smaller fleet of the same seed.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

from rightofway.io.formats import SCENARIO_FORMAT

Cell = tuple[int, int]


def draw_grid(*, width: int, height: int, walls: float, seed: int) -> list[str]:
    """Return the rows of a grid in which each cell is blocked with probability ``walls``."""
    draw = _make_generator("walls", seed)
    return [
        "".join("@" if draw.random() < walls else "." for _ in range(width)) for _ in range(height)
    ]


def find_largest_part(lines: Sequence[str]) -> list[Cell]:
    """Return the cells of the largest connected part of a grid, row by row; the first of equals."""
    unseen = {
        (row, column): None
        for row, line in enumerate(lines)
        for column, character in enumerate(line)
        if character == "."
    }
    largest: list[Cell] = []
    while unseen:
        part = [next(iter(unseen))]
        del unseen[part[0]]
        for row, column in part:  # grows as it goes
            around = (row, column + 1), (row + 1, column), (row, column - 1), (row - 1, column)
            for cell in around:
                if cell in unseen:
                    del unseen[cell]
                    part.append(cell)
        largest = max(largest, part, key=len)
    return sorted(largest)


def make_scenario_document(
    problem: Mapping[str, Any], fleet: Mapping[str, Any] | None, robots: int, seed: int
) -> dict[str, Any]:
    """Return the scenario of a `Case` as a document.

    The seed draws homes and targets on random grids (each place at most once as a home and once as
    a target), speeds if they are drawn, and work.
    """
    if fleet is None:
        return dict(problem["scenario"])
    if "random" in problem:
        lines = draw_grid(**problem["random"])
        places = find_largest_part(lines)
        homes, targets = _shuffle(places, "homes", seed), _shuffle(places, "targets", seed)
        ends = list(zip(homes, targets, strict=True))[:robots]
    else:
        lines, ends = list(problem["grid"]), problem["ends"]
    speeds, (least, most) = fleet["speeds"], fleet["work"]
    draw_speed, draw_work = _make_generator("speeds", seed), _make_generator("work", seed)
    documents = []
    for index, (home, target) in enumerate(ends):
        drawn = int(draw_speed.random() * len(speeds))
        robot = {
            "name": f"R{index + 1}",
            "home": list(home),
            "target": list(target),
            "speed": speeds[drawn if fleet["by_seed"] else index % len(speeds)],
            "work": least + int(draw_work.random() * (most - least + 1)),
        }
        documents.append(robot)
    return {
        "format": SCENARIO_FORMAT,
        "map": {"grid": lines},
        "robots": documents,
        "rules": fleet["rules"],
    }


def _shuffle(places: Sequence[Cell], purpose: str, seed: int) -> list[Cell]:
    draw = _make_generator(purpose, seed)
    return sorted(places, key=lambda _: draw.random())


def _make_generator(purpose: str, seed: int) -> random.Random:
    """Return a generator of its own for each thing drawn, so that none depends on another."""
    return random.Random(f"{purpose} {seed}")  # noqa: S311 (no secret depends on it)
