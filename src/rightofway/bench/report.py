"""A report on results: solved cases, times, quality and sizes of fleets; a page or Markdown."""

from __future__ import annotations

import base64
import html
import io
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

from rightofway.bench.fleet_sizes import FleetSizes, compare_fleet_sizes
from rightofway.bench.results import Row
from rightofway.bench.shifts import SHIFT
from rightofway.bench.summary import (
    Group,
    Quartiles,
    group_by_planner,
    group_by_robots,
    group_rows,
    name_planners,
)
from rightofway.errors import InputError
from rightofway.extras import load_library
from rightofway.files import write_whole

Table = list[Sequence[str]]
"""Rows of cells; the first has the headings."""

CACTUS = "Solved cases over time: the more to the left and the higher, the better."
RATIOS = (
    "Flowtime / lower bound by number of robots: median and quartiles of the solved cases;"
    " 1 cannot be beaten. Hollow markers: some cases are not solved, and those tend to be the hard"
    " ones."
)
FLEETS = (
    "Throughput, service times and jobs in time by number of robots: medians over the shifts of a"
    " fleet, and the least share in time. Dashed: the time within which 95 % of jobs are done."
)
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem;
        color: #222; background: #fff; }}
table {{ border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .2rem .8rem; border-bottom: 1px solid #ddd; text-align: left; }}
figure {{ margin: 2rem 0; }}
img {{ max-width: 100%; }}
</style>
<h1>{title}</h1>
{body}
"""

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


def write_report(
    rows: Sequence[Row], path: Path | str, title: str, *, in_time: Fraction | None = None
) -> None:
    """Write a report.

    Parameters
    ----------
    rows
        The results.
    path
        ``.html`` for one file that holds its pictures; ``.md`` for Markdown, with pictures in the
        same folder, ``-cactus.png``, ``-ratio.png`` and ``-fleets.png`` behind its name.
    title
        Heading of the report.
    in_time
        The share of jobs in time for which the report names the smallest fleet; None for none.

    Raises
    ------
    InputError
        If there are no rows, matplotlib is missing or a file cannot be written.
    """
    path = Path(path)
    if not rows:
        raise InputError.at("", "there is no row to report on (run some cases)", str(path))
    is_page = path.suffix.lower() != ".md"
    table, paragraph = (
        (_make_html_table, _make_html_paragraph) if is_page else (make_markdown_table, str)
    )
    parts = []
    for part in _list_parts(rows, in_time):
        if isinstance(part, str):
            parts.append(paragraph(part))
        elif isinstance(part, _Picture):
            parts += _place_picture(part, path, is_page=is_page)
        else:
            parts.append(table(part))
    if is_page:
        content = PAGE.format(title=html.escape(title), body="\n".join(parts))
    else:
        content = "\n\n".join([f"# {title}", *parts]) + "\n"
    write_whole(path, content)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Picture:
    """A plot with a caption that begins with its name."""

    name: str
    caption: str
    draw: Callable[[Any], None]


def _list_parts(rows: Sequence[Row], in_time: Fraction | None) -> Iterator[str | Table | _Picture]:
    planned, shifts = [row for row in rows if row["planner"] != SHIFT], compare_fleet_sizes(rows)
    if planned:
        yield _make_planner_table(planned)
        yield _Picture(name="cactus", caption=CACTUS, draw=partial(_draw_cactus, planned))
        yield _Picture(name="ratio", caption=RATIOS, draw=partial(_draw_ratios, planned))
        yield _make_detail_table(planned)
    if shifts:
        yield _Picture(name="fleets", caption=FLEETS, draw=partial(_draw_fleet_sizes, shifts))
    for sizes in shifts:
        yield sizes.title
        yield sizes.list_cells()
        if in_time is not None:
            yield sizes.describe_least(in_time)
    yield from _list_machines(rows)


def _place_picture(picture: _Picture, path: Path, *, is_page: bool) -> list[str]:
    """Return a picture as a part of a page, or write it beside a file of Markdown."""
    words, alt = picture.caption, picture.caption.partition(":")[0]
    content = _draw_picture(picture.draw, "svg" if is_page else "png")
    if is_page:
        # Each an image of its own, so that the pictures share no names.
        source = f"data:image/svg+xml;base64,{base64.b64encode(content).decode()}"
        caption = f"<figcaption>{html.escape(words)}</figcaption>"
        return [f'<figure><img alt="{alt}" src="{source}">{caption}</figure>']
    file = f"{path.stem}-{picture.name}.png"
    write_whole(path.with_name(file), content)
    return [f"![{alt}]({file})", words]


FIGURES = ("solved", "flowtime / bound", "first plan [s]", "memory [MB]")


def _make_planner_table(rows: Sequence[Row]) -> Table:
    table: Table = [["planner", *FIGURES, "not solved"]]
    for name, planner_rows in group_by_planner(rows).items():
        group = Group.of(planner_rows)
        ends = [f"{n} {status}" for status, n in group.statuses.items() if status != "solved"]
        table.append([name, *_list_figures(group), ", ".join(ends)])
    return table


def _make_detail_table(rows: Sequence[Row]) -> Table:
    names = name_planners(rows)
    return [
        ["map", "fleet", "robots", "planner", *FIGURES],
        *(
            [*place, str(robots), planner, *_list_figures(group)]
            for place, part in group_rows(rows, "map", "fleet").items()
            for planner, planner_rows in group_by_planner(part, names).items()
            for robots, group in group_by_robots(planner_rows).items()
        ),
    ]


def _list_figures(group: Group) -> Iterator[str]:
    def spread(values: Quartiles | None, form: str) -> str:
        if values is None:
            return ""
        quartiles = (values.first_quartile, values.median, values.third_quartile)
        low, median, high = (f"{quartile:{form}}" for quartile in quartiles)
        return median if low == high else f"{median} ({low} to {high})"

    yield f"{group.solved} of {group.cases}"
    yield spread(group.ratio, ".3f")
    yield spread(group.seconds, ".2g")
    yield "" if group.memory is None else f"{group.memory:.0f}"


def _make_html_table(table: Table) -> str:
    lines = [
        "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in line)
        for tag, line in zip(["th", *["td"] * len(table)], table, strict=False)
    ]
    return "<table>\n" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table>"


def _make_html_paragraph(sentence: str) -> str:
    return f"<p>{html.escape(sentence)}</p>"


def make_markdown_table(table: Table) -> str:
    """Return a table as Markdown; its first row has the headings."""
    heads, *lines = table
    return "\n".join(
        "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |"
        for row in (heads, ["---"] * len(heads), *lines)
    )


def _list_machines(rows: Iterable[Row]) -> Iterator[str]:
    keys = ("version", "commit", "cpu", "cores", "compiler", "python")
    for (version, commit, cpu, cores, compiler, python), machine_rows in group_rows(
        rows, *keys
    ).items():
        versions = f"rightofway {version}" + (f" (commit {commit})" if commit else "")
        cases = f"{len(machine_rows)} case{'s' * (len(machine_rows) != 1)}"
        yield f"{cases} by {versions} on {cpu}, {cores} cores, {compiler}, Python {python}."


def _draw_picture(draw: Callable[[Any], None], form: str) -> bytes:
    """Return a picture as svg or png."""
    content = io.BytesIO()
    with load_library("matplotlib", "a report").rc_context(STYLE):
        figure = load_library("matplotlib.figure", "a report").Figure(layout="constrained")
        draw(figure)
        metadata = {"Date": None} if form == "svg" else {}
        figure.savefig(content, format=form, dpi=150, metadata=metadata)
    return content.getvalue()


def _draw_cactus(rows: Sequence[Row], figure: Any) -> None:
    """Draw how many cases each planner has solved after how many seconds."""
    figure.set_size_inches(7, 4.2)
    axes, planners = figure.add_subplot(), group_by_planner(rows)
    for index, (name, planner_rows) in enumerate(planners.items()):
        # Laps have no first plan: they are known at the end.
        known = (
            row["first_plan_seconds"] or row["wall_seconds"]
            for row in planner_rows
            if row["solved"]
        )
        seconds = sorted(max(second, LEAST_SECONDS) for second in known)
        end = max([*seconds, *(row["limit"] for row in planner_rows)])
        counts = [*range(1, len(seconds) + 1), len(seconds)]
        colour = COLOURS[index % len(COLOURS)]
        axes.step([*seconds, end], counts, where="post", label=name, color=colour, linewidth=1.6)
    most = max(map(len, planners.values()))
    axes.axhline(most, color="#888888", linestyle=":", linewidth=1)
    axes.set(
        xscale="log",
        xlabel="time to the first plan [s]",
        ylabel=f"solved cases, of {most}",
        ylim=(0, 1.05 * most),
    )
    axes.yaxis.get_major_locator().set_params(integer=True)
    axes.legend(loc="lower right")


def _draw_ratios(rows: Sequence[Row], figure: Any) -> None:
    """Draw flowtime / lower bound by number of robots: medians and quartiles, a part for each map.

    Medians are of solved cases; where others are not solved the marker is hollow.
    """
    parts, names = group_rows(rows, "map", "fleet"), name_planners(rows)
    planners = list(dict.fromkeys(names.values()))
    columns = min(3, len(parts))
    lines = math.ceil(len(parts) / columns)
    figure.set_size_inches(1.2 + 3.6 * columns, 0.6 + 3 * lines)
    grid = figure.subplots(lines, columns, squeeze=False)
    for axes in grid.flat[len(parts) :]:
        axes.remove()
    for axes, (title, part) in zip(grid.flat, parts.items(), strict=False):
        axes.set_title(", ".join(filter(None, title)), fontsize="medium")
        by_name = group_by_planner(part, names)
        for index, name in enumerate(planners):
            beside = 1.02 ** (index - (len(planners) - 1) / 2)  # spreads do not cover others
            _draw_planner(axes, group_by_robots(by_name.get(name, [])), name, index, beside)
        counts = sorted({row["robots"] for row in part})
        axes.set(xscale="log", xlim=(counts[0] / 1.3, counts[-1] * 1.3))
        axes.set_xticks(counts, [str(count) for count in counts])
        axes.minorticks_off()
        axes.margins(y=0.1)
        axes.axhline(1, color="#888888", linestyle=":", linewidth=1)
    figure.supxlabel("robots", fontsize="medium")
    figure.supylabel("flowtime / lower bound", fontsize="medium")
    add_lines, labels = grid.flat[0].get_legend_handles_labels()
    figure.legend(add_lines, labels, loc="outside upper center", ncols=min(3, len(labels)))


def _draw_planner(
    axes: Any, groups: dict[int, Group], name: str, index: int, beside: float
) -> None:
    look = {"color": COLOURS[index % len(COLOURS)], "linewidth": 1.6}
    marker = MARKERS[index % len(MARKERS)]
    points = [
        (robots * beside, group.ratio, group.solved == group.cases)
        for robots, group in groups.items()
        if group.ratio
    ]
    axes.plot([], [], marker=marker, label=name, **look)
    axes.plot([x for x, _, _ in points], [ratio.median for _, ratio, _ in points], **look)
    for x, ratio, is_whole in points:
        spread = [[ratio.median - ratio.first_quartile], [ratio.third_quartile - ratio.median]]
        axes.errorbar(
            [x], [ratio.median], yerr=spread, marker=marker, capsize=2,
            markerfacecolor=look["color"] if is_whole else "white", **look,
        )  # fmt: skip


def _draw_fleet_sizes(shifts: Sequence[FleetSizes], figure: Any) -> None:
    """Draw throughput, service times and jobs in time by number of robots, a line for each."""
    figure.set_size_inches(7, 8)
    rates, times, shares = figure.subplots(3, 1, sharex=True)
    rates.margins(y=0.1)
    times.margins(y=0.1)
    for index, sizes in enumerate(shifts):
        look = {
            "color": COLOURS[index % len(COLOURS)],
            "marker": MARKERS[index % len(MARKERS)],
            "linewidth": 1.6,
        }
        robots = [size.robots for size in sizes.sizes]
        rates.plot(robots, [size.rate for size in sizes.sizes], label=sizes.title, **look)
        times.plot(robots, [size.service_median for size in sizes.sizes], **look)
        times.plot(robots, [size.service_p95 for size in sizes.sizes], linestyle="--", **look)
        shares.plot(robots, [100 * size.in_time for size in sizes.sizes], **look)
    units = {sizes.time_unit for sizes in shifts}
    unit = f" [{units.pop()}]" if len(units) == 1 and None not in units else ""
    rates.set(
        ylabel=" or ".join(dict.fromkeys(sizes.rate_unit for sizes in shifts)), ylim=(0, None)
    )
    times.set(ylabel=f"service time{unit}", ylim=(0, None))
    shares.set(ylabel="jobs in time [%]", ylim=(0, 105), xlabel="robots")
    shares.set_xticks(sorted({size.robots for sizes in shifts for size in sizes.sizes}))
    figure.legend(loc="outside upper center", ncols=min(2, len(shifts)))
