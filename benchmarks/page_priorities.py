"""Tables and plots of docs/results/priorities.md: two-level beside other orders."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from statistics import median
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from benchmarks.common import (
    grouped,
    option,
    percent,
    place_of,
    plain_axes,
    table,
)
from rightofway.bench import Row

OURS = "two-level"
OTHERS = ("fixed-priority", "random-priority", "priority-search")
LEVELS = ("node", "settled", "robot", "only")
ROUTES = ("clear", "shortest")

COLOURS = {
    OURS: "#0072b2", "fixed-priority": "#d55e00", "random-priority": "#e69f00",
    "priority-search": "#009e73",
}  # fmt: skip
"""Of Okabe and Ito, distinct for colour-blind readers too."""

MARKERS = dict(zip((OURS, *OTHERS), "osD^", strict=True))


def case_of(row: Row) -> tuple[Any, ...]:
    """Return the fleet and the routes of a row."""
    return (*place_of(row), row["fleet"], option(row, "routes"))


def floor_of(row: Row) -> str:
    """Return where a fleet drives, and its number of robots."""
    return f"{row['map']}, {row['robots']} robots"


def condition_of(row: Row) -> str:
    """Return speeds and work of a fleet."""
    return str(row["fleet"].rpartition(", ")[0])


def priorities_tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return every table of docs/results/priorities.md by its name in the page."""
    planners = (OURS, *OTHERS)
    rows = sorted(rows, key=lambda row: (option(row, "routes"), planners.index(row["planner"])))

    def by(key: Callable[[Row], str]) -> Callable[[Row], str]:
        return lambda row: f"`{option(row, 'routes')}`" + (f", {key(row)}" if key(row) else "")

    occupancy = by(lambda row: f"`occupancy: {row['fleet'].rpartition(', ')[2]}`")
    waiting = [
        row
        for group in grouped(rows, case_of).values()
        if all(one["solved"] and not rerouted(one) for one in group)
        for row in group
    ]
    return {
        "planners": _planners(rows),
        "routes": _against_ours(rows, by(lambda _: "")),
        "speeds and work": _against_ours(rows, by(condition_of)),
        "occupancy": _against_ours(rows, occupancy),
        "fleets": _against_ours(rows, by(floor_of)),
        "waits only": _against_ours(waiting, by(floor_of)),
        "levels": _levels([row for row in rows if row["planner"] == OURS and row["solved"]]),
    }


def rerouted(row: Row) -> bool:
    """Return whether a robot of a plan was sent another way."""
    return bool(json.loads(row["figures"])["rerouted"])


def _planners(rows: Sequence[Row]) -> str:
    heads = (
        "routes", "planner", "solved", "waits only", "flowtime / lower bound", "time [ms]",
        "time / two-level",
    )  # fmt: skip
    ours = {case_of(row): row for row in rows if row["planner"] == OURS}
    lines = []
    groups = grouped(rows, lambda row: (option(row, "routes"), str(row["planner"])))
    for (routes, planner), group in groups.items():
        solved = [row for row in group if row["solved"]]
        low, middle, high = np.quantile([row["ratio"] for row in solved], (0.25, 0.5, 0.75))
        slower = [row["cpu_seconds"] / ours[case_of(row)]["cpu_seconds"] for row in group]
        lines.append(
            (
                f"`{routes}`",
                f"`{planner}`",
                percent(len(solved) / len(group)),
                percent(sum(not rerouted(row) for row in solved) / len(group)),
                f"{middle:.3f} ({low:.3f}\N{EN DASH}{high:.3f})",
                f"{1000 * median(row['cpu_seconds'] for row in group):.0f}",
                f"{median(slower):.1f}",
            )
        )
    return table(heads, lines)


def _against_ours(rows: Sequence[Row], key: Callable[[Row], str]) -> str:
    """Return a table of how much later than ours the others are, grouped."""
    heads = ("", "fleets", *(f"`{one}`" for one in OTHERS), f"`{OTHERS[0]}`: sooner, same, later")
    lines = []
    for name, group in grouped(rows, key).items():
        found = {planner: pairs(group, planner) for planner in OTHERS}
        first = [np.sign(other["ratio"] - ours["ratio"]) for other, ours in found[OTHERS[0]]]
        outcomes = ", ".join(percent(first.count(sign) / len(first)) for sign in (-1, 0, 1))
        cells = (_later(found[planner]) for planner in OTHERS)
        lines.append((name, str(len(first)), *cells, outcomes))
    return table(heads, lines)


def _levels(rows: Sequence[Row]) -> str:
    """Return a table of the levels that decide in our planner."""
    lines = []
    for name, group in grouped(rows, condition_of).items():
        levels = Counter[str]()
        for row in group:
            levels.update(json.loads(row["figures"])["decisions"])
        shares = (percent(levels[level] / levels.total()) for level in LEVELS)
        lines.append((name, f"{levels.total() / len(group):.0f}", *shares))
    return table(("", "decisions a fleet", *LEVELS), lines)


def pairs(rows: Iterable[Row], planner: str) -> list[tuple[Row, Row]]:
    """Return the rows of a planner and of ours for each fleet that both solved."""
    solved = {(case_of(row), row["planner"]): row for row in rows if row["solved"]}
    return [
        (row, solved[case, OURS])
        for (case, name), row in solved.items()
        if name == planner and (case, OURS) in solved
    ]


def later(found: Sequence[tuple[Row, Row]]) -> tuple[float, float]:
    """Return by which part the other one's flowtime is greater, and two standard errors.

    The geometric mean of the ratio of flowtimes, less one. Fleets that go to the same places under
    other conditions are not independent: the errors are those of the means over such fleets.
    """
    places = grouped(found, lambda pair: place_of(pair[0]))
    means = [
        np.mean([np.log(other["ratio"] / ours["ratio"]) for other, ours in group])
        for group in places.values()
    ]
    spread = np.std(means, ddof=1) / np.sqrt(len(means)) if len(means) > 1 else np.inf
    return float(np.expm1(np.mean(means))), float(2 * spread)


def _later(found: Sequence[tuple[Row, Row]]) -> str:
    mean, half = later(found)
    shown = round(100 * mean, 1) + 0.0  # no minus before nothing
    return f"{shown:+.1f} ± {100 * half:.1f} %".replace("-", "\N{MINUS SIGN}")


def priorities_plots(rows: Sequence[Row]) -> Iterator[tuple[str, Figure]]:
    """Yield the plots of docs/results/priorities.md, a panel for each kind of routes."""
    plots: dict[str, tuple[Callable[[Axes, list[Row]], None], str]] = {
        "priorities-ratio": (_draw_ratios, "flowtime / lower bound"),
        "priorities-conditions": (_draw_later, "flowtime above that of two-level [%]"),
        "priorities-time": (_draw_times, "processor time of a plan [ms]"),
    }
    for name, (draw, label) in plots.items():
        figure = Figure(figsize=(8, 6.4), layout="constrained")
        panels = figure.subplots(len(ROUTES), 1, sharex=True, sharey=True)
        for axes, routes in zip(panels, ROUTES, strict=True):
            draw(axes, [row for row in rows if option(row, "routes") == routes and row["solved"]])
            axes.set_title(f"routes={routes}", loc="left", fontsize=10)
            axes.set_ylabel(label)
            plain_axes(axes, grid="y")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=4, frameon=False)
        yield name, figure


def _draw_ratios(axes: Axes, rows: list[Row]) -> None:
    """Draw median, quartiles, and 5 % to 95 % of the ratios, for each fleet and planner."""
    groups = grouped(rows, floor_of)
    for number, planner in enumerate(MARKERS):
        boxes = axes.boxplot(
            [
                [row["ratio"] for row in group if row["planner"] == planner]
                for group in groups.values()
            ],
            positions=_beside(len(groups), number, len(MARKERS)),
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
    _name_groups(axes, groups)


def _draw_later(axes: Axes, rows: list[Row]) -> None:
    """Draw how much later the others are, by speeds and work, and two standard errors."""
    groups = grouped(rows, condition_of)
    axes.axhline(0, color=COLOURS[OURS], linewidth=1.5, label=OURS)
    for number, planner in enumerate(OTHERS):
        found = [later(pairs(group, planner)) for group in groups.values()]
        means, halves = (100 * np.array(each) for each in zip(*found, strict=True))
        _draw_points(axes, planner, _beside(len(groups), number, len(OTHERS)), means, halves)
    _name_groups(axes, groups)


def _draw_times(axes: Axes, rows: list[Row]) -> None:
    """Draw medians and quartiles of the time, for each fleet and planner."""
    groups = grouped(rows, floor_of)
    for number, planner in enumerate(MARKERS):
        times = [
            1000 * np.quantile(
                [row["cpu_seconds"] for row in group if row["planner"] == planner],
                (0.25, 0.5, 0.75),
            )
            for group in groups.values()
        ]  # fmt: skip
        low, middle, high = np.array(times).T
        errors = np.array([middle - low, high - middle])
        _draw_points(axes, planner, _beside(len(groups), number, len(MARKERS)), middle, errors)
    axes.set_yscale("log")
    _name_groups(axes, groups)


def _draw_points(axes: Axes, planner: str, x: list[float], y: Any, errors: Any) -> None:
    axes.errorbar(
        x, y, errors, fmt=MARKERS[planner], color=COLOURS[planner], label=planner, capsize=3,
        markersize=5,
    )  # fmt: skip


def _beside(groups: int, number: int, of: int) -> list[float]:
    """Return where one of several series stands in each group."""
    return [group + 0.2 * (number - (of - 1) / 2) for group in range(groups)]


def _name_groups(axes: Axes, groups: Mapping[str, Any]) -> None:
    axes.set_xticks(range(len(groups)), [name.replace(", ", ",\n") for name in groups])
    axes.set_xlim(-0.5, len(groups) - 0.5)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
