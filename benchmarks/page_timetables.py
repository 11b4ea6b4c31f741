"""A table of docs/results/second-lap.md: chosen timetables beside the rules of laps."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any

from benchmarks.common import (
    grouped,
    option,
    place_of,
    table,
)
from rightofway.bench import Row


def timetable_tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return the table: laps under a chosen timetable by those under each rule."""
    heads = (
        "robots", "rule", "how it ends", "least ratio", "median", "greatest", "its fairness",
        "ours",
    )  # fmt: skip
    known = [(row, json.loads(row["figures"])) for row in rows if row["figures"]]
    chosen = {place_of(row): found for row, found in known if option(row, "rule") == "timetable"}
    others = [
        (row, found)
        for row, found in known
        if option(row, "rule") != "timetable" and place_of(row) in chosen
    ]
    lines = []
    kinds = grouped(others, lambda each: (each[0]["robots"], option(each[0], "rule")))
    for (robots, rule), group in kinds.items():
        ends = Counter(_end(found) for _, found in group)
        compared = [
            (found, chosen[place_of(row)])
            for row, found in group
            if _end(found) in ("repeats", "open") and found["throughput"]
        ]
        ratios = [ours["throughput"] / found["throughput"] for found, ours in compared]
        cells = ["-"] * 5
        if ratios:
            fairness = (median(map(_fairness, each)) for each in zip(*compared, strict=True))
            cells = [
                *(f"{ratio:.3f}" for ratio in (min(ratios), median(ratios), max(ratios))),
                *(f"{part:.2f}" for part in fairness),
            ]
        how = ", ".join(f"{number} {end}" for end, number in sorted(ends.items()))
        lines.append((str(robots), f"`{rule}`", how, *cells))
    return {"rivals": table(heads, lines)}


def _end(figures: Mapping[str, Any]) -> str:
    ends = {group["ends"] for group in figures["groups"]}
    if "deadlock" in ends:
        return "deadlock"
    if any(group["starves"] for group in figures["groups"]):
        return "starves"
    return "open" if "open" in ends else "repeats"


def _fairness(figures: Mapping[str, Any]) -> float:
    return float(min(group["fairness"] for group in figures["groups"]))
