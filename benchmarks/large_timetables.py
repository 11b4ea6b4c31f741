"""How much a chosen timetable wins over first come first served, where hundreds of robots work.

``python -m benchmarks.large_timetables FOLDER 10`` chooses timetables for large random fleets with
a time limit of ten seconds each, and prints their laps per tick by those of first come first
served, which is watched for as long; how many laps a robot makes in a period, and the least part of
its laps alone that any robot makes; and seconds by the clock and of the processor, with the run
made of the timetable. FOLDER is one of the MovingAI benchmark with ``maps`` in it; floors without a
map are drawn. Names of fleets at the end choose some of them.
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from rightofway.cyclic import best_timetable, run_laps
from rightofway.io.movingai import load_map
from rightofway.model import Robot, Scenario, Stop, VertexId, roadmap_of_grid
from tests.builders.fleets import largest_part

SEEDS = (1, 2, 3)


@dataclass(frozen=True, slots=True)
class Row:
    """Fleets of so many robots, each on a floor of its own."""

    robots: int
    floor: Callable[[Path, int], Sequence[str]]


def _map(name: str) -> Callable[[Path, int], Sequence[str]]:
    return lambda folder, _seed: load_map(folder / "maps" / f"{name}.map")


def _square(size: int, walls: float) -> Callable[[Path, int], Sequence[str]]:
    def floor(_folder: Path, seed: int) -> list[str]:
        draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
        row = range(size)
        return ["".join("@" if draw.random() < walls else "." for _ in row) for _ in row]

    return floor


ROWS = {
    "open-200": Row(1000, _square(200, 0)),
    "warehouse-20-40-10-2-2": Row(1000, _map("warehouse-20-40-10-2-2")),
    "random-64-64-10": Row(300, _map("random-64-64-10")),
    "walls-100": Row(300, _square(100, 0.05)),
}


def fleet(grid: Sequence[str], robots: int, seed: int) -> Scenario:
    """Return robots of equal speed with a home and a stop each, work 0 to 5."""
    roadmap, draw = roadmap_of_grid(grid), random.Random(seed)  # noqa: S311
    places = list(map(VertexId, draw.sample(sorted(largest_part(roadmap)), 2 * robots)))
    ends = zip(places[::2], places[1::2], strict=True)
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=f"R{number + 1}",
                home=home,
                stops=(Stop(at=stop, work=Fraction(draw.randint(0, 5))),),
            )
            for number, (home, stop) in enumerate(ends)
        ),
    )


def line(name: str, seed: int, folder: Path, limit: float) -> str:
    """Return a line of the table."""
    row = ROWS[name]
    scenario = fleet(row.floor(folder, seed), row.robots, seed)
    began, used = time.perf_counter(), time.process_time()
    run = best_timetable(scenario, time_limit=limit)
    seconds, used = time.perf_counter() - began, time.process_time() - used
    rival = run_laps(scenario, time_limit=limit)
    counts = max((group.pattern.counts for group in run.groups if group.pattern), key=len)
    fairness = min(group.comparison.fairness for group in run.groups if group.comparison)
    return (
        f"| {name} | {row.robots} | {seed} | {float(run.throughput() / rival.throughput()):.4f} | "
        f"{sum(counts) / len(counts):.0f} | "
        f"{float(fairness):.2f} | {seconds:.1f} | {used:.1f} |"
    )


def main() -> None:
    """Print a line for each fleet."""
    folder, limit, *names = sys.argv[1:]
    for name in names or ROWS:
        for seed in SEEDS:
            print(line(name, seed, Path(folder), float(limit)), flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
