"""Plans of every planner on late floors: what collides, how late robots are, and how fast it runs.

``python -m benchmarks.late_floors`` measures what is not measured yet, a line at a time, and then
writes the tables of ``benchmarks/README.md``. What it has is in ``build/late-floors.jsonl``: it
goes on where it was interrupted, and begins anew without that file. Arguments name the planners, or
``care``, to measure only these; a table is written when no row of it is missing.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import rightofway
from benchmarks.kept import Kept
from benchmarks.marked import tables_in, write_tables
from rightofway.model import Plan, Rules
from rightofway.planners import registered
from tests.builders.fleets import random_fleet

RUNS = 10_000
"""Runs of each plan with each kind of delay."""

CARED = 20
"""Runs of each plan that are cared for."""

LIMIT = 2
"""Time for each plan [s]."""

NEIGHBOURHOODS = 3000
"""What plans that are cared for are made with; so they are the same everywhere."""

DELAYS = {
    "noise": "exponential:0.2",
    "stops": "chance:0.02x20",
    "breakdowns": "breaks:0.05,uniform:0..0.5",
}
CARED_FOR = {
    "noise": DELAYS["noise"],
    "stops": DELAYS["stops"],
    "slow robot": "slow:R3x2,exponential:0.1",
}
CARES = {
    "switched": (True, False),
    "planned anew": (False, True),
    "both": (True, True),
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
KEPT = PAGE.parents[1] / "build" / "late-floors.jsonl"

Row = dict[str, Any]


@cache
def plan_of(fleet: str, planner: str) -> Plan:
    """Return a plan; the same one for each kind of delay."""
    return rightofway.solve(FLEETS[fleet], planner, time_limit=LIMIT)


@cache
def plan_to_care_for(fleet: str) -> Plan:
    """Return a plan that depends on no clock."""
    return rightofway.solve(FLEETS[fleet], "auto", None, options={"iterations": NEIGHBOURHOODS})


def run_row(planner: str, fleet: str, delays: str) -> Row:
    """Run one plan with one kind of delay."""
    plan, began = plan_of(fleet, planner), time.perf_counter()
    outcome = rightofway.simulate(plan, DELAYS[delays], RUNS)
    return {
        "runs": outcome.runs,
        "collisions": outcome.collisions,
        "deadlocks": outcome.deadlocks,
        "by_clock": outcome.by_clock.runs,
        "late": outcome.lateness.all.mean or 0,
        "seconds": time.perf_counter() - began,
    }


def care_row(fleet: str, delays: str, care: str) -> Row:
    """Run one plan with one kind of delay, and care for it."""
    plan, began = plan_to_care_for(fleet), time.perf_counter()
    switch, replan = CARES[care]
    outcome = rightofway.simulate(plan, CARED_FOR[delays], CARED, switch=switch, replan=replan)
    seconds = time.perf_counter() - began
    gain = outcome.gain
    assert gain is not None
    assert gain.runs == CARED
    assert not outcome.collisions + outcome.deadlocks
    return {
        "late": outcome.lateness.flowtime.mean,
        "won": gain.flowtime.mean,
        "earlier": gain.earlier,
        "later": gain.later,
        "changes": (outcome.switches + outcome.replans) / CARED,
        "seconds": seconds,
    }


def measure(kept: Kept, what: list[str]) -> None:
    """Measure what is missing, and keep each row as soon as it is there."""
    for planner in (name for name in what if name != "care"):
        for fleet in FLEETS:
            for delays in DELAYS:
                kept.take(("runs", planner, fleet, delays), run_row, planner, fleet, delays)
    for fleet in FLEETS if "care" in what else ():
        for delays in CARED_FOR:
            for care in CARES:
                kept.take(("care", fleet, delays, care), care_row, fleet, delays, care)


def runs_table(kept: Kept, planners: list[str]) -> Iterator[str]:
    """Yield a line for each planner: everything it was put through."""
    yield heading("planner", "runs", "collisions", "deadlocks", "by clock", "late", "runs/s")
    for planner in planners:
        found = [kept["runs", planner, fleet, delays] for fleet in FLEETS for delays in DELAYS]
        runs, collisions, deadlocks, by_clock, late, seconds = (
            sum(row[name] for row in found)
            for name in ("runs", "collisions", "deadlocks", "by_clock", "late", "seconds")
        )
        yield (
            f"| {planner} | {runs} | {collisions} | {deadlocks} | {by_clock / runs:.1%}"
            f" | {late / len(found):.1f} | {runs / seconds:.0f} |\n"
        )


def care_table(kept: Kept) -> Iterator[str]:
    """Yield how much care wins over keeping the order."""
    ways = ("late", "won", "runs earlier, later", "changes a run", "runs/s")
    yield heading("fleet", "delays", "care", *ways)
    for fleet in FLEETS:
        for delays in CARED_FOR:
            for care in CARES:
                row = kept["care", fleet, delays, care]
                order = row["late"] + row["won"]
                yield (
                    f"| {fleet} | {delays} | {care} | {order:.0f} → {row['late']:.0f}"
                    f" | {row['won'] / order:.1%} | {row['earlier']}, {row['later']}"
                    f" | {row['changes']:.1f} | {CARED / row['seconds']:.1f} |\n"
                )


def heading(*columns: str) -> str:
    """Return the head of a table."""
    return f"| {' | '.join(columns)} |\n|{' --- |' * len(columns)}\n"


def main() -> None:
    """Measure, and write the tables when nothing is missing."""
    kept, planners = Kept(KEPT), sorted(registered())
    measure(kept, sys.argv[1:] or [*planners, "care"])
    made = tables_in(PAGE, "late floors")
    for name, table in (("runs", runs_table(kept, planners)), ("care", care_table(kept))):
        with suppress(KeyError):  # of a row that is not measured yet
            made[name] = "".join(table)
    write_tables(PAGE, "late floors", made)


if __name__ == "__main__":
    main()
