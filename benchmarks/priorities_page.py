"""The tables of the page on priorities, from what was measured."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.marked import write_tables
from benchmarks.priorities_rows import Row, fleet_of

PAGE = Path(__file__).parents[1] / "docs" / "priorities.md"

OURS = "two-level"
OTHERS = ("fixed-priority", "random-priority", "priority-search")

LEVELS = ("node", "settled", "robot", "only")

Pair = tuple[Row, Row]
"""What another planner and what ours made of one fleet on the same routes."""


def write_page(rows: Sequence[Row], page: Path = PAGE) -> None:
    """Put the tables between their marks."""
    write_tables(page, "table", tables(rows))


def tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return every table by its name in the page."""
    by = {
        "routes": lambda row: f"`{row.routes}`",
        "speeds and work": lambda row: f"`{row.routes}`, speeds {row.speeds}, {work_of(row)}",
        "occupancy": lambda row: f"`{row.routes}`, `occupancy: {row.occupancy}`",
        "fleets": lambda row: f"`{row.routes}`, {ground_of(row)}",
    }
    by_routes = sorted(rows, key=lambda row: row.routes)
    return {
        "planners": "".join(_planners(by_routes)),
        **{name: "".join(_against_ours(by_routes, key)) for name, key in by.items()},
        "levels": "".join(_levels([row for row in by_routes if row.planner == OURS])),
        "waits only": "".join(_against_ours(_only_waiting(by_routes), by["fleets"])),
    }


def work_of(row: Row) -> str:
    """Say how long the robots of a fleet work."""
    return f"work 0 to {row.work}" if row.work else "no work"


def ground_of(row: Row) -> str:
    """Say where a fleet drives, and how many they are."""
    return f"{row.ground}, {row.robots} robots"


def _planners(rows: Sequence[Row]) -> Iterator[str]:
    yield from _head(
        "routes", "planner", "solved", "waits only", "flowtime / lower bound", "time [ms]",
        "time / two-level",
    )  # fmt: skip
    ours = {(fleet_of(row), row.routes): row for row in rows if row.planner == OURS}
    for (routes, planner), group in grouped(rows, lambda row: (row.routes, row.planner)):
        slower = [row.seconds / ours[fleet_of(row), row.routes].seconds for row in group]
        yield _line(
            f"`{routes}`",
            f"`{planner}`",
            _percent(np.mean([row.flowtime is not None for row in group])),
            _percent(np.mean([row.flowtime is not None and not row.rerouted for row in group])),
            _spread([row.ratio for row in group]),
            f"{1000 * np.median([row.seconds for row in group]):.0f}",
            f"{np.median(slower):.1f}",
        )


def _against_ours(rows: Sequence[Row], key: Callable[[Row], Any]) -> Iterator[str]:
    """Yield a table of how much later than ours the others are, grouped."""
    heads = (f"`{planner}`" for planner in OTHERS)
    yield from _head("", "fleets", *heads, f"`{OTHERS[0]}`: sooner, same, later")
    for name, group in grouped(rows, key):
        by_planner = {planner: pairs(group, planner) for planner in OTHERS}
        yield _line(
            name,
            str(len(by_planner[OTHERS[0]])),
            *(_later(by_planner[planner]) for planner in OTHERS),
            _outcomes(by_planner[OTHERS[0]]),
        )


def _levels(rows: Sequence[Row]) -> Iterator[str]:
    """Yield a table of what decides in our planner."""
    yield from _head("", "decisions a fleet", *LEVELS)
    for name, group in grouped(rows, lambda row: f"speeds {row.speeds}, {work_of(row)}"):
        decisions = sum(row.decisions for row in group)
        shares = (sum(getattr(row, level) for row in group) / decisions for level in LEVELS)
        yield _line(name, f"{decisions / len(group):.0f}", *map(_percent, shares))


def _only_waiting(rows: Sequence[Row]) -> list[Row]:
    """Return the fleets in which every planner got through without another way for anybody."""
    return [
        row
        for _, group in grouped(rows, lambda row: (fleet_of(row), row.routes))
        if all(row.flowtime is not None and not row.rerouted for row in group)
        for row in group
    ]


def pairs(rows: Iterable[Row], planner: str) -> list[Pair]:
    """Return what a planner and what ours made of each fleet that both solved."""
    solved = {
        (fleet_of(row), row.routes, row.planner): row for row in rows if row.flowtime is not None
    }
    return [
        (row, solved[fleet, routes, OURS])
        for (fleet, routes, name), row in solved.items()
        if name == planner and (fleet, routes, OURS) in solved
    ]


def later(found: Sequence[Pair]) -> tuple[float, float]:
    """Return by which part the other one's flowtime is greater, and how sure that is.

    The geometric mean of the ratio of flowtimes, less one, and two standard errors. Fleets that go
    to the same places under other conditions are not independent: the errors are those of the means
    over such fleets.
    """
    logs = defaultdict(list)
    for other, ours in found:
        logs[other.ground, other.robots, other.seed].append(np.log(other.ratio / ours.ratio))
    means = [np.mean(group) for group in logs.values()]
    spread = np.std(means, ddof=1) / np.sqrt(len(means)) if len(means) > 1 else np.inf
    return float(np.expm1(np.mean(means))), float(2 * spread)


def grouped(rows: Iterable[Row], key: Callable[[Row], Any]) -> Iterator[tuple[Any, list[Row]]]:
    """Yield the rows of each key, keys in the order in which they first come."""
    groups: dict[Any, list[Row]] = defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    yield from groups.items()


def _later(found: Sequence[Pair]) -> str:
    mean, half = later(found)
    percent = round(100 * mean, 1) + 0.0  # no minus before nothing
    return f"{percent:+.1f} ± {100 * half:.1f} %".replace("-", "\N{MINUS SIGN}")


def _outcomes(found: Sequence[Pair]) -> str:
    signs = [np.sign(other.ratio - ours.ratio) for other, ours in found]
    return ", ".join(_percent(signs.count(sign) / len(signs)) for sign in (-1, 0, 1))


def _spread(values: Sequence[float]) -> str:
    low, middle, high = np.quantile(values, (0.25, 0.5, 0.75))
    return f"{middle:.3f} ({low:.3f}\N{EN DASH}{high:.3f})"


def _percent(share: float | np.floating[Any]) -> str:
    return f"{100 * share:.0f} %"


def _head(*cells: str) -> tuple[str, str]:
    return _line(*cells), _line(*["---"] * len(cells))


def _line(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |\n"
