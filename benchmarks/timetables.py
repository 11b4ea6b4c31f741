"""How much a chosen timetable wins over rules: random fleets that repeat their work.

Each fleet's laps per tick under a timetable chosen in a few seconds, by those under each rule. A
rule that comes to a standstill, or leaves a robot standing for ever, has no laps to compare with
and is counted apart; one that does not repeat in its time is compared by the laps that were seen.

``just timetables`` measures anew and writes the table of README.md beside this file, in some
minutes; ``python -m benchmarks.timetables 8`` prints the rows of fleets of eight robots.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from statistics import median

from benchmarks.marked import write_tables
from rightofway.cyclic import CyclicResult, best_timetable, run_laps
from rightofway.errors import GaveUp
from rightofway.model import Scenario
from tests.builders.fleets import random_fleet

PAGE = Path(__file__).with_name("README.md")
HEADING = (
    "| robots | rule | how it ends | least ratio | median | greatest | its fairness | ours |",
    "| ---: | --- | --- | ---: | ---: | ---: | ---: | ---: |",
)

RULES = ("first-come", "two-level", "fixed-order")
SIDE = {4: 6, 8: 8, 16: 12}
FLEETS = 12
CHOOSING, RUNNING = 5.0, 1.0
"""Seconds for a timetable, and for each rule."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One fleet under one rule."""

    ends: str
    ratio: float | None
    fairness: float
    own_fairness: float


def fleets(robots: int) -> Iterator[Scenario]:
    """Yield random fleets in which every robot leaves its home."""
    found, seed = 0, 0
    while found < FLEETS:
        scenario = random_fleet(seed, size=SIDE[robots], robots=robots)
        seed += 1
        if all(robot.stops[0].at != robot.home for robot in scenario.robots):
            found += 1
            yield scenario


def fairness(run: CyclicResult) -> float:
    """Return the least part of its laps alone that any robot makes."""
    parts = [
        Fraction(lap.duration) / mean if mean else Fraction(0)
        for group in run.groups
        for lap, mean in zip(group.context.laps, group.mean_laps(), strict=True)
    ]
    return float(min(parts))


def rows(scenario: Scenario) -> dict[str, Row]:
    """Compare one fleet's timetable with all rules; nothing if it has none."""
    try:
        chosen = best_timetable(scenario, time_limit=CHOOSING)
    except GaveUp:
        return {}
    return {rule: _row(scenario, rule, chosen) for rule in RULES}


def _row(scenario: Scenario, rule: str, chosen: CyclicResult) -> Row:
    run = run_laps(scenario, rule, time_limit=RUNNING)
    ends = _ends(run)
    compares = ends in ("repeats", "open") and run.throughput() > 0
    return Row(
        ends=ends,
        ratio=float(chosen.throughput() / run.throughput()) if compares else None,
        fairness=fairness(run),
        own_fairness=fairness(chosen),
    )


def _ends(run: CyclicResult) -> str:
    ends = {group.ends for group in run.groups}
    if "deadlock" in ends:
        return "deadlock"
    if any(mean is None for group in run.groups for mean in group.mean_laps()):
        return "starves"
    return "open" if "open" in ends else "repeats"


def table(robots: int) -> Iterator[str]:
    """Yield a line of the table for each rule."""
    compared = [found for scenario in fleets(robots) if (found := rows(scenario))]
    for rule in RULES:
        own = [row[rule] for row in compared]
        ratios = sorted(row.ratio for row in own if row.ratio is not None)
        count = Counter(row.ends for row in own)
        ends = ", ".join(f"{number} {end}" for end, number in sorted(count.items()))
        against = [row for row in own if row.ratio is not None]
        figures = (
            f"{ratios[0]:.3f} | {median(ratios):.3f} | {ratios[-1]:.3f} | "
            f"{median(row.fairness for row in against):.2f} | "
            f"{median(row.own_fairness for row in against):.2f}"
            if ratios
            else "- | - | - | - | -"
        )
        yield f"| {robots} | `{rule}` | {ends} | {figures} |"


def main() -> None:
    """Write the table between its marks, or print rows for some numbers of robots."""
    if sys.argv[1:]:
        sys.stdout.writelines(f"{line}\n" for n in map(int, sys.argv[1:]) for line in table(n))
        return
    lines = [line for robots in SIDE for line in table(robots)]
    rows = "".join(f"{line}\n" for line in (*HEADING, *lines))
    write_tables(PAGE, "timetables", {"rivals": rows})


if __name__ == "__main__":
    main()
