"""The time/space table in files."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import openpyxl  # type: ignore[import-untyped]  # it ships no types
import pytest

from rightofway.errors import InputError
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.site import Edge, VertexId, make_roadmap
from rightofway.viz.table import make_table, write_csv, write_xlsx
from tests.builders.fleets import grid_fleet


def make_plan(scenario: Scenario, *trips: tuple[Sequence[int], Sequence[int]]) -> Plan:
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def crossing() -> Plan:
    """Return two robots that meet in N4 at tick 1 unless R2 waits a tick, as it does."""
    scenario = grid_fleet(["..."] * 3, [("N3", "N5"), ("N1", "N7")], rules=Rules(ends="none"))
    return make_plan(scenario, ([3, 4, 5], [0, 1, 2]), ([1, 4, 7], [0, 2, 3]))


def test_comma_separated_values_are_bare_places_and_marks_in_rows_of_their_own(
    tmp_path: Path,
) -> None:
    write_csv(make_table(crossing()), tmp_path / "table.csv")
    assert (tmp_path / "table.csv").read_bytes() == (
        b"robot,row,0,1,2,3\n"
        b"R1,planned,3,4,5\nR1,planned marks,,collision,\nR1,final,3,4,5\n"
        b"R2,planned,1,4,7\nR2,planned marks,,collision,\n"
        b"R2,final,1,1,4,7\nR2,final marks,wait,,,\n"
    )


@pytest.fixture
def workbook(tmp_path: Path) -> Any:
    write_xlsx(make_table(crossing()), tmp_path / "table.xlsx")
    return openpyxl.load_workbook(tmp_path / "table.xlsx")


def test_the_sheet_has_planned_and_final_rows_of_each_robot_with_numbers(workbook: Any) -> None:
    assert list(workbook["time and space"].values) == [
        ("robot", "row", 0, 1, 2, 3),
        ("R1", "planned", 3, 4, 5, None),
        ("R1", "final", 3, 4, 5, None),
        ("R2", "planned", 1, 4, 7, None),
        ("R2", "final", 1, 1, 4, 7),
    ]


def test_collisions_and_waits_are_coloured_as_the_legend_says(workbook: Any) -> None:
    coloured = {
        cell.coordinate: cell.fill.fgColor.rgb
        for row in workbook["time and space"].iter_rows()
        for cell in row
        if cell.fill.fill_type
    }
    colours = {
        row[1].value: row[0].fill.fgColor.rgb
        for row in workbook["legend"].iter_rows()
        if row[0].fill.fill_type
    }
    collision, wait = colours["another robot has the same place"], colours["the robot waits"]
    # Planned rows are 2 and 4, tick 1 is column D; R2 waits in tick 0, its final row is 5.
    assert coloured == {"D2": collision, "D4": collision, "C5": wait}
    assert collision != wait


def test_robots_and_ticks_stay_in_sight(workbook: Any) -> None:
    assert workbook["time and space"].freeze_panes == "C2"


def test_columns_are_as_wide_as_their_text(tmp_path: Path) -> None:
    write_xlsx(make_table(named("Loading dock")), tmp_path / "table.xlsx")
    columns = openpyxl.load_workbook(tmp_path / "table.xlsx")["time and space"].column_dimensions
    # "Shuttle 1", "planned" and "Loading dock", with room for two letters more.
    assert [columns[letter].width for letter in "ABC"] == [11, 9, 14]
    # Ticks 0 to 3 have one width: a move of 1, turning 0, a move back of 1, one wait.
    assert (columns["C"].min, columns["C"].max) == (3, 6)


def named(place: str) -> Plan:
    ends = [(place, "bay"), ("bay", place)]
    edges = [Edge(tail=tail, head=head, length=Fraction(1)) for tail, head in ends]
    scenario = Scenario(
        roadmap=make_roadmap({place: (0.0, 0.0), "bay": (1.0, 0.0)}, edges),
        robots=(Robot(name="Shuttle 1", home=VertexId(0), stops=(Stop(at=VertexId(1)),)),),
    )
    return make_plan(scenario, ([0, 1, 0], [0, 2, 3]))


@pytest.mark.parametrize(
    ("name", "shown"), [("=1+1", "=1+1"), ("+3", "+3"), ("12", "12"), ("a\x07b", "a\ufffdb")]
)
def test_names_are_text_whatever_they_look_like(tmp_path: Path, name: str, shown: str) -> None:
    """No formula, no number, no character that a workbook may not hold."""
    write_xlsx(make_table(named(name)), tmp_path / "table.xlsx")
    cell = openpyxl.load_workbook(tmp_path / "table.xlsx")["time and space"]["C2"]
    assert (cell.value, cell.data_type) == (shown, "s")


def test_a_plan_longer_than_a_sheet_is_refused_and_nothing_written(tmp_path: Path) -> None:
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"))
    plan = make_plan(scenario, ([0, 1], [0, 16_382]))
    with pytest.raises(InputError) as raised:
        write_xlsx(make_table(plan), tmp_path / "table.xlsx")
    assert str(raised.value) == (
        "table: 16383 columns, room is for 16382 (choose fewer with --from and --to,"
        " or longer ones with --step; --events has no such limit)"
    )
    assert list(tmp_path.iterdir()) == []


def test_a_table_that_is_refused_leaves_the_old_file_alone(tmp_path: Path) -> None:
    old = tmp_path / "table.csv"
    old.write_text("old", encoding="utf-8")
    scenario = grid_fleet(["..."], [("N0", "N1")], rules=Rules(ends="none"))
    with pytest.raises(InputError):
        write_csv(make_table(make_plan(scenario, ([0, 1], [0, 10**9]))), old)
    assert old.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [old]
