"""Tables and plots of the documentation, from the results of the suites.

``python -m benchmarks.pages priorities build/priorities.csv build/priorities_aisles.csv`` writes
docs/priorities.md, ``laps build/cyclic.csv`` docs/laps.md, ``timetables build/timetables.csv`` the
table of README.md beside this file.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, pairwise, takewhile
from statistics import median
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from benchmarks.common import (
    DOCS,
    IMAGES,
    README,
    grouped,
    percent,
    plain_axes,
    save_figure,
    table,
    write_tables,
)
from rightofway.bench import Results, Row
from rightofway.cyclic import CyclicResult, LapWait, run_laps
from tests.builders.fleets import PAPER, paper_scenario

OURS = "two-level"
OTHERS = ("fixed-priority", "random-priority", "priority-search")
LEVELS = ("node", "settled", "robot", "only")
ROUTES = ("clear", "shortest")
RULES = ("first-come", "fixed-order", "two-level")

COLOURS = {
    OURS: "#0072b2", "fixed-priority": "#d55e00", "random-priority": "#e69f00",
    "priority-search": "#009e73", "first-come": "#0072b2", "fixed-order": "#d55e00",
}  # fmt: skip
"""Of Okabe and Ito, distinct for colour-blind readers too."""

MARKERS = dict(zip((OURS, *OTHERS), "osD^", strict=True))


def option(row: Row, name: str) -> str:
    """Return the value of an option of the planner of a row."""
    options: dict[str, str] = dict(each.split("=", 1) for each in row["options"].split())
    return options[name]


# Priorities ------------------------------------------------------------------------------------


def place_of(row: Row) -> tuple[Any, ...]:
    """Return what draws homes and targets; other speeds, work and rules go to the same places."""
    return row["map"], row["scen"], row["robots"], row["seed"]


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
    """Return every table of docs/priorities.md by its name in the page."""
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
    """Yield the plots of docs/priorities.md, a panel for each kind of routes."""
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


# Laps ------------------------------------------------------------------------------------------


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
    """Return every table of docs/laps.md by its name in the page."""
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
            ["never home" if mean is None else str(mean) for mean in one.groups[0].mean_laps()]
            for one in runs
        )
        lines.append(
            (
                case["name"],
                ", ".join(str(lap.duration) for lap in group.context.laps),
                str(pattern.transient),
                str(pattern.period),
                ", ".join(map(str, pattern.counts)),
                _waits(run, group.first_waits()),
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
    """Yield the plots of docs/laps.md."""
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
            ready = begins + route.least(visit)
            axes.plot([ready, leaves], [places[visit]] * 2, color=colour, linewidth=4)
    for tick in (pattern.begins, pattern.begins + pattern.period, until):
        axes.axvline(tick, color="#888888", linestyle=":")
    axes.set_xlabel("time [ticks]; thick: waits; dotted: a period begins")
    axes.set_ylabel("visits since home")
    figure.legend(frameon=False, loc="outside upper center", ncols=2)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def timetable_tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return the table of README.md: laps under a chosen timetable by those under each rule."""
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


def read(paths: Iterable[str]) -> list[Row]:
    """Return the rows of files of results."""
    rows: list[Row] = []
    for path in paths:
        with Results(path) as results:
            rows += results.rows.values()
    return rows


def main(page: str, *paths: str) -> None:
    """Write the tables and plots of a page."""
    rows = read(paths)
    if page == "timetables":
        write_tables(README, "timetables", timetable_tables(rows))
        return
    tables, plots = {
        "priorities": (priorities_tables, priorities_plots),
        "laps": (laps_tables, laps_plots),
    }[page]
    write_tables(DOCS / f"{page}.md", "table", tables(rows))
    for name, figure in plots(rows):
        save_figure(figure, IMAGES / f"{name}.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
