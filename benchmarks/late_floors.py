"""Plans of every planner on late floors: what collides, how late robots are, and how fast it runs.

``python -m benchmarks.late_floors`` writes the tables of ``benchmarks/README.md``;
``python -m benchmarks.late_floors PLANNER …`` runs these planners only, and prints.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import rightofway
from benchmarks.marked import write_tables
from rightofway.floor import Outcome
from rightofway.model import Plan, Rules, Scenario
from rightofway.planners import registered
from tests.fleets import random_fleet

RUNS = 10_000
"""Runs of each plan with each kind of delay."""

CARED = 50
"""Runs of each plan where rights of way are switched."""

LIMIT = 2
"""Time for each plan [s]."""

DELAYS = {
    "noise": "exponential:0.2",
    "stops": "chance:0.02x20",
    "breakdowns": "breaks:0.05,uniform:0..0.5",
}
FLEETS = {
    "10 robots, 12 x 12": random_fleet(1, size=12, robots=10),
    "10 robots, 12 x 12, `both`": random_fleet(
        1, size=12, robots=10, rules=Rules(occupancy="both")
    ),
    "30 robots, 20 x 20, `both`, headway 1": random_fleet(
        2, size=20, robots=30, rules=Rules(occupancy="both", headway=Fraction(1))
    ),
    "30 robots, 20 x 20, two laps": random_fleet(3, size=20, robots=30, rules=Rules(laps=2)),
}
PAGE = Path(__file__).with_name("README.md")


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One plan with one kind of delay."""

    planner: str
    fleet: str
    delays: str
    outcome: Outcome
    seconds: float


def plan_of(scenario: Scenario, planner: str) -> Plan:
    """Return a plan; the same one for each kind of delay."""
    return rightofway.solve(scenario, planner, time_limit=LIMIT)


def rows(planner: str) -> Iterator[Row]:
    """Run the plans of one planner."""
    for fleet, scenario in FLEETS.items():
        plan = plan_of(scenario, planner)
        for name, delays in DELAYS.items():
            began = time.perf_counter()
            outcome = rightofway.simulate(plan, delays, RUNS)
            seconds = time.perf_counter() - began
            yield Row(planner=planner, fleet=fleet, delays=name, outcome=outcome, seconds=seconds)


def runs_table(planners: list[str]) -> Iterator[str]:
    """Yield a line for each planner: everything it was put through."""
    yield heading("planner", "runs", "collisions", "deadlocks", "by clock", "late", "runs/s")
    for planner in planners:
        found = list(rows(planner))
        runs = sum(row.outcome.runs for row in found)
        collided = sum(row.outcome.by_clock.runs for row in found) / runs
        late = [row.outcome.lateness.all.mean or 0 for row in found]
        yield (
            f"| {planner} | {runs} | {sum(row.outcome.collisions for row in found)}"
            f" | {sum(row.outcome.deadlocks for row in found)} | {collided:.1%}"
            f" | {sum(late) / len(late):.1f} | {runs / sum(row.seconds for row in found):.0f} |\n"
        )


def switching_table() -> Iterator[str]:
    """Yield how much switching wins over keeping the order, on plans of `auto`."""
    yield heading("fleet", "delays", "late, kept", "late, switched", "switches a run", "runs/s")
    for fleet, scenario in FLEETS.items():
        plan = plan_of(scenario, "auto")
        for name in ("noise", "stops"):
            kept = rightofway.simulate(plan, DELAYS[name], CARED)
            began = time.perf_counter()
            switched = rightofway.simulate(plan, DELAYS[name], CARED, switch=True)
            speed = CARED / (time.perf_counter() - began)
            assert not switched.collisions
            assert not switched.deadlocks
            yield (
                f"| {fleet} | {name} | {kept.lateness.flowtime.mean:.0f}"
                f" | {switched.lateness.flowtime.mean:.0f}"
                f" | {switched.switches / CARED:.1f} | {speed:.0f} |\n"
            )


def heading(*columns: str) -> str:
    """Return the head of a table."""
    return f"| {' | '.join(columns)} |\n|{' --- |' * len(columns)}\n"


def main() -> None:
    """Measure, and print or write the tables."""
    if sys.argv[1:]:
        for line in (
            switching_table() if sys.argv[1:] == ["switching"] else runs_table(sys.argv[1:])
        ):
            print(line, end="", flush=True)  # noqa: T201
        return
    made = {
        "runs": "".join(runs_table(sorted(registered()))),
        "switching": "".join(switching_table()),
    }
    write_tables(PAGE, "late floors", made)


if __name__ == "__main__":
    main()
