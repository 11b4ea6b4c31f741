"""A report on results: what was solved, how fast and how well; as a page or as Markdown."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from rightofway.bench.plots import cactus_plot, ratio_plot
from rightofway.bench.results import Row
from rightofway.bench.summary import (
    Group,
    Quantiles,
    by_planner,
    by_robots,
    grouped,
    planner_names,
)
from rightofway.errors import InputError
from rightofway.files import write_whole

__all__ = ["markdown_table", "write_report"]

Table = list[Sequence[str]]
"""Rows of cells; the first has the headings."""

CACTUS = "Solved cases over time: the more to the left and the higher, the better."
RATIOS = (
    "Flowtime / lower bound by number of robots: median and quartiles of the solved cases;"
    " 1 cannot be beaten. Hollow markers: some cases are not solved, and those tend to be the hard"
    " ones."
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


def write_report(rows: Sequence[Row], path: Path | str, title: str) -> None:
    """Write a report.

    Parameters
    ----------
    rows
        The results.
    path
        ``.html`` for one file that holds its pictures; ``.md`` for Markdown, with pictures beside
        it, ``-cactus.png`` and ``-ratio.png`` behind its name.
    title
        Heading of the report.

    Raises
    ------
    InputError
        If there are no rows, matplotlib is missing or a file cannot be written.
    """
    path = Path(path)
    if not rows:
        raise InputError.at("", "there is no row to report on (run some cases)", str(path))
    if path.suffix.lower() == ".md":
        _write_markdown(rows, path, title)
    else:
        write_whole(path, _page(rows, title))


def _page(rows: Sequence[Row], title: str) -> str:
    pictures = [(cactus_plot(rows, "svg"), CACTUS), (ratio_plot(rows, "svg"), RATIOS)]
    figures = []
    for picture, words in pictures:
        # Each an image of its own, so that the pictures share no names.
        data, text = base64.b64encode(picture).decode(), html.escape(words)
        figures.append(
            f'<figure><img alt="{text}" src="data:image/svg+xml;base64,{data}">'
            f"<figcaption>{text}</figcaption></figure>"
        )
    body = [
        _html_table(_planners(rows)),
        *figures,
        _html_table(_details(rows)),
        *(f"<p>{html.escape(sentence)}</p>" for sentence in _machines(rows)),
    ]
    return PAGE.format(title=html.escape(title), body="\n".join(body))


def _html_table(table: Table) -> str:
    lines = [
        "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in line)
        for tag, line in zip(["th", *["td"] * len(table)], table, strict=False)
    ]
    return "<table>\n" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table>"


def _write_markdown(rows: Sequence[Row], path: Path, title: str) -> None:
    cactus, ratio = f"{path.stem}-cactus.png", f"{path.stem}-ratio.png"
    write_whole(path.with_name(cactus), cactus_plot(rows, "png"))
    write_whole(path.with_name(ratio), ratio_plot(rows, "png"))
    parts = [
        f"# {title}",
        markdown_table(_planners(rows)),
        f"![{CACTUS}]({cactus})",
        CACTUS,
        f"![Flowtime / lower bound]({ratio})",
        RATIOS,
        markdown_table(_details(rows)),
        *_machines(rows),
    ]
    write_whole(path, "\n\n".join(parts) + "\n")


def markdown_table(table: Table) -> str:
    """Return a table as Markdown; its first row has the headings."""
    heads, *lines = table
    rows = (heads, ["---"] * len(heads), *lines)
    return "\n".join(
        "| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows
    )


def _planners(rows: Sequence[Row]) -> Table:
    lines = [
        [name, *_numbers(group), ", ".join(_unsolved(group))]
        for name, group in ((name, Group.of(each)) for name, each in by_planner(rows).items())
    ]
    return [["planner", *NUMBERS, "not solved"], *lines]


NUMBERS = ("solved", "flowtime / bound", "first plan [s]", "memory [MB]")


def _numbers(group: Group) -> Iterator[str]:
    yield f"{group.solved} of {group.cases}"
    yield _words(group.ratio, ".3f")
    yield _words(group.seconds, ".2g")
    yield "" if group.memory is None else f"{group.memory:.0f}"


def _words(spread: Quantiles | None, form: str) -> str:
    if spread is None:
        return ""
    low, high = (f"{each:{form}}" for each in (spread.first_quartile, spread.third_quartile))
    return f"{spread.median:{form}} ({low} to {high})"


def _unsolved(group: Group) -> Iterator[str]:
    return (f"{count} {name}" for name, count in group.statuses.items() if name != "solved")


def _details(rows: Sequence[Row]) -> Table:
    planner_of = planner_names(rows)
    lines = [
        [*names, str(robots), planner, *_numbers(group)]
        for names, part in grouped(rows, "map", "fleet").items()
        for planner, each in by_planner(part, planner_of).items()
        for robots, group in by_robots(each).items()
    ]
    return [["map", "fleet", "robots", "planner", *NUMBERS], *lines]


def _machines(rows: Iterable[Row]) -> Iterator[str]:
    keys = ("version", "commit", "cpu", "cores", "compiler", "python")
    for (version, commit, cpu, cores, compiler, python), each in grouped(rows, *keys).items():
        what = f"rightofway {version}" + (f" (commit {commit})" if commit else "")
        cases = f"{len(each)} case{'s' * (len(each) != 1)}"
        yield f"{cases} by {what} on {cpu}, {cores} cores, {compiler}, Python {python}."
