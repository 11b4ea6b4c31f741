"""The plots of the page on priorities, from what was measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from benchmarks.priorities_page import OTHERS, OURS, ground_of, grouped, later, pairs, work_of
from benchmarks.priorities_rows import Row

IMAGES = Path(__file__).parents[1] / "docs" / "images"

COLOURS = dict(zip((OURS, *OTHERS), ("#0072b2", "#d55e00", "#e69f00", "#009e73"), strict=True))
"""Told apart by everybody (Okabe and Ito)."""

MARKERS = dict(zip((OURS, *OTHERS), "osD^", strict=True))

ROUTES = ("clear", "shortest")
QUARTILES = (0.25, 0.5, 0.75)


def draw_all(rows: Sequence[Row], folder: Path = IMAGES) -> None:
    """Write all plots."""
    mpl.rcParams.update({"font.size": 9, "svg.hashsalt": "rightofway", "axes.axisbelow": True})
    plots = {
        "priorities-ratio": (_ratio_boxes, "flowtime / lower bound"),
        "priorities-conditions": (_later_by_conditions, "flowtime above that of two-level [%]"),
        "priorities-time": (_times, "processor time of a plan [ms]"),
    }
    for name, (draw, label) in plots.items():
        figure = _panels(rows, draw, label)
        figure.savefig(folder / f"{name}.png", dpi=120, metadata={"Software": None})


def _panels(rows: Sequence[Row], draw: Callable[[Axes, Sequence[Row]], None], label: str) -> Figure:
    """Return a figure with a panel for each kind of routes, one above the other."""
    figure = Figure(figsize=(8, 6.4), layout="constrained")
    panels = figure.subplots(len(ROUTES), 1, sharex=True, sharey=True)
    for axes, routes in zip(panels, ROUTES, strict=True):
        draw(axes, [row for row in rows if row.routes == routes and row.flowtime is not None])
        axes.set_title(f"routes={routes}", loc="left", fontsize=10)
        axes.set_ylabel(label)
        axes.grid(visible=True, axis="y", color="#dddddd")
        axes.spines[["top", "right"]].set_visible(False)
    handles, names = panels[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=4, frameon=False)
    return figure


def _ratio_boxes(axes: Axes, rows: Sequence[Row]) -> None:
    """Draw median, quartiles, and 5 % to 95 % of the ratios, for each fleet and planner."""
    groups = list(grouped(rows, ground_of))
    for number, planner in enumerate(COLOURS):
        boxes = axes.boxplot(
            [[row.ratio for row in group if row.planner == planner] for _, group in groups],
            positions=_beside(len(groups), number, len(COLOURS)),
            widths=0.17,
            whis=(5, 95),
            showfliers=False,
            patch_artist=True,
            medianprops={"color": "black"},
            boxprops={"facecolor": COLOURS[planner], "edgecolor": "#333333", "linewidth": 0.6},
            manage_ticks=False,
        )
        boxes["boxes"][0].set_label(planner)
    axes.set_yscale("log")
    axes.set_yticks([1, 1.2, 1.5, 2, 3], minor=False)
    axes.set_yticks([], minor=True)
    _plain_numbers(axes)
    _name_groups(axes, [name.replace(", ", ",\n") for name, _ in groups])


def _later_by_conditions(axes: Axes, rows: Sequence[Row]) -> None:
    """Draw how much later the others are, by speeds and work, and two standard errors."""
    groups = list(grouped(rows, lambda row: f"speeds {row.speeds},\n{work_of(row)}"))
    axes.axhline(0, color=COLOURS[OURS], linewidth=1.5, label=OURS)
    for number, planner in enumerate(OTHERS):
        found = [later(pairs(group, planner)) for _, group in groups]
        axes.errorbar(
            _beside(len(groups), number, len(OTHERS)),
            [100 * mean for mean, _ in found],
            [100 * half for _, half in found],
            **_points(planner),
        )
    _name_groups(axes, [name for name, _ in groups])


def _times(axes: Axes, rows: Sequence[Row]) -> None:
    """Draw medians and quartiles of the time, for each fleet and planner."""
    groups = list(grouped(rows, ground_of))
    for number, planner in enumerate(COLOURS):
        times = [
            1000 * np.quantile([row.seconds for row in group if row.planner == planner], QUARTILES)
            for _, group in groups
        ]
        low, middle, high = np.array(times).T
        axes.errorbar(
            _beside(len(groups), number, len(COLOURS)),
            middle,
            [middle - low, high - middle],
            **_points(planner),
        )
    axes.set_yscale("log")
    _plain_numbers(axes)
    _name_groups(axes, [name.replace(", ", ",\n") for name, _ in groups])


def _points(planner: str) -> dict[str, Any]:
    return {
        "fmt": MARKERS[planner],
        "color": COLOURS[planner],
        "label": planner,
        "capsize": 3,
        "markersize": 5,
    }


def _beside(groups: int, number: int, of: int) -> list[float]:
    """Return where one of several series stands in each group."""
    return [group + 0.2 * (number - (of - 1) / 2) for group in range(groups)]


def _name_groups(axes: Axes, names: Sequence[str]) -> None:
    axes.set_xticks(range(len(names)), names)
    axes.set_xlim(-0.5, len(names) - 0.5)


def _plain_numbers(axes: Axes) -> None:
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
