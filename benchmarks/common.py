"""What the scripts beside it share: tables in pages, plots, fleets of the MovingAI benchmark."""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rightofway
from rightofway.bench import Row
from rightofway.bench.report import make_markdown_table
from rightofway.model import Scenario

__all__ = [
    "DOCS", "IMAGES", "RESULTS", "SEEDS", "grouped", "movingai_fleet", "option", "percent",
    "place_of", "plain_axes", "save_figure", "table", "tables_in", "write_tables",
]  # fmt: skip

DOCS = Path(__file__).parents[1] / "docs"
IMAGES = DOCS / "images"
RESULTS = DOCS / "results"

mpl.rcParams.update({"font.size": 9, "axes.axisbelow": True})

SEEDS = (1, 2, 3)
"""Of the random scenarios of the MovingAI benchmark."""

Item = TypeVar("Item")
Key = TypeVar("Key", bound=Hashable)


def grouped(items: Iterable[Item], key: Callable[[Item], Key]) -> dict[Key, list[Item]]:
    """Return the items of each key, keys in the order in which they first come."""
    groups: dict[Key, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def option(row: Row, name: str) -> str:
    """Return the value of an option of the planner of a row."""
    options: dict[str, str] = dict(each.split("=", 1) for each in row["options"].split())
    return options[name]


def place_of(row: Row) -> tuple[Any, ...]:
    """Return what draws homes and targets; other speeds, work and rules go to the same places."""
    return row["map"], row["scen"], row["robots"], row["seed"]


def table(heads: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table that ends with its last line."""
    return make_markdown_table([heads, *lines]) + "\n"


def percent(share: float) -> str:
    """Return a share as text."""
    return f"{100 * share:.0f} %"


def tables_in(page: Path, kind: str) -> dict[str, str]:
    """Return the tables under marks like ``<!-- kind: name -->``, by their names."""
    text = page.read_text(encoding="utf-8")
    return {place["name"]: place["table"] for place in _marked(kind).finditer(text)}


def write_tables(page: Path, kind: str, made: Mapping[str, str]) -> None:
    """Put tables under their marks, in place of those that stand there."""
    text = page.read_text(encoding="utf-8")
    put = _marked(kind).sub(
        lambda place: place["mark"] + made.get(place["name"], place["table"]), text
    )
    page.write_text(put, encoding="utf-8")


def _marked(kind: str) -> re.Pattern[str]:
    mark = rf"^(?P<mark><!-- {kind}: (?P<name>.*) -->\n\n)"
    return re.compile(rf"{mark}(?P<table>(?:\|.*\n)*)", re.MULTILINE)


def plain_axes(axes: Axes, *, grid: str = "both") -> None:
    """Draw a faint grid and no box."""
    axes.grid(visible=True, axis="y" if grid == "y" else "both", color="#dddddd")
    axes.spines[["top", "right"]].set_visible(False)


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as PNG, the same bytes for the same figure."""
    figure.savefig(path, dpi=120, metadata={"Software": None})


def movingai_fleet(folder: Path, name: str, robots: int, seed: int) -> Scenario:
    """Return the first robots of a random scenario of the MovingAI benchmark, ready to plan."""
    whole = rightofway.load(folder / "scens" / f"{name}-random-{seed}.scen")
    scenario = replace(whole, robots=whole.robots[:robots])
    assert scenario.problem  # bound once, and no part of planning
    return scenario
