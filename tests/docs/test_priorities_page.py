"""The page on priorities says what was measured, and means are what they claim to be."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.marked import tables_in
from benchmarks.priorities_page import later, pairs, tables, write_page
from benchmarks.priorities_rows import Row, load
from tests.builders.pages import DOCS

PAGE = DOCS / "priorities.md"

OURS = Row(
    ground="open 16", robots=2, speeds="equal", work=0, occupancy="one", seed=0,
    planner="two-level", routes="clear", flowtime=100, lower_bound=80, decisions=4, node=1,
    robot=1, settled=1, only=1, rerouted=0, seconds=0.1,
)  # fmt: skip


def test_the_tables_are_those_of_the_figures() -> None:
    assert tables_in(PAGE, "table") == tables(load())


def test_writing_the_page_again_changes_nothing(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_bytes(PAGE.read_bytes())
    write_page(load(), page)
    assert page.read_bytes() == PAGE.read_bytes()


def other(seed: int, flowtime: int | None, **changes: int) -> Row:
    return replace(
        OURS, planner="fixed-priority", seed=seed, flowtime=flowtime, **changes  # type: ignore[arg-type]
    )  # fmt: skip


def ours(seed: int, **changes: int) -> Row:
    return replace(OURS, seed=seed, **changes)  # type: ignore[arg-type]


def test_later_is_the_geometric_mean_over_places() -> None:
    # Four times as long and the same: twice as long, by the geometric mean.
    rows = [ours(0), other(0, 400), ours(1), other(1, 100)]
    mean, half = later(pairs(rows, "fixed-priority"))
    # The logs are 1.386 and 0, their standard deviation 0.980, the error of their mean 0.693.
    assert mean == pytest.approx(1.0)
    assert half == pytest.approx(1.386, abs=1e-3)


def test_the_same_places_under_other_conditions_are_one_piece_of_evidence() -> None:
    rows = [ours(0), other(0, 400), ours(1), other(1, 100)]
    again = [replace(row, work=10) for row in rows]
    once, twice = (later(pairs(each, "fixed-priority")) for each in (rows, [*rows, *again]))
    assert twice == once


def test_fleets_that_one_of_the_two_did_not_solve_are_left_out() -> None:
    rows = [ours(0), other(0, 400), ours(1), other(1, None)]
    assert len(pairs(rows, "fixed-priority")) == 1
