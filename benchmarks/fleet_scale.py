"""How good ``auto`` is on the MovingAI benchmark after ten seconds: flowtime by the lower bound.

``python -m benchmarks.fleet_scale FOLDER`` wants a folder of the benchmark, with ``maps`` and
``scens`` in it. One plan at a time; the planner itself uses all cores. With a number behind the
folder, other robots of the same files: ``1`` leaves out as many at the beginning as a fleet has,
``2`` twice as many. Rows for which a file has too few robots are left out.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from statistics import median

import rightofway
from rightofway.errors import GaveUp
from rightofway.metrics import measure
from rightofway.model import Robot, Scenario

LIMIT = 10
"""Time for each plan [s]."""

SEEDS = (1, 2, 3)
SPEEDS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 5))

RANDOM_32, RANDOM_64 = "random-32-32-20", "random-64-64-10"
EMPTY, WAREHOUSE = "empty-48-48", "warehouse-10-20-10-2-1"


def classic(scenario: Scenario, _seed: int) -> Scenario:
    """Leave equal robots as they are."""
    return scenario


def own_speeds(scenario: Scenario, _seed: int) -> Scenario:
    """Deal speeds round robin; robots book both vertices and stay at their targets."""
    rules = replace(scenario.rules, occupancy="both", ends="none")
    return replace(scenario, robots=_dealt(scenario), rules=rules)


def round_trips(scenario: Scenario, seed: int) -> Scenario:
    """Have robots work 0 to 20 and come home, with a turn of a cell at the target."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    robots = tuple(
        replace(robot, stops=(replace(robot.stops[0], work=Fraction(draw.randint(0, 20))),))
        for robot in _dealt(scenario)
    )
    rules = replace(scenario.rules, occupancy="both", ends="home", turn="cell")
    return replace(scenario, robots=robots, rules=rules)


def _dealt(scenario: Scenario) -> tuple[Robot, ...]:
    return tuple(
        replace(robot, speed=SPEEDS[index % len(SPEEDS)])
        for index, robot in enumerate(scenario.robots)
    )


@dataclass(frozen=True, slots=True)
class Row:
    """One kind of fleet on one map."""

    name: str
    kind: Callable[[Scenario, int], Scenario]
    map: str
    robots: int

    def fleets(self, folder: Path, block: int) -> list[Scenario]:
        """Return the fleet of each seed, all as large as they should be, or none."""
        fleets = []
        for seed in SEEDS:
            whole = rightofway.load(folder / "scens" / f"{self.map}-random-{seed}.scen")
            robots = whole.robots[block * self.robots : (block + 1) * self.robots]
            if len(robots) < self.robots:
                return []
            fleets.append(self.kind(replace(whole, robots=robots), seed))
        return fleets

    def ratios(self, folder: Path, block: int = 0) -> Iterator[float | None]:
        """Yield flowtime / lower bound for each seed, None where there was no plan."""
        for fleet in self.fleets(folder, block):
            try:
                metrics = measure(rightofway.solve(fleet, time_limit=LIMIT))
            except GaveUp:
                yield None
            else:
                yield metrics.flowtime / metrics.lower_bound


ROWS = [
    *(Row("classic", classic, RANDOM_32, robots) for robots in (50, 100, 200, 400)),
    *(Row("classic", classic, RANDOM_64, robots) for robots in (400, 800, 1000)),
    *(Row("classic", classic, WAREHOUSE, robots) for robots in (100, 400, 800, 1000)),
    *(Row("own speeds", own_speeds, RANDOM_32, robots) for robots in (100, 200, 400)),
    *(Row("own speeds", own_speeds, EMPTY, robots) for robots in (500, 1000)),
    *(Row("own speeds", own_speeds, WAREHOUSE, robots) for robots in (200, 500, 1000)),
    Row("round trips", round_trips, RANDOM_32, 50),
    Row("round trips", round_trips, EMPTY, 200),
    *(Row("round trips", round_trips, WAREHOUSE, robots) for robots in (200, 500)),
]


def main() -> None:
    """Print the table."""
    print("| fleet | map | robots | median | each |\n| --- | --- | --- | --- | --- |")  # noqa: T201
    folder, block = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    for row in ROWS:
        found = list(row.ratios(folder, block))
        if not found:
            continue
        solved = [ratio for ratio in found if ratio is not None]
        middle = f"{median(solved):.3f}" if len(solved) == len(found) else "none"
        each = ", ".join("none" if ratio is None else f"{ratio:.3f}" for ratio in found)
        print(f"| {row.name} | {row.map} | {row.robots} | {middle} | {each} |", flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
