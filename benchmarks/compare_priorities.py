"""Does giving way by collisions and work time pay? Planners side by side on random fleets.

Measures, keeps the figures in ``priorities.csv``, and writes tables and plots into the page
``docs/priorities.md``: `just priorities`. With ``--page-only`` the figures are those of the file.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from fractions import Fraction
from itertools import chain, product
from typing import Literal

import rightofway
from benchmarks.priorities_page import write_page
from benchmarks.priorities_plots import draw_all
from benchmarks.priorities_rows import Fleet, Row, load, save
from rightofway.errors import GaveUp
from rightofway.metrics import alone_completions, measure
from rightofway.model import Plan, PlannerRun, Rules, Scenario, roadmap_of_grid
from rightofway.planners import Deadline, Task, find
from tests.builders.fleets import grid_fleet, largest_part, random_grid

PLANNERS = ("two-level", "fixed-priority", "random-priority", "priority-search")
ROUTES = ("clear", "shortest")
SPEEDS = {"equal": [Fraction(1)], "mixed": [Fraction(1), Fraction(1, 2), Fraction(1, 3)]}
WORK = (0, 10, 30)
OCCUPANCY: tuple[Literal["one", "both"], ...] = ("one", "both")
FLEETS = {"open 16": (10, 20), "open 32": (20, 40), "aisles": (10, 20)}
SEEDS = range(8)
TIME_LIMIT = 20
"""For each plan [s]."""


def fleets() -> Iterator[Fleet]:
    """Yield all fleets; with other speeds, work or occupancy they still go to the same places."""
    sizes = [(ground, robots) for ground, counts in FLEETS.items() for robots in counts]
    for (ground, robots), speeds, work, occupancy, seed in product(
        sizes, SPEEDS, WORK, OCCUPANCY, SEEDS
    ):
        yield Fleet(
            ground=ground, robots=robots, speeds=speeds, work=work, occupancy=occupancy, seed=seed
        )


def scenario_of(fleet: Fleet) -> Scenario:
    """Draw a fleet; its seed, ground and size say where it goes."""
    draw = random.Random(f"{fleet.ground} {fleet.robots} {fleet.seed}")  # noqa: S311 (no secret)
    lines, homes, targets = ground_of(fleet.ground, draw)
    trips = zip(draw.sample(homes, fleet.robots), draw.sample(targets, fleet.robots), strict=True)
    return grid_fleet(
        lines,
        list(trips),
        rules=Rules(occupancy=fleet.occupancy),
        speeds=[draw.choice(SPEEDS[fleet.speeds]) for _ in range(fleet.robots)],
        work=[draw.randint(0, fleet.work) for _ in range(fleet.robots)],
    )


def ground_of(name: str, draw: random.Random) -> tuple[list[str], list[str], list[str]]:
    """Return a grid, the places to live in and the places to work at."""
    if name == "aisles":
        lines = aisles()
        bays = [f"N{column}" for column in range(0, 21, 2)]
        below = [f"N{14 * 21 + column}" for column in range(0, 21, 2)]
        return lines, [*bays, *below], [
            f"N{row * 21 + column}" for row in range(2, 13) for column in range(0, 21, 2)
        ]  # fmt: skip
    lines = random_grid(draw, size=int(name.split()[1]), walls=0.1)
    roadmap = roadmap_of_grid(lines)
    places = [roadmap.name(vertex) for vertex in largest_part(roadmap)]
    return lines, places, places


def aisles() -> list[str]:
    """Return shelves with aisles of one cell, three ways across them, and bays at the ends."""
    narrow, across = ".@" * 10 + ".", "." * 21
    return [narrow, across, *[narrow] * 5, across, *[narrow] * 5, across, narrow]


def rows_of(fleet: Fleet) -> list[Row]:
    """Plan a fleet by all planners on both kinds of routes."""
    scenario = scenario_of(fleet)
    rightofway.solve(scenario, "two-level", TIME_LIMIT)  # the first one imports
    return [
        row_of(fleet, scenario, planner, routes) for routes, planner in product(ROUTES, PLANNERS)
    ]


def row_of(fleet: Fleet, scenario: Scenario, planner: str, routes: str) -> Row:
    """Plan a fleet by one planner, take the time of that alone, and have the plan judged."""
    plan, seconds = planned(scenario, planner, routes)
    assert plan is None or rightofway.check(plan).ok
    levels = Counter(one.level for one in plan.run.decisions) if plan else Counter()
    return Row(
        **asdict(fleet),
        planner=planner,
        routes=routes,
        flowtime=measure(plan).flowtime if plan else None,
        lower_bound=sum(alone_completions(scenario)),
        decisions=levels.total(),
        node=levels["node"],
        robot=levels["robot"],
        settled=levels["settled"],
        only=levels["only"],
        rerouted=len(plan.run.reroutes) if plan else 0,
        seconds=round(seconds, 5),
    )


def planned(scenario: Scenario, planner: str, routes: str) -> tuple[Plan | None, float]:
    """Return the plan, if there was time for one, and the time of the processor [s]."""
    spec = find(planner)
    options, deadline = spec.settle({"routes": routes}), Deadline.after(TIME_LIMIT)
    task, plan_it = Task(scenario=scenario, options=options, deadline=deadline), spec.load()
    began = time.process_time()
    try:
        draft = plan_it(task)
    except GaveUp:
        return None, time.process_time() - began
    seconds = time.process_time() - began
    run = PlannerRun(name=planner, decisions=draft.decisions, reroutes=draft.reroutes)
    return Plan(scenario=scenario, tracks=draft.tracks, run=run), seconds


def measured(workers: int) -> list[Row]:
    """Plan all fleets, so many at once."""
    began, everything = time.perf_counter(), list(fleets())
    with ProcessPoolExecutor(workers) as pool:
        rows = list(chain.from_iterable(pool.map(rows_of, everything, chunksize=4)))
    took = time.perf_counter() - began
    sys.stderr.write(f"{len(rows)} plans of {len(everything)} fleets in {took:.0f} s\n")
    return rows


def main() -> None:
    """Measure, unless asked not to, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--page-only", action="store_true", help="take the figures of the file")
    parser.add_argument("--workers", type=int, default=2, help="how many processes measure")
    given = parser.parse_args()
    if not given.page_only:
        save(measured(given.workers))
    rows = load()
    write_page(rows)
    draw_all(rows)


if __name__ == "__main__":
    main()
