"""How many fleets `cbs` proves optimal, or within a factor, and what that takes.

``python -m benchmarks.proofs [--folder FOLDER] [--factor F] [--seconds S] [--classic]
[--gaps [--makespan]] [--eecbs PROGRAM] FLEET ...``
takes fleets as MAP:ROBOTS: maps of the MovingAI benchmark, from a folder with ``maps`` and
``scens`` in it, or grids that are drawn: ``24x20`` has 24 x 24 cells with 20 % walls. ``discs`` is
a drawn roadmap of 900 vertices and some 7000 lanes that cross, with robots of radius 0.35. Robots
have the speeds 1, 1/2, 1/3, 1/5 in turn, and `occupancy: both`; with ``--classic`` points have one
speed, and `occupancy: one`. Trips are one way, without work.

With ``--gaps`` the table says how far plans of `two-level`, `lns` and `auto` are above the optimum
or, where `cbs` does not prove it, above the best lower bound; each planner has a third of the
seconds. With ``--makespan`` all of them minimize the makespan, and the bound is of that.

With ``--eecbs`` the program of EECBS and `cbs` plan classic fleets of the benchmark within a factor
in turn, five times each. The table has their flowtimes, and the least processor time of each: that
of the whole process of EECBS, and that of `rightofway.solve`.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import subprocess
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import rightofway
from benchmarks.common import SEEDS, movingai_fleet, table
from benchmarks.sizes import Graph, document_of
from rightofway.bench.fleets import make_scenario_document
from rightofway.errors import GaveUp
from rightofway.io import parse_scenario
from rightofway.model import Objective, OutcomeKind, Rules, Scenario
from rightofway.repair.bounds import prove_bound

SPEEDS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 5))
EQUAL = (Fraction(1),)

DISCS = Graph(vertices=900, degree=8.3, lane=10, robots=0, radius="0.35")

REPEATS = 5
"""How often each program plans a fleet when they are compared."""

HEADS_OF_COMPARISON = ("EECBS: flowtime", "`cbs`: flowtime", "EECBS [s]", "`cbs` [s]")

PLANNERS = ("two-level", "lns", "auto")
"""Whose plans are compared with the optimum."""


def fleet(folder: Path | None, name: str, robots: int, seed: int, *, classic: bool) -> Scenario:
    """Return the first robots of a scenario of the benchmark, or of a drawn grid or roadmap."""
    if name == "discs":
        scenario = parse_scenario(document_of(replace(DISCS, robots=robots), seed, "whole"))
    elif re.fullmatch(r"\d+x\d+", name):
        side, walls = name.split("x")
        grid = {"width": int(side), "height": int(side), "walls": int(walls) / 100, "seed": seed}
        drawn = {"speeds": [1], "work": [0, 0], "by_seed": False, "rules": {}}
        scenario = parse_scenario(make_scenario_document({"random": grid}, drawn, robots, seed))
    else:
        assert folder is not None, f"{name} is no drawn map: its benchmark needs --folder"
        scenario = movingai_fleet(folder, name, robots, seed)
    return deal(scenario, classic=classic)


def deal(scenario: Scenario, *, classic: bool) -> Scenario:
    """Return a fleet of one way trips with speeds dealt in turn, and the rules of these tables."""
    speeds = EQUAL if classic else SPEEDS
    dealt = tuple(
        replace(robot, speed=speeds[k % len(speeds)]) for k, robot in enumerate(scenario.robots)
    )
    rules = Rules(occupancy="one" if classic else "both", ends="none")
    return replace(scenario, robots=dealt, rules=rules)


def figures(scenario: Scenario, factor: Fraction, seconds: float) -> tuple[bool, list[str]]:
    """Return whether the factor is proven; flowtime, cost / bound, seconds of the processor."""
    began = time.process_time()
    try:
        plan = rightofway.solve(scenario, "cbs", seconds, options={"suboptimality": factor})
    except GaveUp:
        return False, ["-", "-", f"{time.process_time() - began:.2f}"]
    outcome = plan.run.outcome
    spent = time.process_time() - began
    assert outcome is not None
    assert outcome.bound is not None
    ratio = plan.flowtime / outcome.bound
    is_proven = outcome.kind in {OutcomeKind.OPTIMAL, OutcomeKind.BOUNDED}
    cost = f"{float(plan.flowtime * scenario.problem.clock.tick):g}"
    return is_proven, [cost, f"{ratio:.3f}", f"{spent:.3f}"]


def compare_with_eecbs(
    program: Path, folder: Path, fleet_of: tuple[str, int, int], factor: Fraction, seconds: float
) -> list[str]:
    """Return the flowtime of EECBS and of `cbs`, and the processor seconds of both."""
    name, robots, seed = fleet_of
    files = ["-m", str(folder / "maps" / f"{name}.map"), "-o", os.devnull]
    files += ["-a", str(folder / "scens" / f"{name}-random-{seed}.scen")]
    limits = ["-k", str(robots), "-t", str(seconds), f"--suboptimality={float(factor)}"]
    scenario = fleet(folder, name, robots, seed, classic=True)
    theirs, ours = list[float](), list[float]()
    answer, cost = "", "-"
    for _ in range(REPEATS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        answer = subprocess.run(
            [program, *files, *limits], check=True, capture_output=True, text=True
        ).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        theirs.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        is_proven, (cost, _, spent) = figures(scenario, factor, seconds)
        assert is_proven, f"{name} with {robots} robots is not proven within {factor}"
        ours.append(float(spent))
    found = re.search(r"Succeed,(\d+)", answer)
    return [found[1] if found else "-", cost, f"{min(theirs):.3f}", f"{min(ours):.3f}"]


def gaps(
    scenario: Scenario, seconds: float, objective: Objective
) -> tuple[bool, list[float | None]]:
    """Return whether the optimum is proven, and how far each planner is above the best bound."""
    plans: list[rightofway.Plan | None] = []
    options = {"objective": "makespan" if objective is Objective.MAKESPAN else "flowtime"}
    for planner in (*PLANNERS, "cbs"):
        limit = seconds if planner == "cbs" else seconds / 3
        try:
            plans.append(rightofway.solve(scenario, planner, limit, options=options))
        except GaveUp:
            plans.append(None)
    bound = max(
        outcome.bound
        for plan in plans
        if plan is not None and (outcome := plan.run.outcome) is not None
        if outcome.objective is objective and outcome.bound is not None
    )
    if objective is Objective.FLOWTIME:
        bound = max(bound, prove_bound(scenario, time_limit=seconds)[0].bound)
    values = [
        None if plan is None else objective.compute_cost(scenario, plan.tracks) for plan in plans
    ]
    above = [None if value is None else value / bound - 1 for value in values[:-1]]
    return bound in values, above


def line_of_gaps(rows: list[tuple[bool, list[float | None]]]) -> list[str]:
    """Return the proofs among some fleets, and for each planner what its plans are above them."""
    columns = zip(*(above for _, above in rows), strict=True)
    return [
        f"{sum(is_proven for is_proven, _ in rows)} of {len(rows)}",
        *(
            ", ".join("-" if gap is None else f"{100 * gap:.1f}" for gap in gaps)
            for gaps in columns
        ),
    ]


def main() -> None:
    """Print the table, a line for each map and number of robots."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.proofs")
    parser.add_argument("fleets", nargs="+", metavar="FLEET")
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--factor", type=Fraction, default=Fraction(1))
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--classic", action="store_true")
    parser.add_argument("--gaps", action="store_true")
    parser.add_argument("--makespan", action="store_true")
    parser.add_argument("--eecbs", type=Path, metavar="PROGRAM")
    given = parser.parse_args()
    objective = Objective.MAKESPAN if given.makespan else Objective.FLOWTIME
    lines: list[tuple[str, ...]] = []
    for each in given.fleets:
        name, robots = each.rsplit(":", 1)
        if given.eecbs:
            compared = [
                compare_with_eecbs(
                    given.eecbs,
                    given.folder,
                    (name, int(robots), seed),
                    given.factor,
                    given.seconds,
                )
                for seed in SEEDS
            ]
            in_rows = (", ".join(column) for column in zip(*compared, strict=True))
            lines.append((name, robots, *in_rows))
            continue
        fleets = [
            fleet(given.folder, name, int(robots), seed, classic=given.classic) for seed in SEEDS
        ]
        if given.gaps:
            rows_of_gaps = [gaps(scenario, given.seconds, objective) for scenario in fleets]
            measured = line_of_gaps(rows_of_gaps)
            lines.append((name, robots, *measured))
            continue
        rows = [figures(scenario, given.factor, given.seconds) for scenario in fleets]
        proven = sum(is_proven for is_proven, _ in rows)
        columns = (", ".join(column) for column in zip(*(row for _, row in rows), strict=True))
        lines.append((name, robots, f"{proven} of {len(rows)}", *columns))
    heads: tuple[str, ...] = (
        "map", "robots", "proven", "flowtime", "cost / bound", "processor [s]",
    )  # fmt: skip
    if given.gaps:
        heads = ("map", "robots", "proven", *(f"`{planner}` [%]" for planner in PLANNERS))
    if given.eecbs:
        heads = ("map", "robots", *HEADS_OF_COMPARISON)
    print(table(heads, lines))  # noqa: T201


if __name__ == "__main__":
    main()
