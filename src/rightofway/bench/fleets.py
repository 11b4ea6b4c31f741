"""The fleet of a case, drawn: same seed, same fleet, on every machine and every Python.

Only `random.Random.random` promises that, so everything here is drawn with it. The first robots of
a larger fleet are the smaller fleet of the same seed.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import cycle, islice, repeat
from typing import Any

from rightofway.io.formats import SCENARIO_FORMAT

__all__ = ["largest_part", "random_grid", "scenario_document"]

Cell = tuple[int, int]


def random_grid(*, width: int, height: int, walls: float, seed: int) -> list[str]:
    """Return the rows of a grid in which each cell is blocked with probability ``walls``."""
    draw = _generator("walls", seed)
    return [
        "".join("@" if draw.random() < walls else "." for _ in range(width)) for _ in range(height)
    ]


def largest_part(lines: Sequence[str]) -> list[Cell]:
    """Return the cells of the largest connected part of a grid, row by row; the first of equals."""
    unseen = {
        (row, column): None
        for row, line in enumerate(lines)
        for column, character in enumerate(line)
        if character == "."
    }
    parts: list[list[Cell]] = [[]]
    while unseen:
        parts.append(_part_around(next(iter(unseen)), unseen))
    largest: list[Cell] = max(parts, key=len)
    return sorted(largest)


def _part_around(start: Cell, unseen: dict[Cell, None]) -> list[Cell]:
    part = [start]
    del unseen[start]
    for row, column in part:  # grows as it goes
        for cell in ((row, column + 1), (row + 1, column), (row, column - 1), (row - 1, column)):
            if cell in unseen:
                del unseen[cell]
                part.append(cell)
    return part


def scenario_document(
    problem: Mapping[str, Any], fleet: Mapping[str, Any] | None, robots: int, seed: int
) -> dict[str, Any]:
    """Return the scenario of a case as a document.

    Parameters
    ----------
    problem
        The map, and the ends of robots if they are not drawn.
    fleet
        Speeds, work and rules; None if the problem is a whole scenario.
    robots
        How many.
    seed
        What draws homes and targets on random grids, speeds if they are drawn, and work.
    """
    if fleet is None:
        return dict(problem["scenario"])
    if "random" in problem:
        lines = random_grid(**problem["random"])
        ends = list(islice(_drawn_ends(largest_part(lines), seed), robots))
    else:
        lines, ends = list(problem["grid"]), problem["ends"]
    speeds, works = _speeds(fleet, seed), _works(fleet, seed)
    return {
        "format": SCENARIO_FORMAT,
        "map": {"grid": lines},
        "robots": [
            {
                "name": f"R{number}",
                "home": list(home),
                "target": list(target),
                "speed": next(speeds),
                "work": next(works),
            }
            for number, (home, target) in enumerate(ends, start=1)
        ],
        "rules": fleet["rules"],
    }


def _drawn_ends(places: Sequence[Cell], seed: int) -> Iterator[tuple[Cell, Cell]]:
    """Yield homes and targets, each place at most once as a home and once as a target."""
    homes, targets = (_shuffled(places, _generator(what, seed)) for what in ("homes", "targets"))
    return zip(homes, targets, strict=True)


def _speeds(fleet: Mapping[str, Any], seed: int) -> Iterator[Any]:
    speeds = fleet["speeds"]
    if not fleet["by_seed"]:
        return cycle(speeds)
    draw = _generator("speeds", seed)
    return (speeds[int(draw.random() * len(speeds))] for _ in repeat(None))


def _works(fleet: Mapping[str, Any], seed: int) -> Iterator[int]:
    least, most = fleet["work"]
    draw = _generator("work", seed)
    return (least + int(draw.random() * (most - least + 1)) for _ in repeat(None))


def _shuffled(items: Sequence[Cell], draw: random.Random) -> list[Cell]:
    return sorted(items, key=lambda _: draw.random())


def _generator(what: str, seed: int) -> random.Random:
    """Return a generator of its own for each thing drawn, so that none depends on another."""
    return random.Random(f"{what} {seed}")  # noqa: S311 (no secret depends on it)
