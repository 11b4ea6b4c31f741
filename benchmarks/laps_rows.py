"""What becomes of random fleets that repeat their work: one row for each group of robots."""

from __future__ import annotations

import csv
import random
from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, fields
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

from rightofway.cyclic import RULES, CyclicResult, GroupResult, run_laps
from rightofway.model import Robot, Scenario, Stop, VertexId, roadmap_of_grid
from tests.builders.fleets import largest_part, random_grid

ROWS = Path(__file__).parent / "laps.csv"

FLEETS = ((8, 3), (8, 6), (16, 12))
"""Sides of the grid, and how many robots."""

SPEEDS = {"equal": ("1",), "own": ("1", "1/2", "1/3")}
SEEDS = 40
SECONDS = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A group of at least two robots; times in ticks, ``""`` where nothing repeats."""

    size: int
    robots: int
    speeds: str
    seed: int
    rule: str
    group: int
    ends: str
    longest_lap: int
    transient: int | str
    period: int | str
    standing: int | str
    first: int
    steady: int | str
    same: int | str
    waiting: float | str


def fleet(size: int, robots: int, speeds: str, seed: int) -> Scenario:
    """Return a random fleet in which every robot has somewhere to go."""
    draw = random.Random(f"{size} {robots} {seed}")  # noqa: S311 (no secret depends on it)
    roadmap = roadmap_of_grid(random_grid(draw, size=size, walls=0.1))
    places = draw.sample(largest_part(roadmap), 2 * robots)
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{robot + 1}",
                home=VertexId(places[2 * robot]),
                stops=(
                    Stop(at=VertexId(places[2 * robot + 1]), work=Fraction(draw.randint(0, 5))),
                ),
                speed=Fraction(SPEEDS[speeds][draw.randrange(3) % len(SPEEDS[speeds])]),
            )
            for robot in range(robots)
        ),
    )


def measure(seeds: Sequence[int]) -> Iterator[Row]:
    """Run every fleet under every rule."""
    for (size, robots), speeds, seed in product(FLEETS, SPEEDS, seeds):
        scenario = fleet(size, robots, speeds, seed)
        for rule in RULES:
            run = run_laps(scenario, rule, time_limit=SECONDS)
            for group in run.groups:
                if len(group.robots) > 1:
                    yield _row(run, group, size=size, robots=robots, speeds=speeds, seed=seed)


def _row(
    run: CyclicResult, group: GroupResult, *, size: int, robots: int, speeds: str, seed: int
) -> Row:
    first, steady = (
        {(one.vertex, one.pair) for one in found} for found in (group.first_waits(), group.waits())
    )
    shares = [share for share in group.waiting_shares() if share is not None]
    pattern = group.pattern
    return Row(
        size=size,
        robots=robots,
        speeds=speeds,
        seed=seed,
        rule=run.rule,
        group=len(group.robots),
        ends=group.ends,
        longest_lap=group.context.longest,
        transient=pattern.transient if pattern else "",
        period=pattern.period if pattern else "",
        standing=pattern.counts.count(0) if pattern else "",
        first=len(first),
        steady=len(steady) if pattern else "",
        same=len(first & steady) if pattern else "",
        waiting=round(float(sum(shares) / len(shares)), 6) if pattern and shares else "",
    )


def save(rows: Sequence[Row], path: Path = ROWS) -> None:
    """Write rows to a table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(field.name for field in fields(Row))
        writer.writerows(astuple(row) for row in rows)


def load(path: Path = ROWS) -> list[Row]:
    """Read rows from a table."""
    kinds = {field.name: field.type for field in fields(Row)}
    with path.open(newline="", encoding="utf-8") as file:
        return [
            Row(**{key: _read(str(kinds[key]), text) for key, text in line.items()})
            for line in csv.DictReader(file)
        ]


def _read(kind: str, text: str) -> Any:
    if kind == "str" or not text:
        return text
    return float(text) if kind.startswith("float") else int(text)
