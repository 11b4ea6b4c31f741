"""Rows of results, grouped and summarised."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rightofway.bench.results import Row


@dataclass(frozen=True, slots=True)
class Quartiles:
    """Median and quartiles of some numbers."""

    first_quartile: float
    median: float
    third_quartile: float

    @classmethod
    def of(cls, values: Iterable[float | None]) -> Quartiles | None:
        """Return those of the known values, or None if there is none."""
        known = [value for value in values if value is not None]
        return cls(*map(float, np.percentile(known, [25, 50, 75]))) if known else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """A summary of some rows.

    Attributes
    ----------
    cases, solved
        Numbers of cases, and of solved cases.
    ratio
        Flowtime / lower bound of the solved ones.
    seconds
        Until the first plan of the solved ones [s].
    memory
        The most memory that one of them held [MB].
    statuses
        Number of cases with each status.
    """

    cases: int
    solved: int
    ratio: Quartiles | None
    seconds: Quartiles | None
    memory: float | None
    statuses: Mapping[str, int]

    @classmethod
    def of(cls, rows: Sequence[Row]) -> Group:
        """Summarise rows."""
        memory = (row["peak_memory"] for row in rows if row["peak_memory"] is not None)
        return cls(
            cases=len(rows),
            solved=sum(row["solved"] for row in rows),
            ratio=Quartiles.of(row["ratio"] for row in rows if row["solved"]),
            seconds=Quartiles.of(row["first_plan_seconds"] for row in rows),
            memory=max(memory, default=None),
            statuses=dict(Counter(row["status"] for row in rows)),
        )


def group_rows(rows: Iterable[Row], *keys: str) -> dict[tuple[Any, ...], list[Row]]:
    """Return the rows that agree in some columns, in the order of their first."""
    groups: dict[tuple[Any, ...], list[Row]] = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def name_planners(rows: Iterable[Row]) -> dict[str, str]:
    """Return a name for the planner of each row, by the row's key.

    Options are part of the name where they differ between runs of the planner, and so is the time
    limit where it differs.
    """
    variants = group_rows(rows, "planner", "options", "limit")
    common: dict[str, set[str]] = {}
    for planner, options, _ in variants:
        common[planner] = common.get(planner, set(options.split())) & set(options.split())
    has_limits = len({limit for _, _, limit in variants}) > 1
    names = {}
    for (planner, options, limit), variant in variants.items():
        own = [option for option in options.split() if option not in common[planner]]
        name = " ".join([planner, *own, *[f"({limit:g} s)"] * has_limits])
        names.update({row["key"]: name for row in variant})
    return names


def group_by_planner(
    rows: Sequence[Row], names: Mapping[str, str] | None = None
) -> dict[str, list[Row]]:
    """Return the rows of each planner; names are those among all rows, if these are only some.

    Parameters
    ----------
    rows
        Results of cases.
    names
        Name of each planner with its options; None to make names from the rows.
    """
    names = names or name_planners(rows)
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(names[row["key"]], []).append(row)
    return groups


def group_by_robots(rows: Iterable[Row]) -> dict[int, Group]:
    """Return the groups of equal numbers of robots, the smallest first."""
    groups = group_rows(rows, "robots")
    return {robots: Group.of(group) for (robots,), group in sorted(groups.items())}
