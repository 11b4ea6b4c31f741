"""All of a plan in one workbook."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path
from typing import Any

import openpyxl  # type: ignore[import-untyped]  # it ships no types
import pytest

import rightofway
from rightofway.model import Plan, Rules
from rightofway.viz.table.result import make_result, write_result
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario
from tests.builders.planned_jobs import make_plan

CASES = {case["name"]: case for case in PAPER}


def result(plan: Plan, folder: Path) -> Any:
    write_result(plan, folder / "result.xlsx")
    return openpyxl.load_workbook(folder / "result.xlsx")


@pytest.fixture
def door(tmp_path: Path) -> Any:
    """Return the result of door-5 as published, which leaves a swap."""
    plan = rightofway.solve(paper_scenario(CASES["door-5"]), "two-level", swaps="leave")
    return result(plan, tmp_path)


def test_it_does_not_hold_when_it_was_written() -> None:
    """So the same plan gives the same bytes."""
    data = make_result(rightofway.solve(paper_scenario(CASES["door-1"])))
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert {part.date_time[:3] for part in archive.infolist()} == {(1980, 1, 1)}
        core = archive.read("docProps/core.xml")
    assert re.findall(rb"W3CDTF.>([^<]*)<", core) == [b"1980-01-01T00:00:00Z"] * 2


def test_it_has_a_sheet_for_each_question(door: Any) -> None:
    assert door.sheetnames == [
        "summary", "diagram", "time and space", "legend", "events", "collisions",
        "left in the plan", "decisions", "diagram data",
    ]  # fmt: skip


def test_stops_of_jobs_are_a_sheet_with_the_reason_of_jobs_that_are_not_served(
    tmp_path: Path,
) -> None:
    """R1 does J1, and R2 the last stop of J3, which it had begun, and J2."""
    rows = list(result(make_plan(), tmp_path)["jobs"].values)
    assert rows == [
        ("job", "stop", "robot", "place", "begins", "ends", "not served"),
        ("J1", 1, "R1", "N1", 3, 5, None),
        ("J1", 2, "R1", "N3", 8, 9, None),
        ("J2", 1, "R2", "N8", 9, 12, None),
        ("J3", 2, "R2", "N7", 4, 4, None),
        ("J4", None, None, None, None, None, "not found"),
    ]


def test_the_summary_says_where_each_completion_time_goes(door: Any) -> None:
    rows = list(door["summary"].values)
    assert ("makespan", "22 time units") in [row[:2] for row in rows]
    headings = rows.index(("robot", "completes", "alone", "detours", "makes room", "waits"))
    assert rows[headings + 1 :] == [("R1", 9, 9, 0, 0, 0), ("R2", 22, 21, 0, 0, 1)]


def test_the_swap_that_is_left_is_listed_and_coloured(door: Any) -> None:
    assert list(door["left in the plan"].values)[1:] == [("R1", "R2", 7, 7, "N7 and N4", "swap")]
    final = next(row for row in door["time and space"].iter_rows() if row[1].value == "final")
    assert final[8].fill.fgColor.rgb == final[9].fill.fgColor.rgb == "00D9A6E8"


def test_the_diagram_has_a_line_for_each_robot_and_a_label_for_each_place(door: Any) -> None:
    """R1 drives 0 1 4 7 6, turns for one tick, and drives back; seven places are on the line."""
    data = list(zip(*door["diagram data"].values, strict=True))
    assert data[0][:6] == ("R1 time", 0, 0, 1, 1, 2)
    assert data[1][:6] == ("R1", 0, 0, 2, 2, 3)  # N0, N2, N1, N4, … from below
    [chart] = door["diagram"]._charts
    assert len(chart.series) == 2 + 7


@pytest.mark.slow
def test_a_table_that_is_too_wide_has_longer_columns(tmp_path: Path) -> None:
    """20 002 ticks do not fit into the 16 384 columns of a sheet."""
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"), work=[20_000])
    workbook = result(rightofway.solve(scenario), tmp_path)
    heading = next(workbook["time and space"].values)
    assert heading[:5] == ("robot", "row", 0, 2, 4)
    assert heading[-1] == 20_001
    assert ("time", "the first row; a column lasts 2 time units") in list(workbook["legend"].values)


def test_a_large_fleet_has_a_chart_of_its_first_robots(tmp_path: Path) -> None:
    trips = [(f"N{k}", f"N{k}") for k in range(120)]
    workbook = result(rightofway.solve(grid_fleet(["." * 120], trips), "lacam"), tmp_path)
    [chart] = workbook["diagram"]._charts
    assert len(chart.series) == 100
    assert workbook["diagram"]["A1"].value.startswith("Places over time, the first 100 robots.")
