"""Random fleets of cases: same seed, same fleet, on every machine and every Python.

Only `random.Random.random` promises that, so everything here is drawn with it. The first robots of
a larger fleet are the smaller fleet of the same seed.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from typing import Any

from rightofway.io.formats import SCENARIO_FORMAT

Cell = tuple[int, int]

OF_PLACES = ("home", "start")
"""Keys of a robot that its copies do not have."""


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

    A whole scenario is taken as it is, or with another fleet. On other maps the seed draws homes
    and targets on random grids (each place at most once as a home and once as a target), speeds if
    they are drawn, and work.
    """
    if "scenario" in problem:
        document = dict(problem["scenario"])
        return document if fleet is None else _change_fleet(document, fleet, robots, seed)
    if "random" in problem:
        lines = draw_grid(**problem["random"])
        places = find_largest_part(lines)
        homes, targets = _shuffle(places, "homes", seed), _shuffle(places, "targets", seed)
        ends = list(zip(homes, targets, strict=True))[:robots]
    else:
        lines, ends = list(problem["grid"]), problem["ends"]
    assert fleet is not None, "only whole scenarios have their own"
    least, most = fleet["work"]
    draw_work = _make_generator("work", seed)
    documents = []
    speeds = _deal_speeds(fleet, seed)
    for index, ((home, target), speed) in enumerate(zip(ends, speeds, strict=False)):
        robot = {
            "name": f"R{index + 1}",
            "home": list(home),
            "target": list(target),
            "speed": speed,
            "work": least + int(draw_work.random() * (most - least + 1)),
        }
        documents.append(robot)
    return {
        "format": SCENARIO_FORMAT,
        "map": {"grid": lines},
        "robots": documents,
        "rules": fleet["rules"],
    }


def _change_fleet(
    document: dict[str, Any], fleet: Mapping[str, Any], robots: int, seed: int
) -> dict[str, Any]:
    """Return a scenario with its first robots; behind them begin copies, which park somewhere."""
    own = document["robots"]
    listed = [dict(own[k]) for k in range(min(robots, len(own)))]
    for k in range(len(own), robots):
        robot = own[k % len(own)]
        copy = {key: value for key, value in robot.items() if key not in OF_PLACES}
        listed.append({**copy, "name": f"{robot['name']}-{k // len(own) + 1}"})
        document["homes"] = "parking"
    if fleet["speeds"]:
        for robot, speed in zip(listed, _deal_speeds(fleet, seed), strict=False):
            robot["speed"] = speed
    rules = document.get("rules", {}) | fleet["rules"]
    document |= {"robots": listed, "rules": rules}
    if fleet["chargers"] is not None:
        _keep_chargers(document, fleet["chargers"])
    return document


def _keep_chargers(document: dict[str, Any], count: int) -> None:
    """Leave a scenario its first charging places: those of its map, then the others.

    A robot that loses all of its own places may charge at each that is left.
    """
    roadmap = document["map"].get("roadmap", {})
    places = dict.fromkeys([*roadmap.get("charging", []), *document.get("charging", [])])
    chargers = list(places)[:count]
    document["charging"] = chargers
    if roadmap:
        own = [place for place in roadmap.get("charging", []) if place in chargers]
        document["map"] = {"roadmap": {**roadmap, "charging": own}}
    for robot in document["robots"]:
        own = [place for place in robot.pop("charging", []) if place in chargers]
        if own:
            robot["charging"] = own


def _deal_speeds(fleet: Mapping[str, Any], seed: int) -> Iterator[Any]:
    """Yield the speeds of robots without end: in turn, or drawn."""
    speeds, draw = fleet["speeds"], _make_generator("speeds", seed)
    for index in count():
        drawn = int(draw.random() * len(speeds))
        yield speeds[drawn if fleet["by_seed"] else index % len(speeds)]


def _shuffle(places: Sequence[Cell], purpose: str, seed: int) -> list[Cell]:
    draw = _make_generator(purpose, seed)
    return sorted(places, key=lambda _: draw.random())


def _make_generator(purpose: str, seed: int) -> random.Random:
    """Return a generator of its own for each thing drawn, so that none depends on another."""
    return random.Random(f"{purpose} {seed}")  # noqa: S311 (no secret depends on it)
