"""What it costs that a tick is a hundredth: speeds 1 and 1.01 instead of 1 and 1.

``python -m benchmarks.near_speeds FOLDER`` wants a folder of the MovingAI benchmark, with ``maps``
and ``scens`` in it. The robots are the same, and so is the density; every second one is faster.
Both are planned in turn, the kernel several times, and the best CPU time counts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from statistics import median

import rightofway
from benchmarks.common import SEEDS, movingai_fleet, table
from benchmarks.first_plans import RANDOM_64, SMALL, kernel
from rightofway.model import Scenario

LIMIT = 60
ROWS = [(RANDOM_64, 400), (SMALL, 400), (SMALL, 800)]
SPEEDS = [(Fraction(1), Fraction(1)), (Fraction(1), Fraction("1.01"))]

PLANNERS: dict[str, tuple[Callable[[Scenario], object], int]] = {
    "`lacam`, its kernel": (kernel, 10),
    "`prioritized`": (lambda one: rightofway.solve(one, "prioritized", LIMIT), 1),
    "`lns`, 1000 tries": (
        lambda one: rightofway.solve(one, "lns", LIMIT, options={"iterations": 1000}),
        1,
    ),
}
"""What is run, and how often."""


def with_speeds(scenario: Scenario, speeds: tuple[Fraction, Fraction]) -> Scenario:
    """Deal two speeds round robin."""
    robots = tuple(
        replace(robot, speed=speeds[index % 2]) for index, robot in enumerate(scenario.robots)
    )
    dealt = replace(scenario, robots=robots)
    assert dealt.problem  # bound once, and no part of planning
    return dealt


def best_seconds(
    plan: Callable[[Scenario], object], scenario: Scenario, runs: int
) -> tuple[float, float]:
    """Return the least CPU time with equal speeds, and with near ones [s]."""
    best = [float("inf")] * 2
    dealt = [with_speeds(scenario, speeds) for speeds in SPEEDS]
    for _ in range(runs):
        for index, one in enumerate(dealt):
            began = time.process_time()
            plan(one)
            best[index] = min(best[index], time.process_time() - began)
    return best[0], best[1]


def main() -> None:
    """Print the table: medians of the seeds, and the median of their factors."""
    folder, lines = Path(sys.argv[1]), []
    for name, robots in ROWS:
        fleets = [movingai_fleet(folder, name, robots, seed) for seed in SEEDS]
        for planner, (plan, runs) in PLANNERS.items():
            times = [best_seconds(plan, one, runs) for one in fleets]
            equal, near = map(median, zip(*times, strict=True))
            factor = median(slow / quick for quick, slow in times)
            figures = (f"{equal:.3f}", f"{near:.3f}", f"{factor:.2f}")
            lines.append((name, str(robots), planner, *figures))
    print(table(("map", "robots", "planner", "1 and 1 [s]", "1 and 1.01 [s]", "factor"), lines))  # noqa: T201


if __name__ == "__main__":
    main()
