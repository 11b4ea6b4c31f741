"""Results of suites become the tables of the pages, and means are what they claim to be."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from benchmarks.common import RESULTS, tables_in, write_tables
from benchmarks.page_laps import laps_plots, laps_tables, paper_table
from benchmarks.page_priorities import OTHERS, later, pairs, priorities_plots, priorities_tables
from benchmarks.page_timetables import timetable_tables
from rightofway.bench import Row, read_suite
from rightofway.bench.run import run
from rightofway.io import make_schema
from tests.builders.pages import DOCS, ROOT

SUITES = ROOT / "benchmarks" / "suites"


def row(planner: str, ratio: float | None, **values: Any) -> Row:
    """Return a row of the suite on priorities; no ratio for one that is not solved."""
    figures = {"decisions": {"node": 1, "robot": 1, "settled": 1, "only": 1}, "rerouted": 0}
    return {
        "map": "open 16", "scen": "", "robots": 2, "seed": 0, "planner": planner,
        "fleet": "speeds equal, no work, one", "options": "swaps=resolve routes=clear",
        "solved": ratio is not None, "ratio": ratio, "cpu_seconds": 0.1,
        "figures": json.dumps(figures), **values,
    }  # fmt: skip


def test_later_is_the_geometric_mean_over_places() -> None:
    # Four times as long and the same: twice as long, by the geometric mean.
    rows = [
        row("two-level", 1.25), row("fixed-priority", 5.0),
        row("two-level", 1.25, seed=1), row("fixed-priority", 1.25, seed=1),
    ]  # fmt: skip
    mean, half = later(pairs(rows, "fixed-priority"))
    # The logs are 1.386 and 0, their standard deviation 0.980, the error of their mean 0.693.
    assert mean == pytest.approx(1.0)
    assert half == pytest.approx(1.386, abs=1e-3)
    again = [{**each, "fleet": "speeds equal, work 0 to 10, one"} for each in rows]
    assert later(pairs([*rows, *again], "fixed-priority")) == (mean, half), (
        "the same places under other conditions are one piece of evidence"
    )


def test_fleets_that_one_of_the_two_did_not_solve_are_left_out() -> None:
    rows = [
        row("two-level", 1.25), row("fixed-priority", 5.0),
        row("two-level", 1.25, seed=1), row("fixed-priority", None, seed=1),
    ]  # fmt: skip
    assert len(pairs(rows, "fixed-priority")) == 1


@pytest.fixture
def compared() -> list[Row]:
    """Return two fleets by all planners: the others take a tenth longer than two-level."""
    return [
        row(
            planner, 1.0 if planner == "two-level" else 1.1, seed=seed,
            options=f"routes={routes}", cpu_seconds=0.1 + 0.1 * seed,
        )
        for routes in ("clear", "shortest")
        for planner in ("two-level", *OTHERS)
        for seed in (0, 1)
    ]  # fmt: skip


def heads(tables: dict[str, str]) -> dict[str, str]:
    return {name: table.splitlines()[0] for name, table in tables.items()}


def test_the_page_on_priorities_gets_each_of_its_tables(compared: list[Row]) -> None:
    made = priorities_tables(compared)
    assert heads(made) == heads(tables_in(RESULTS / "priorities.md", "table"))
    assert made["routes"].splitlines()[2] == (
        "| `clear` | 2 | +10.0 ± 0.0 % | +10.0 ± 0.0 % | +10.0 ± 0.0 % | 0 %, 0 %, 100 % |"
    )
    assert made["levels"].splitlines()[2] == (
        "| speeds equal, no work | 4 | 25 % | 25 % | 25 % | 25 % |"
    )


def test_the_page_on_priorities_gets_each_of_its_plots(compared: list[Row]) -> None:
    names = [name for name, _ in priorities_plots(compared)]
    text = (RESULTS / "priorities.md").read_text(encoding="utf-8")
    assert len(names) == 3
    assert all(f"images/{name}.png" in text for name in names)


@pytest.fixture
def laps(tmp_path: Path) -> list[Row]:
    """Return the rows of three robots under three rules and a timetable, run here."""
    (tmp_path / "suite.toml").write_text(
        'format = "rightofway-suite/1"\ncounts = [3]\nlimits = [1]\n'
        'maps = [{name = "8 x 8", random = {size = [8, 8]}}]\n'
        'fleets = [{name = "equal speeds", work = [0, 5]}]\n'
        + "".join(
            f'[[planners]]\nname = "laps"\noptions = {{rule = "{rule}"}}\n'
            for rule in ("first-come", "fixed-order", "two-level", "timetable")
        ),
        encoding="utf-8",
    )
    return [{**case.labels, **run(case)} for case in read_suite(tmp_path / "suite.toml")]


def test_the_page_on_laps_gets_each_of_its_tables_and_plots(laps: list[Row]) -> None:
    rules = laps[:3]
    made = laps_tables(rules)
    assert heads(made) == heads(tables_in(RESULTS / "second-lap.md", "table"))
    assert len(made["how long"].splitlines()) == 2 + 3
    assert "3 robots, 8 x 8, equal speeds" in made["where"]
    pages = (RESULTS / "second-lap.md", DOCS / "laps.md")
    text = "".join(page.read_text(encoding="utf-8") for page in pages)
    assert all(f"images/{name}.png" in text for name, _ in laps_plots(rules))


def test_laps_under_a_timetable_are_compared_with_those_under_each_rule(laps: list[Row]) -> None:
    made = timetable_tables(laps)
    assert heads(made) == heads(tables_in(RESULTS / "second-lap.md", "timetables"))
    assert [line.split(" | ")[1] for line in made["rivals"].splitlines()[2:]] == [
        "`first-come`", "`fixed-order`", "`two-level`",
    ]  # fmt: skip


def test_the_published_table_of_the_papers_cases_is_what_laps_give() -> None:
    assert tables_in(RESULTS / "second-lap.md", "table")["paper"] == paper_table()


def test_a_table_replaces_the_one_under_its_mark_and_nothing_else(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("a\n\n<!-- table: x -->\n\n| old |\n\nb\n", encoding="utf-8")
    write_tables(page, "table", {"x": "| new |\n", "y": "| no mark |\n"})
    assert page.read_text(encoding="utf-8") == "a\n\n<!-- table: x -->\n\n| new |\n\nb\n"
    assert tables_in(page, "table") == {"x": "| new |\n"}


@pytest.mark.parametrize("path", sorted(SUITES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_suite_fits_the_schema_and_has_cases(path: Path) -> None:
    """Those on the MovingAI benchmark need its files, so only their shape is looked at."""
    text = path.read_text(encoding="utf-8")
    assert jsonschema.Draft202012Validator(make_schema("suite")).is_valid(tomllib.loads(text))
    if "movingai" not in text:
        assert len(read_suite(path)) >= 12
