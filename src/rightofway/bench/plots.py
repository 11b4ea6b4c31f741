"""Pictures of results, drawn by matplotlib."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from rightofway.bench.extras import needed
from rightofway.bench.results import Row
from rightofway.bench.summary import Group, by_planner, by_robots, grouped, planner_names

__all__ = ["cactus_plot", "ratio_plot"]

Format = Literal["svg", "png"]

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
"""The palette of Okabe and Ito, distinct for colour-blind readers too."""

MARKERS = "osD^vPX"

STYLE = {
    "svg.hashsalt": "rightofway",  # the same rows, the same bytes
    "svg.fonttype": "none",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "axes.axisbelow": True,
    "legend.frameon": False,
}

LEAST_SECONDS = 0.001
"""Shorter times are drawn as this one, since a logarithmic axis has no 0."""


def cactus_plot(rows: Sequence[Row], form: Format) -> bytes:
    """Draw how many cases each planner has solved after how many seconds."""
    with needed("matplotlib", "a report").rc_context(STYLE):
        figure = _figure(7, 4.2)
        axes = figure.add_subplot()
        planners = by_planner(rows)
        for index, (name, each) in enumerate(planners.items()):
            seconds, solved = _solved_over_time(each)
            axes.step(seconds, solved, where="post", label=name, **_look(index))
        most = max(map(len, planners.values()))
        axes.axhline(most, color="#888888", linestyle=":", linewidth=1)
        axes.set(
            xscale="log",
            xlabel="time to the first plan [s]",
            ylabel=f"solved cases, of {most}",
            ylim=(0, 1.05 * most),
        )
        axes.legend(loc="lower right")
        return _saved(figure, form)


def _solved_over_time(rows: Sequence[Row]) -> tuple[list[float], list[int]]:
    # Laps have no first plan: they are known at the end.
    known = (row["first_plan_seconds"] or row["wall_seconds"] for row in rows if row["solved"])
    seconds = sorted(known)
    shown = [max(second, LEAST_SECONDS) for second in seconds]
    end = max([*shown, *(row["limit"] for row in rows)])
    return [*shown, end], [*range(1, len(shown) + 1), len(shown)]


def ratio_plot(rows: Sequence[Row], form: Format) -> bytes:
    """Draw flowtime / lower bound by number of robots: medians and quartiles, a part for each map.

    Medians are of solved cases; where others are not solved the marker is hollow.
    """
    parts, names = grouped(rows, "map", "fleet"), planner_names(rows)
    planners = list(dict.fromkeys(names.values()))
    columns = min(3, len(parts))
    lines = math.ceil(len(parts) / columns)
    with needed("matplotlib", "a report").rc_context(STYLE):
        figure = _figure(1.2 + 3.6 * columns, 0.6 + 3 * lines)
        grid = figure.subplots(lines, columns, squeeze=False)
        for axes in grid.flat[len(parts) :]:
            axes.remove()
        for axes, (title, part) in zip(grid.flat, parts.items(), strict=False):
            axes.set_title(", ".join(filter(None, title)), fontsize="medium")
            _draw_part(axes, by_planner(part, names), planners)
        figure.supxlabel("robots", fontsize="medium")
        figure.supylabel("flowtime / lower bound", fontsize="medium")
        lines_of, labels = grid.flat[0].get_legend_handles_labels()
        figure.legend(lines_of, labels, loc="outside upper center", ncols=min(3, len(labels)))
        return _saved(figure, form)


def _draw_part(axes: Any, rows: Mapping[str, Sequence[Row]], planners: Sequence[str]) -> None:
    for index, name in enumerate(planners):
        groups = by_robots(rows.get(name, []))
        _draw_planner(axes, groups, name, index, _beside(index, len(planners)))
    counts = sorted({row["robots"] for each in rows.values() for row in each})
    axes.set(xscale="log", xlim=(counts[0] / 1.3, counts[-1] * 1.3))
    axes.set_xticks(counts, [str(count) for count in counts])
    axes.minorticks_off()
    axes.margins(y=0.1)
    axes.axhline(1, color="#888888", linestyle=":", linewidth=1)


def _beside(index: int, planners: int) -> float:
    """Return the factor that keeps the spreads of planners from covering each other."""
    return float(1.02 ** (index - (planners - 1) / 2))


def _draw_planner(axes: Any, groups: dict[int, Group], name: str, index: int, shift: float) -> None:
    look, marker = _look(index), MARKERS[index % len(MARKERS)]
    known = [(robots * shift, group, group.ratio) for robots, group in groups.items()]
    points = [(x, group, ratio) for x, group, ratio in known if ratio]
    axes.plot([], [], marker=marker, label=name, **look)
    axes.plot([x for x, _, _ in points], [ratio.median for _, _, ratio in points], **look)
    for x, group, ratio in points:
        spread = [[ratio.median - ratio.first_quartile], [ratio.third_quartile - ratio.median]]
        is_whole = group.solved == group.cases
        axes.errorbar(
            [x], [ratio.median], yerr=spread, marker=marker, capsize=2,
            markerfacecolor=look["color"] if is_whole else "white", **look,
        )  # fmt: skip


def _look(index: int) -> dict[str, Any]:
    return {"color": COLOURS[index % len(COLOURS)], "linewidth": 1.6}


def _figure(width: float, height: float) -> Any:
    figure = needed("matplotlib.figure", "a report")
    return figure.Figure(figsize=(width, height), layout="constrained")


def _saved(figure: Any, form: Format) -> bytes:
    content = io.BytesIO()
    metadata = {"Date": None} if form == "svg" else {}
    figure.savefig(content, format=form, dpi=150, metadata=metadata)
    return content.getvalue()
