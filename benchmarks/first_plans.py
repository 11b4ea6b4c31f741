"""How soon there is a first plan on the MovingAI benchmark, and how good it is.

``python -m benchmarks.first_plans FOLDER`` wants a folder of the benchmark, with ``maps`` and
``scens`` in it. *Kernel* is the native search alone, `solve` adds what Python does before it and
the judge after it; `auto` is when the default planner has its first plan.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from statistics import median

import rightofway
from benchmarks.common import SEEDS, movingai_fleet, table
from rightofway.metrics import measure
from rightofway.model import Scenario
from rightofway.search import plan_by_lacam

EFFORT = 10**12
RANDOM_32, RANDOM_64 = "random-32-32-20", "random-64-64-10"
SMALL, LARGE = "warehouse-10-20-10-2-1", "warehouse-20-40-10-2-2"
FLEETS = {
    RANDOM_32: (50, 100, 200, 400),
    RANDOM_64: (400, 800, 1000),
    SMALL: (100, 400, 800, 1000),
    LARGE: (1000,),
}


def kernel(scenario: Scenario) -> None:
    """Run the native search of `lacam`."""
    plan_by_lacam(scenario.problem, most_effort=EFFORT)


def figures(scenario: Scenario) -> tuple[float, float, float, float]:
    """Return the seconds of kernel, `solve` and `auto`, and flowtime / lower bound."""
    metrics = measure(rightofway.solve(scenario, "lacam"))
    auto = rightofway.solve(scenario, options={"iterations": 1}).run.first_plan_seconds
    assert auto is not None
    began = time.perf_counter()
    kernel(scenario)
    between = time.perf_counter()
    rightofway.solve(scenario, "lacam")
    ended = time.perf_counter()
    return between - began, ended - between, auto, metrics.flowtime / metrics.lower_bound


def main() -> None:
    """Print the table: medians of the seeds."""
    folder, lines = Path(sys.argv[1]), []
    for name, counts in FLEETS.items():
        for robots in counts:
            found = [figures(movingai_fleet(folder, name, robots, seed)) for seed in SEEDS]
            *seconds, ratio = map(median, zip(*found, strict=True))
            lines.append((name, str(robots), *(f"{each:.4f}" for each in seconds), f"{ratio:.3f}"))
    heads = ("map", "robots", "kernel [s]", "`solve` [s]", "`auto` [s]", "ratio")
    print(table(heads, lines))  # noqa: T201


if __name__ == "__main__":
    main()
