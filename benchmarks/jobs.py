"""Jobs in a crowded warehouse: tours and paths that learn from each other, and the gain of that.

``python -m benchmarks.jobs --fleets 5 --seconds 10`` draws transports in aisles between shelves.
Each fleet is planned twice in the same time: tours first, in a third of it, then their paths; and
by `solve`, where jobs move between robots by planned cost. The table has the service of both.

``python -m benchmarks.jobs --first`` prints when the first judged plan is there, of 10 robots with
50 jobs and of 100 robots with 1 000 jobs in a larger warehouse.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from itertools import product
from random import Random
from statistics import median
from time import perf_counter
from typing import Any

from benchmarks.common import table
from rightofway import solve
from rightofway.assign import AssignmentSearch, measure_travel
from rightofway.io import parse_scenario
from rightofway.model import Scenario
from rightofway.model.scenario import assign_tours
from rightofway.plan_work import measure_work
from rightofway.search import Distances

ROWS, COLUMNS = 14, 26

FIRST = ((10, 50, (14, 26)), (100, 1000, (60, 120)))
"""Robots, jobs, and rows and columns of the fleets whose first plan is timed."""

EDGE = 3
"""Columns without shelves at both ends; robots begin in the first and in the last column."""

SHARE_OF_TOURS = 0.3
"""The part of the time for tours, where paths come after them."""


def draw_fleet(
    n_robots: int, n_jobs: int, seed: int, size: tuple[int, int] = (ROWS, COLUMNS)
) -> Scenario:
    """Draw a warehouse of aisles, with robots at its ends and transports between its places."""
    (rows, columns), random = size, Random(seed)  # noqa: S311
    grid = [["."] * columns for _ in range(rows)]
    for row in range(2, rows - 2):
        for column in range(EDGE, columns - EDGE):
            if row % 3 != 2 and column % 6:
                grid[row][column] = "@"
    cells = product(range(rows), range(columns))
    free = [(row, column) for row, column in cells if grid[row][column] == "."]
    homes = random.sample([cell for cell in free if cell[1] in {0, columns - 1}], n_robots)
    places = [cell for cell in free if EDGE <= cell[1] < columns - EDGE]
    jobs: list[dict[str, Any]] = []
    for number in range(n_jobs):
        pickup, dropoff = (_name(cell, columns) for cell in random.sample(places, 2))
        work = random.randint(0, 3)
        jobs.append(
            {"name": f"J{number}", "pickup": pickup, "dropoff": dropoff, "pickup_work": work}
        )
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["".join(row) for row in grid]},
            "robots": [
                {"name": f"R{k}", "home": _name(cell, columns)} for k, cell in enumerate(homes)
            ],
            "jobs": jobs,
        }
    )


def _name(cell: tuple[int, int], columns: int) -> str:
    return f"N{cell[0] * columns + cell[1]}"


def time_first_plan(scenario: Scenario, seconds: float) -> tuple[float, int]:
    """Return after how long the first plan is there [s], and its unserved jobs."""
    times, began = list[tuple[float, int]](), perf_counter()
    solve(
        scenario,
        time_limit=seconds,
        on_plan=lambda plan: times.append((perf_counter() - began, len(plan.unserved))),
    )
    return times[0]


def assign_then_plan(scenario: Scenario, seconds: float) -> float:
    """Return the service of tours by travel times, planned in the rest of the time."""
    work, began = scenario.problem.work, perf_counter()
    assert work is not None, "the fleet has jobs"
    search = AssignmentSearch(work, measure_travel(scenario.problem, Distances(scenario.roadmap)))
    search.construct()
    search.improve(10**9, SHARE_OF_TOURS * seconds - (perf_counter() - began))
    toured = assign_tours(scenario, search.assignment.tours)
    plan = solve(toured, time_limit=seconds - (perf_counter() - began))
    return float(measure_work(replace(plan, unserved=search.assignment.unserved)).value)


def plan_together(scenario: Scenario, seconds: float) -> float:
    """Return the service of the plan of `solve`."""
    return float(measure_work(solve(scenario, time_limit=seconds)).value)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fleets", type=int, default=5)
    parser.add_argument("--robots", type=int, nargs="+", default=[8, 16, 24])
    parser.add_argument("--jobs", type=int, default=4, help="for each robot")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--first", action="store_true")
    args = parser.parse_args()
    if args.first:
        for n_robots, n_jobs, size in FIRST:
            scenario = draw_fleet(n_robots, n_jobs, 0, size)
            after, unserved = time_first_plan(scenario, args.seconds)
            print(f"{n_robots} robots, {n_jobs} jobs: {after:.1f} s, {unserved} unserved")  # noqa: T201
        return
    lines, gains = list[list[str]](), list[float]()
    for n_robots in args.robots:
        for seed in range(args.fleets):
            scenario = draw_fleet(n_robots, args.jobs * n_robots, seed)
            first, best = (
                plan(scenario, args.seconds) for plan in (assign_then_plan, plan_together)
            )
            gains.append(1 - best / first)
            figures = (f"{first:.0f}", f"{best:.0f}", f"{gains[-1]:.2%}")
            lines.append([str(n_robots), str(seed), *figures])
    print(table(["robots", "seed", "assign, then plan", "together", "gain"], lines))  # noqa: T201
    print(f"median gain {median(gains):.2%}, least {min(gains):.2%}")  # noqa: T201


if __name__ == "__main__":
    main()
