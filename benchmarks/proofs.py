"""How many fleets `cbs` proves optimal, or within a factor, and what that takes.

``python -m benchmarks.proofs [--folder FOLDER] [--factor F] [--seconds S] [--classic] FLEET ...``
takes fleets as MAP:ROBOTS: maps of the MovingAI benchmark, from a folder with ``maps`` and
``scens`` in it, or grids that are drawn: ``24x20`` has 24 x 24 cells with 20 % walls. Robots have
the speeds 1, 1/2, 1/3, 1/5 in turn, and `occupancy: both`; with ``--classic`` they have one speed,
and `occupancy: one`. Trips are one way, without work.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import rightofway
from benchmarks.common import SEEDS, movingai_fleet, table
from rightofway.bench.fleets import scenario_document
from rightofway.errors import GaveUp
from rightofway.io import scenario_of
from rightofway.model import OutcomeKind, Rules, Scenario

SPEEDS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 5))
EQUAL = (Fraction(1),)


def fleet(folder: Path | None, name: str, robots: int, seed: int, *, classic: bool) -> Scenario:
    """Return the first robots of a scenario of the benchmark, or of a grid drawn at random."""
    if folder is None:
        side, walls = name.split("x")
        grid = {"width": int(side), "height": int(side), "walls": int(walls) / 100, "seed": seed}
        drawn = {"speeds": [1], "work": [0, 0], "by_seed": False, "rules": {}}
        scenario = scenario_of(scenario_document({"random": grid}, drawn, robots, seed))
    else:
        scenario = movingai_fleet(folder, name, robots, seed)
    speeds = EQUAL if classic else SPEEDS
    dealt = tuple(
        replace(robot, speed=speeds[k % len(speeds)]) for k, robot in enumerate(scenario.robots)
    )
    rules = Rules(occupancy="one" if classic else "both", ends="none")
    return replace(scenario, robots=dealt, rules=rules)


def figures(scenario: Scenario, factor: Fraction, seconds: float) -> tuple[bool, str, str]:
    """Return whether the factor is proven, cost / bound, and the seconds of the processor."""
    began = time.process_time()
    try:
        plan = rightofway.solve(scenario, "cbs", seconds, options={"suboptimality": factor})
    except GaveUp:
        return False, "-", f"{time.process_time() - began:.1f}"
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    ratio = plan.flowtime / outcome.bound
    is_proven = outcome.kind in {OutcomeKind.OPTIMAL, OutcomeKind.BOUNDED}
    return is_proven, f"{ratio:.3f}", f"{time.process_time() - began:.1f}"


def main() -> None:
    """Print the table, a line for each map and number of robots."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.proofs")
    parser.add_argument("fleets", nargs="+", metavar="FLEET")
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--factor", type=Fraction, default=Fraction(1))
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--classic", action="store_true")
    given = parser.parse_args()
    lines = []
    for each in given.fleets:
        name, robots = each.rsplit(":", 1)
        rows = [
            figures(
                fleet(given.folder, name, int(robots), seed, classic=given.classic),
                given.factor,
                given.seconds,
            )
            for seed in SEEDS
        ]
        proven = sum(is_proven for is_proven, _, _ in rows)
        ratios = ", ".join(ratio for _, ratio, _ in rows)
        cpu = ", ".join(spent for _, _, spent in rows)
        lines.append((name, robots, f"{proven} of {len(rows)}", ratios, cpu))
    heads = ("map", "robots", "proven", "cost / bound", "processor [s]")
    print(table(heads, lines))  # noqa: T201


if __name__ == "__main__":
    main()
