"""How long right of way takes, and how good its plans are: tables of README.md beside this file.

``just right-of-way`` measures anew and writes the tables between their marks. One process, one plan
at a time; measure on a quiet machine.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import rightofway
from benchmarks.marked import write_tables
from rightofway.errors import GaveUp
from rightofway.metrics import measure
from rightofway.model import Plan, Rules, Scenario
from tests.builders.fleets import fleet_on, random_grid

PAGE = Path(__file__).with_name("README.md")
SEEDS = range(3)
LIMIT, LONG = 10, 60
"""Time for each plan [s], where plans are compared and where times are."""

SCALED = (100, 200, 400, 800)
ROBOTS_ON_96 = 500
"""The scaled fleets are as dense as so many robots on 96 x 96."""

METHODS: Mapping[str, tuple[str, Mapping[str, str]]] = {
    "published rule": ("two-level", {"swaps": "leave"}),
    "two-level": ("two-level", {}),
    "local-search": ("local-search", {"rounds": "1000000"}),
}


@dataclass(frozen=True, slots=True)
class Ground:
    """Where a fleet drives."""

    name: str
    robots: int
    grid: Callable[[random.Random], list[str]]

    def fleet(self, seed: int, occupancy: str) -> Scenario:
        """Return a random fleet of round trips; speeds 1, 1/2, 1/3, work 0 to 10."""
        draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
        rules = Rules(occupancy="both" if occupancy == "both" else "one")
        return fleet_on(self.grid(draw), draw, robots=self.robots, work=10, rules=rules)


@dataclass(frozen=True, slots=True)
class Run:
    """One plan, or none."""

    plan: Plan | None
    seconds: float

    @property
    def ratio(self) -> float:
        """Flowtime by the lower bound."""
        assert self.plan is not None
        metrics = measure(self.plan)
        return metrics.flowtime / metrics.lower_bound


def open_grid(size: int, walls: float) -> Callable[[random.Random], list[str]]:
    """Return a maker of random grids."""
    return lambda draw: random_grid(draw, size=size, walls=walls)


def aisles(_draw: random.Random) -> list[str]:
    """Return a warehouse: shelves of ten cells, twenty rows of five, aisles one cell wide."""
    row = "." * 4 + ("@" * 10 + ".") * 10 + "." * 3
    free = "." * len(row)
    return [free, free, *(line for _ in range(20) for line in (row, row, free)), free]


GROUNDS = (
    Ground("32 x 32, 10 % walls", 20, open_grid(32, 0.1)),
    Ground("32 x 32, 10 % walls", 50, open_grid(32, 0.1)),
    Ground("one-wide aisles, 63 x 117", 200, aisles),
    Ground("96 x 96, 5 % walls", 500, open_grid(96, 0.05)),
)


def run(scenario: Scenario, method: str, limit: int = LIMIT) -> Run:
    """Plan once; a plan with swaps is none."""
    planner, options = METHODS[method]
    began = time.perf_counter()
    try:
        plan = rightofway.solve(scenario, planner, time_limit=limit, options=options)
    except GaveUp:
        return Run(None, time.perf_counter() - began)
    seconds = time.perf_counter() - began
    return Run(plan if rightofway.check(plan).ok else None, seconds)


def quality() -> Iterator[str]:
    """Yield the table of how good plans are."""
    yield heading(
        "fleet", "`occupancy`", "published", "`two-level`", "[s]", "re-routed", "after flips"
    )
    for ground in GROUNDS:
        for occupancy in ("one", "both"):
            fleets = [ground.fleet(seed, occupancy) for seed in SEEDS]
            runs = {method: [run(fleet, method) for fleet in fleets] for method in METHODS}
            ours = runs["two-level"]
            seconds = median(one.seconds for one in ours)
            rerouted = median(len(one.plan.run.reroutes) for one in ours if one.plan)
            yield (
                f"| {ground.robots} robots, {ground.name} | {occupancy}"
                f" | {ratio(runs['published rule'])} | {ratio(ours)} | {seconds:.2f}"
                f" | {rerouted:g} | {ratio(runs['local-search'])} |\n"
            )


def heading(*columns: str) -> str:
    """Return the first two lines of a table."""
    return f"| {' | '.join(columns)} |\n|{' --- |' * len(columns)}\n"


def ratio(runs: list[Run]) -> str:
    """Say the median of the ratios, and how many were solved if not all were."""
    solved = [one.ratio for one in runs if one.plan is not None]
    if not solved:
        return f"0 of {len(runs)}"
    share = "" if len(solved) == len(runs) else f" ({len(solved)} of {len(runs)})"
    return f"{median(solved):.3f}{share}"


def growth() -> Iterator[str]:
    """Yield the table of how long it takes, at equal density."""
    yield heading(
        "robots", "size", "`occupancy`", "[s]", "decisions", "[ms] each", "visits", "ratio"
    )
    for robots in SCALED:
        size = round(96 * (robots / ROBOTS_ON_96) ** 0.5)
        ground = Ground(f"{size} x {size}", robots, open_grid(size, 0.05))
        for occupancy in ("one", "both"):
            runs = [run(ground.fleet(seed, occupancy), "two-level", LONG) for seed in SEEDS]
            plans = [one.plan for one in runs if one.plan is not None]
            seconds = median(one.seconds for one in runs)
            decisions = median(len(plan.run.decisions) for plan in plans)
            visits = median(sum(map(len, plan.tracks)) for plan in plans)
            yield (
                f"| {robots} | {ground.name} | {occupancy} | {seconds:.2f} | {decisions:g}"
                f" | {1000 * seconds / max(decisions, 1):.2f} | {visits:g} | {ratio(runs)} |\n"
            )


def main() -> None:
    """Measure and write the tables."""
    made = {"quality": "".join(quality()), "growth": "".join(growth())}
    write_tables(PAGE, "right of way", made)


if __name__ == "__main__":
    main()
