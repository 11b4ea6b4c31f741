"""Plans of PyMAPF beside ours, on random-1 of random-32-32-20 of the MovingAI benchmark.

``python -m benchmarks.beside_pymapf FOLDER [SOLVER ...]`` wants a folder of the benchmark, with
``maps`` and ``scens`` in it, and `pip install pymapf`. Each program has 30 s of its own limit.
"""

from __future__ import annotations

import sys
import time
from importlib import import_module
from pathlib import Path

import rightofway
from benchmarks.common import movingai_fleet, table
from rightofway.io.movingai import load_map

MAP, SEED = "random-32-32-20", 1
COUNTS = (50, 100)
SOLVERS = ("wcbs", "lacam", "prioritized", "lns")
LIMIT, OURS = 30.0, 1.0
"""Seconds for PyMAPF, and for us."""


def solve_by_pymapf(folder: Path, robots: int, solver: str) -> tuple[str, str]:
    """Return flowtime and seconds of a plan, or that there is none."""
    pymapf = import_module("pymapf")
    rows = load_map(folder / "maps" / f"{MAP}.map")
    grid = pymapf.GridMap([[int(cell != ".") for cell in row] for row in rows])
    scenario = movingai_fleet(folder, MAP, robots, SEED)
    on = scenario.roadmap.grid
    assert on is not None, "a map of the benchmark has rows"
    agents = [
        pymapf.Agent(robot.name, start=on.get_cell(robot.home), goal=on.get_cell(robot.stops[0].at))
        for robot in scenario.robots
    ]
    began = time.perf_counter()
    plan = pymapf.solve(pymapf.MAPFProblem(grid, agents), solver, time_limit=LIMIT)
    seconds = f"{time.perf_counter() - began:.1f}"
    return (str(plan.sum_of_costs) if plan and plan.is_valid() else "no plan", seconds)


def main() -> None:
    """Print the table."""
    folder, solvers = Path(sys.argv[1]), sys.argv[2:] or SOLVERS
    lines: list[tuple[str, ...]] = []
    for robots in COUNTS:
        scenario = movingai_fleet(folder, MAP, robots, SEED)
        ours = rightofway.solve(scenario, time_limit=OURS)
        flowtime = ours.flowtime * ours.scenario.problem.clock.tick
        lines.append((str(robots), "rightofway", str(flowtime), f"{OURS:.1f}"))
        lines += [
            (str(robots), solver, *solve_by_pymapf(folder, robots, solver)) for solver in solvers
        ]
    print(table(("robots", "solver", "flowtime", "seconds"), lines))  # noqa: T201


if __name__ == "__main__":
    main()
