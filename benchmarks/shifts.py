"""Shifts: problems of the League of Robot Runners, and a warehouse in which orders arrive.

``python -m benchmarks.shifts league PROBLEM … --steps 500 --seconds 1`` reads problems of the
League, lets the clock stand while a round is planned, and prints the tasks that are done.

``python -m benchmarks.shifts warehouse MAP --robots 200 --hours 8`` draws robots with speeds,
batteries and perhaps sizes of their own on a map of the MovingAI benchmark, and orders that arrive
at random; robots drive while rounds are planned.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

from benchmarks.common import table
from rightofway.dispatch import Reveal, ShiftRecord, ShiftRules, run_shift
from rightofway.dispatch.figures import measure_shift
from rightofway.facts import Fact
from rightofway.io import load_with_notes
from rightofway.io.scenario.reader import parse_scenario
from rightofway.model import Scenario, Tick
from rightofway.report.quantities import Quantities
from rightofway.report.shift import report_shift

MEGABYTE = 1024
"""`ru_maxrss` has kilobytes."""

MEMORY = Path("/proc/self/statm")
"""Where Linux tells the pages of this process: the second number is those in memory."""

TIME_OF_JOB = 240
"""A robot gets a job about every so many seconds."""


def hold_league_shift(path: str, steps: int, seconds: float, seed: int) -> list[str]:
    """Return a row of the table: the tasks that a team finishes in some steps."""
    loaded = load_with_notes(path)
    scenario = loaded.scenario
    reveal = Reveal(scenario.jobs or (), scenario.problem.clock, first=loaded.reveal)
    rules = ShiftRules(until=Tick(steps), time_limit=seconds, seed=seed)
    began = time.perf_counter()
    record = run_shift(scenario, reveal, rules, report=_report_progress(scenario, steps // 10))
    figures = measure_shift(record)
    return [
        Path(path).stem,
        str(len(scenario.robots)),
        str(steps),
        str(figures.done),
        str(figures.stood),
        f"{figures.seconds[0]:.2f}",
        f"{time.perf_counter() - began:.0f}",
    ]


def _report_progress(scenario: Scenario, every: int) -> Callable[[Fact], None]:
    """Return a function that writes the progress of a shift to standard error, now and then."""
    told = 0

    def report(fact: Fact) -> None:
        nonlocal told
        if fact.values["time"] >= told + every:
            told = fact.values["time"]
            memory = int(MEMORY.read_text().split()[1]) * resource.getpagesize() // MEGABYTE**2
            clock = f"{time.process_time():.0f} s of a processor"
            text = f"{fact.bind(scenario)}; {memory} MB, {clock}"
            print(text, file=sys.stderr, flush=True)  # noqa: T201

    return report


def draw_warehouse(
    path: str, n_robots: int, duration: int, seed: int, *, sizes: bool
) -> dict[str, Any]:
    """Return a document of a warehouse: robots at its sides, orders between a side and shelves."""
    random = Random(seed)  # noqa: S311
    lines = Path(path).read_text(encoding="utf-8").split("\n")
    grid = [line.replace("T", "@") for line in lines[4:] if line]
    columns = len(grid[0])
    free = [(r, c) for r, line in enumerate(grid) for c, cell in enumerate(line) if cell == "."]
    # Every second column of both sides, so that a robot at home is in no other robot's way.
    sides = {*range(0, 6, 2), *range(columns - 1, columns - 7, -2)}
    homes = [list(place) for place in free if place[1] in sides]
    random.shuffle(homes)
    docks = [list(place) for place in free if place[1] == 7]
    shelves = [list(place) for place in free if 15 < place[1] < columns - 15]
    robots = [
        {
            "name": f"R{number}",
            "home": homes[number],
            "speed": random.choice(["3/4", "1", "1", "5/4"]),
            "battery": "cell",
            **({"radius": random.choice(["3/10", "2/5"])} if sizes else {}),
        }
        for number in range(n_robots)
    ]
    jobs, now = list[dict[str, Any]](), 0.0
    while now < duration:
        ends = [random.choice(docks), random.choice(shelves)]
        random.shuffle(ends)
        job = {"name": f"J{len(jobs)}", "pickup": ends[0], "dropoff": ends[1]}
        jobs.append({**job, "pickup_work": 8, "dropoff_work": 8, "earliest": int(now)})
        now += random.expovariate(n_robots / TIME_OF_JOB)
    return {
        "format": "rightofway-scenario/1",
        "map": {"grid": grid},
        "units": {"time": "s", "length": "m"},
        "robots": robots,
        "batteries": {
            "cell": {"drive": "1/4000", "on": "1/36000", "charge": "1/1200", "reserve": "1/10"}
        },
        "charging": homes[:n_robots],
        "rules": {"turn": 0, "patience": 900},
        "jobs": jobs,
    }


def hold_warehouse_shift(scenario: Scenario, seconds: float, lead: int, seed: int) -> ShiftRecord:
    """Return the record of a shift in which all orders are done, or twice the time is over."""
    clock = scenario.problem.clock
    jobs = scenario.jobs or ()
    until = 2 * max(job.earliest for job in jobs)
    ticks = clock.count_ticks(Fraction(lead))
    rules = ShiftRules(
        until=clock.count_ticks(until), step=ticks, lead=ticks, time_limit=seconds, seed=seed
    )
    every = clock.count_ticks(Fraction(300))
    return run_shift(scenario, Reveal(jobs, clock), rules, report=_report_progress(scenario, every))


def main() -> None:
    """Hold shifts, and print their figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    kinds = parser.add_subparsers(dest="kind", required=True)
    league = kinds.add_parser("league", help="problems of the League of Robot Runners")
    league.add_argument("problems", nargs="+")
    league.add_argument("--steps", type=int, default=500)
    warehouse = kinds.add_parser("warehouse", help="orders that arrive in a warehouse")
    warehouse.add_argument("map")
    warehouse.add_argument("--robots", type=int, default=200)
    warehouse.add_argument("--hours", type=float, default=8)
    warehouse.add_argument("--lead", type=int, default=6, help="time of a round on the floor [s]")
    warehouse.add_argument("--sizes", action="store_true")
    for kind in (league, warehouse):
        kind.add_argument("--seconds", type=float, default=1.0, help="of a round")
        kind.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    if given.kind == "league":
        heads = ("problem", "robots", "steps", "done", "rounds without a plan", "s a round", "s")
        rows = [
            hold_league_shift(path, given.steps, given.seconds, given.seed)
            for path in given.problems
        ]
        print(table(heads, rows))  # noqa: T201
        return
    duration = round(given.hours * 3600)
    document = draw_warehouse(given.map, given.robots, duration, given.seed, sizes=given.sizes)
    scenario = parse_scenario(document)
    record = hold_warehouse_shift(scenario, given.seconds, given.lead, given.seed)
    print(report_shift(record, Quantities.of(scenario)))  # noqa: T201
    print(f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // MEGABYTE} MB at most")  # noqa: T201


if __name__ == "__main__":
    main()
