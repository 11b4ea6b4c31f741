"""Tables and plots of docs/results/second-lap.md: work that repeats, under each rule."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, pairwise, takewhile
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from benchmarks.common import (
    grouped,
    option,
    percent,
    plain_axes,
    table,
)
from rightofway.bench import Row
from rightofway.cyclic import CyclicResult, LapWait, run_laps
from tests.builders.fleets import PAPER, paper_scenario

RULES = ("first-come", "fixed-order", "two-level")

COLOURS = {"first-come": "#0072b2", "fixed-order": "#d55e00", "two-level": "#0072b2"}
"""Of Okabe and Ito, distinct for colour-blind readers too."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """The figures of a group of at least two robots under a rule."""

    fleet: str
    rule: str
    figures: Mapping[str, Any]

    @property
    def repeats(self) -> bool:
        """Whether its pattern is known."""
        return bool(self.figures["ends"] == "repeats")

    def in_laps(self, key: str) -> float:
        """Return a time in laps of the slowest robot of the group, driving alone."""
        return float(self.figures[key] / self.figures["longest_lap"])


def groups_of(rows: Sequence[Row]) -> list[Group]:
    """Return the groups of all fleets."""
    return [
        Group(
            fleet=f"{row['robots']} robots, {row['map']}, {row['fleet']}",
            rule=option(row, "rule"),
            figures=figures,
        )
        for row in rows
        for figures in json.loads(row["figures"] or '{"groups": []}')["groups"]
        if figures["robots"] > 1
    ]


def laps_tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return every table of docs/results/second-lap.md by its name in the page."""
    kinds = grouped(groups_of(rows), lambda one: (one.fleet, one.rule))
    how_long, where = [], []
    for fleet, rule in sorted(
        kinds, key=lambda kind: (int(kind[0].split()[0]), kind[0], RULES.index(kind[1]))
    ):
        groups = kinds[fleet, rule]
        repeating = [one for one in groups if one.repeats]
        shares = (
            [one.figures["ends"] == end for one in groups]
            for end in ("repeats", "deadlock", "open")
        )
        starves = [one.figures["starves"] > 0 for one in repeating]
        times = ([one.in_laps(key) for one in repeating] for key in ("transient", "period"))
        how_long.append(
            (
                fleet, f"`{rule}`", str(len(groups)), *map(_mean_percent, shares),
                _mean_percent(starves), *map(_median_and_most, times),
            )
        )  # fmt: skip
        first, steady, common = (
            np.array([one.figures[key] for one in repeating], float)
            for key in ("first_waits", "steady_waits", "common_waits")
        )
        waiting = [
            one.figures["waiting"] for one in repeating if one.figures["waiting"] is not None
        ]
        where.append(
            (
                fleet, f"`{rule}`", _mean(first), _mean(steady), _share(common, first),
                _share(steady - common, steady), _mean_percent((steady == 0).tolist()),
                _mean_percent(waiting),
            )
        )  # fmt: skip
    return {
        "paper": paper_table(),
        "how long": table(
            (
                "fleet", "rule", "groups", "repeat", "standstill", "open", "a robot starves",
                "transient [laps]", "period [laps]",
            ), how_long,
        ),
        "where": table(
            (
                "fleet", "rule", "pairs and places in first laps", "in each period",
                "first ones that repeat", "periodic ones that are new", "no wait at all",
                "waiting",
            ), where,
        ),
    }  # fmt: skip


def _mean(values: Any) -> str:
    return f"{values.mean():.1f}" if len(values) else "—"


def _median_and_most(values: Sequence[float]) -> str:
    if not values:
        return "—"
    middle, most = np.quantile(values, (0.5, 0.9))
    return f"{middle:.1f} ({most:.1f})"


def _share(part: Any, whole: Any) -> str:
    return percent(part.sum() / whole.sum()) if whole.sum() else "—"


def _mean_percent(claims: Sequence[float]) -> str:
    return percent(float(np.mean(claims))) if len(claims) else "—"


def paper_table() -> str:
    """Return what becomes of the paper's cases on its own routes."""
    heads = (
        "case", "laps alone", "from", "period", "laps", "waits in the first laps",
        "waits in each period", *(f"mean laps, `{rule}`" for rule in RULES),
    )  # fmt: skip
    lines = []
    for case in PAPER:
        runs = [run_laps(paper_scenario(case), rule, routes="shortest") for rule in RULES]
        run, group = runs[0], runs[0].groups[0]
        pattern = group.pattern
        assert pattern is not None, "every case repeats"
        means = (
            [
                "never home" if mean is None else str(mean)
                for mean in one.groups[0].compute_mean_laps()
            ]
            for one in runs
        )
        lines.append(
            (
                case["name"],
                ", ".join(str(lap.duration) for lap in group.context.laps),
                str(pattern.transient),
                str(pattern.period),
                ", ".join(map(str, pattern.counts)),
                _waits(run, group.list_first_waits()),
                _waits(run, group.waits()),
                *map(", ".join, means),
            )
        )
    return table(heads, lines)


def _waits(run: CyclicResult, waits: Sequence[LapWait]) -> str:
    name, robots = run.scenario.roadmap.name, run.scenario.robots
    counts = Counter(f"{robots[one.waits].name} for {name(one.vertex)}" for one in waits)
    times = (f"{wait}, {n} times" if n > 1 else wait for wait, n in counts.items())
    return "; ".join(times) or "none"


def laps_plots(rows: Sequence[Row]) -> Iterator[tuple[str, Figure]]:
    """Yield the plots of docs/results/second-lap.md."""
    for name in ("door-2", "cross-2"):
        yield f"laps-{name}", _first_laps(name)
    figure = Figure(figsize=(8, 5.4), layout="constrained")
    floors = grouped(groups_of(rows), lambda one: one.fleet.rpartition(", ")[0])
    panels = figure.subplots(2, len(floors), sharey=True, sharex="row", squeeze=False)
    for column, (floor, groups) in enumerate(floors.items()):
        for axes, key in zip(panels[:, column], ("transient", "period"), strict=True):
            for rule, mine in grouped(groups, lambda one: one.rule).items():
                laps = sorted(max(one.in_laps(key), 0.1) for one in mine if one.repeats)
                parts = np.arange(1, len(laps) + 1) / len(mine)
                axes.step(laps, parts, where="post", label=rule, color=COLOURS[rule])
            axes.set(xscale="log", ylim=(0, 1.02))
            axes.set_xlabel(f"{key} [laps of the slowest robot]")
            plain_axes(axes)
        panels[0, column].set_title(floor, loc="left", fontsize=10)
    for axes in panels[:, 0]:
        axes.set_ylabel("part of the groups")
    handles, names = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=3, frameon=False)
    yield "laps-how-long", figure


def _first_laps(name: str) -> Figure:
    """Return how far each robot is on its lap, over time, and where it waits."""
    case = next(case for case in PAPER if case["name"] == name)
    run = run_laps(paper_scenario(case), routes="shortest")
    group = run.groups[0]
    pattern = group.pattern
    assert pattern is not None, "every case of the paper repeats"
    figure = Figure(figsize=(8, 2.6), layout="constrained")
    axes = figure.subplots()
    until = pattern.begins + 2 * pattern.period
    for robot, (route, colour) in enumerate(
        zip(group.context.routes, ("#0072b2", "#d55e00"), strict=True)
    ):
        times = (pattern.enter(robot, visit) for visit in count())
        enter = list(takewhile(lambda tick: tick <= until, times))
        places = [visit % len(route) for visit in range(len(enter))]
        label = run.scenario.robots[route.robot].name
        axes.step(enter, places, where="post", label=label, color=colour)
        for visit, (begins, leaves) in enumerate(pairwise(enter)):
            ready = begins + route.compute_least(visit)
            axes.plot([ready, leaves], [places[visit]] * 2, color=colour, linewidth=4)
    for tick in (pattern.begins, pattern.begins + pattern.period, until):
        axes.axvline(tick, color="#888888", linestyle=":")
    axes.set_xlabel("time [ticks]; thick: waits; dotted: a period begins")
    axes.set_ylabel("visits since home")
    figure.legend(frameon=False, loc="outside upper center", ncols=2)
    axes.spines[["top", "right"]].set_visible(False)
    return figure
