"""What it costs that a tick is a hundredth: speeds 1 and 1.01 instead of 1 and 1.

``python -m benchmarks.near_speeds FOLDER`` wants a folder of the MovingAI benchmark, with ``maps``
and ``scens`` in it. The robots are the same, and so is the density; every second one is faster.
Both are planned in turn, the kernel several times, and the best time counts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from statistics import median

import rightofway
from benchmarks.first_plans import RANDOM_64, SEEDS, SMALL, fleet, kernel
from rightofway.model import Scenario

LIMIT = 60
ROWS = [(RANDOM_64, 400), (SMALL, 400), (SMALL, 800)]
EQUAL, NEAR = (Fraction(1), Fraction(1)), (Fraction(1), Fraction("1.01"))


def with_speeds(scenario: Scenario, speeds: tuple[Fraction, Fraction]) -> Scenario:
    """Deal two speeds round robin."""
    robots = tuple(
        replace(robot, speed=speeds[index % 2]) for index, robot in enumerate(scenario.robots)
    )
    return replace(scenario, robots=robots)


def cpu_seconds(call: Callable[[], object]) -> float:
    """Return the CPU time of a call, all threads together; other processes disturb it less."""
    began = time.process_time()
    call()
    return time.process_time() - began


def in_turn(scenario: Scenario) -> None:
    """Plan one robot after another."""
    rightofway.solve(scenario, "prioritized", LIMIT)


def improve(scenario: Scenario) -> None:
    """Plan, and replace tracks by better ones a thousand times."""
    rightofway.solve(scenario, "lns", LIMIT, options={"iterations": 1000})


PLANNERS: dict[str, tuple[Callable[[Scenario], None], int]] = {
    "`lacam`, its kernel": (kernel, 10),
    "`prioritized`": (in_turn, 1),
    "`lns`, 1000 tries": (improve, 1),
}
"""What is run, and how often."""


def best_seconds(
    plan: Callable[[Scenario], None], scenario: Scenario, runs: int
) -> tuple[float, float]:
    """Return the least CPU time with equal speeds, and with near ones."""
    dealt = [with_speeds(scenario, speeds) for speeds in (EQUAL, NEAR)]
    assert all(one.problem for one in dealt)  # made once, and no part of planning
    rounds = [[cpu_seconds(partial(plan, one)) for one in dealt] for _ in range(runs)]
    equal, near = map(min, zip(*rounds, strict=True))
    return equal, near


def rows(folder: Path) -> Iterator[str]:
    """Yield the table: CPU time, medians of the seeds, and the median of their factors."""
    yield "| map | robots | planner | 1 and 1 [s] | 1 and 1.01 [s] | factor |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for name, robots in ROWS:
        fleets = [fleet(folder, name, robots, seed) for seed in SEEDS]
        for planner, (plan, runs) in PLANNERS.items():
            times = [best_seconds(plan, one, runs) for one in fleets]
            equal, near = map(median, zip(*times, strict=True))
            factor = f"{median(slow / quick for quick, slow in times):.2f}"
            yield f"| {name} | {robots} | {planner} | {equal:.3f} | {near:.3f} | {factor} |"


def main() -> None:
    """Print the table."""
    for line in rows(Path(sys.argv[1])):
        print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
