"""The plots of the page on laps: the paper's two cases, and what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count, takewhile
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.laps_page import RULES, in_laps, repeats
from benchmarks.laps_rows import FLEETS, Row
from rightofway.cyclic import run_laps
from tests.builders.fleets import PAPER, paper_scenario

IMAGES = Path(__file__).parents[1] / "docs" / "images"

COLOURS = dict(zip(RULES, ("#0072b2", "#d55e00", "#009e73"), strict=True))
"""Told apart by everybody (Okabe and Ito)."""

CASES = ("door-2", "cross-2")

LEAST = 0.1
"""Where shorter times are drawn, nothing too."""


def draw_all(rows: Sequence[Row], folder: Path = IMAGES) -> None:
    """Write all plots."""
    mpl.rcParams.update({"font.size": 9, "svg.hashsalt": "rightofway", "axes.axisbelow": True})
    for name in CASES:
        _save(_first_laps(name), folder / f"laps-{name}.png")
    _save(_how_long(rows), folder / "laps-how-long.png")


def _save(figure: Figure, path: Path) -> None:
    figure.savefig(path, dpi=120, metadata={"Software": None})


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
    for robot, route in enumerate(group.context.routes):
        visits = list(takewhile(lambda v: pattern.enter(robot, v) <= until, count()))  # noqa: B023
        enter = [pattern.enter(robot, visit) for visit in visits]
        places = [visit % len(route) for visit in visits]
        label, colour = run.scenario.robots[route.robot].name, list(COLOURS.values())[robot]
        axes.step(enter, places, where="post", label=label, color=colour)
        for visit, begins, leaves in zip(visits, enter, enter[1:], strict=False):
            ready = begins + route.least(visit)
            axes.plot([ready, leaves], [visit % len(route)] * 2, color=colour, linewidth=4)
    for tick in (pattern.begins, pattern.begins + pattern.period, until):
        axes.axvline(tick, color="#888888", linestyle=":")
    axes.set_xlabel("time [ticks]; thick: waits; dotted: a period begins")
    axes.set_ylabel("visits since home")
    figure.legend(frameon=False, loc="outside upper center", ncols=2)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def _how_long(rows: Sequence[Row]) -> Figure:
    """Return what part of the groups has a transient, or a period, of at most so many laps."""
    figure = Figure(figsize=(8, 5.4), layout="constrained")
    panels = figure.subplots(2, len(FLEETS), sharey=True, sharex="row")
    for column, (size, robots) in enumerate(FLEETS):
        mine = [row for row in rows if (row.size, row.robots) == (size, robots)]
        for axes, key in zip(panels[:, column], ("transient", "period"), strict=True):
            _cumulate(axes, mine, key)
            axes.set_xlabel(f"{key} [laps of the slowest robot]")
        panels[0, column].set_title(f"{robots} robots, {size} x {size}", loc="left", fontsize=10)
    for axes in panels[:, 0]:
        axes.set_ylabel("part of the groups")
    handles, names = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=3, frameon=False)
    return figure


def _cumulate(axes: Axes, rows: Sequence[Row], key: str) -> None:
    for rule, colour in COLOURS.items():
        mine = [row for row in rows if row.rule == rule]
        laps = sorted(in_laps(row, getattr(row, key)) for row in repeats(mine))
        parts = np.arange(1, len(laps) + 1) / max(len(mine), 1)
        axes.step(
            [max(value, 0.1) for value in laps], parts, where="post", label=rule, color=colour
        )
    axes.set_xscale("log")
    axes.set_ylim(0, 1.02)
    axes.grid(visible=True, color="#dddddd")
    axes.spines[["top", "right"]].set_visible(False)
