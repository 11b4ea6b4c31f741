"""How soon there is a first plan on the MovingAI benchmark, and how good it is.

``python -m benchmarks.first_plans FOLDER`` wants a folder of the benchmark, with ``maps`` and
``scens`` in it. *Kernel* is the native search alone, `solve` adds what Python does before it and
the judge after it; `auto` is when the default planner has its first plan.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

import rightofway
from rightofway.metrics import measure
from rightofway.model import Scenario
from rightofway.planners import planning_headway
from rightofway.search import plan_by_lacam

SEEDS = (1, 2, 3)
EFFORT = 10**12
RANDOM_32, RANDOM_64 = "random-32-32-20", "random-64-64-10"
SMALL, LARGE = "warehouse-10-20-10-2-1", "warehouse-20-40-10-2-2"

ROWS = [
    *((RANDOM_32, robots) for robots in (50, 100, 200, 400)),
    *((RANDOM_64, robots) for robots in (400, 800, 1000)),
    *((SMALL, robots) for robots in (100, 400, 800, 1000)),
    (LARGE, 1000),
]


@dataclass(frozen=True, slots=True)
class FirstPlan:
    """Times [s], and flowtime / lower bound."""

    kernel: float
    solve: float
    auto: float
    ratio: float


def fleet(folder: Path, name: str, robots: int, seed: int) -> Scenario:
    """Return the first robots of a random scenario, ready to plan."""
    whole = rightofway.load(folder / "scens" / f"{name}-random-{seed}.scen")
    scenario = replace(whole, robots=whole.robots[:robots])
    assert scenario.problem  # made once, and no part of planning
    return scenario


def seconds(call: Callable[[], object]) -> float:
    """Return how long a call takes."""
    began = time.perf_counter()
    call()
    return time.perf_counter() - began


def kernel(scenario: Scenario) -> None:
    """Run the search of `lacam`."""
    plan_by_lacam(scenario, headway=planning_headway(scenario), most_effort=EFFORT)


def first_plan(scenario: Scenario) -> FirstPlan:
    """Measure one fleet."""
    plan = rightofway.solve(scenario, "lacam")
    auto = rightofway.solve(scenario, options={"iterations": 1}).run.first_plan_seconds
    assert auto is not None
    metrics = measure(plan)
    return FirstPlan(
        kernel=seconds(lambda: kernel(scenario)),
        solve=seconds(lambda: rightofway.solve(scenario, "lacam")),
        auto=auto,
        ratio=metrics.flowtime / metrics.lower_bound,
    )


def rows(folder: Path) -> Iterator[str]:
    """Yield the table, medians of the seeds."""
    yield "| map | robots | kernel [s] | `solve` [s] | `auto` [s] | ratio |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for name, robots in ROWS:
        found = [first_plan(fleet(folder, name, robots, seed)) for seed in SEEDS]
        times = (
            f"{median(getattr(one, which) for one in found):.4f}"
            for which in ("kernel", "solve", "auto")
        )
        ratio = median(one.ratio for one in found)
        yield f"| {name} | {robots} | {' | '.join(times)} | {ratio:.3f} |"


def main() -> None:
    """Print the table."""
    for line in rows(Path(sys.argv[1])):
        print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
