"""Scenarios in a workbook: what a spreadsheet user writes, and what may be wrong with it."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from fractions import Fraction
from pathlib import Path
from typing import Any

import openpyxl  # type: ignore[import-untyped]  # it ships no types
import pytest
from openpyxl.styles import PatternFill  # type: ignore[import-untyped]

import rightofway
from rightofway.errors import InputError
from rightofway.io import load_with_notes, parse_scenario, write_scenario
from rightofway.io.faults import Faults
from rightofway.io.workbook import format_workbook, write_template
from rightofway.io.workbook.sheets import read_sheets
from rightofway.io.workbook.writer import TEMPLATE
from rightofway.model import Rules
from rightofway.report.quantities import Quantities
from tests.builders.sentences import tell_notes

EXAMPLES = Path(__file__).parents[2] / "examples"

Edit = Callable[[Any], object]


def edited(path: Path, *edits: Edit) -> Path:
    """Write the template, and change it as a user would."""
    write_template(path)
    workbook = openpyxl.load_workbook(path)
    for edit in edits:
        edit(workbook)
    workbook.save(path)
    return path


def put(sheet: str, cell: str, value: object) -> Edit:
    return lambda workbook: workbook[sheet].__setitem__(cell, value)


def fill(sheet: str, cell: str, colour: str) -> Edit:
    def edit(workbook: Any) -> None:
        workbook[sheet][cell].fill = PatternFill("solid", fgColor=colour)

    return edit


def faults_of(path: Path) -> list[str]:
    with pytest.raises(InputError) as raised:
        rightofway.load(path)
    return [str(fault.name_file("")) for fault in raised.value.faults]


def test_the_template_is_the_scenario_of_a_door(tmp_path: Path) -> None:
    write_template(tmp_path / "door.xlsx")
    scenario = rightofway.load(tmp_path / "door.xlsx")
    name = scenario.roadmap.name
    robots = [(robot.name, name(robot.home), name(robot.stops[0].at)) for robot in scenario.robots]
    assert robots == [("R1", "N0", "N6"), ("R2", "N2", "N8")]
    assert scenario.robots[1].speed == Fraction(1, 2)
    assert scenario.robots[1].stops[0].work == 3


def test_the_template_has_hints_and_lists_of_choices(tmp_path: Path) -> None:
    write_template(tmp_path / "door.xlsx")
    workbook = openpyxl.load_workbook(tmp_path / "door.xlsx")
    assert workbook.sheetnames == ["map", "robots", "rules", "how to"]
    lists = [each.formula1 for each in workbook["rules"].data_validations.dataValidation]
    assert '"one,both"' in lists
    prompts = [each.prompt for each in workbook["robots"].data_validations.dataValidation]
    assert all(prompts)


def test_limits_of_edges_and_all_digits_of_positions_are_kept(tmp_path: Path) -> None:
    """A third would be read as 1/3, and another number of 16 digits would lose the last one."""
    limits = {"max_speed": "1/2", "max_speed_by_type": {"drone": 2, "fork lift": "1/3"}}
    edges = [{"from": "dock", "to": "bay", **limits}, ["bay", "shelf", "5/2"]]
    vertices = {"dock": [0, 0], "bay": [0.333333333333333, 2], "shelf": [17.010032333333335, 2]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": vertices, "edges": edges}, "y": "up"},
        "robots": [{"name": "R1", "home": "dock", "target": "shelf"}],
    }
    scenario = parse_scenario(document)
    write_scenario(scenario, tmp_path / "roadmap.xlsx")
    assert rightofway.load(tmp_path / "roadmap.xlsx") == scenario


@pytest.mark.parametrize("name", ["door", "crossroad", "bay", "floor", "paper/door-5"])
def test_a_scenario_written_as_a_workbook_is_read_back(tmp_path: Path, name: str) -> None:
    scenario = rightofway.load(EXAMPLES / f"{name}.yaml")
    write_scenario(scenario, tmp_path / "copy.xlsx")
    assert rightofway.load(tmp_path / "copy.xlsx") == scenario


def test_headings_orientations_turning_and_ids_are_kept(tmp_path: Path) -> None:
    document = {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {
                    "A": [0, 0],
                    "B": {"at": [3, 0], "heading": 90},
                    "C": {"at": [3, 3], "turning": False},
                },
                "edges": [
                    {"from": "A", "to": "B", "orientation": 180, "id": "12", "turning": True},
                    {"from": "B", "to": "C", "turning": False},
                ],
            }
        },
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
    }
    roadmap = parse_scenario(document).roadmap
    assert roadmap.fixed
    write_scenario(parse_scenario(document), tmp_path / "turned.xlsx")
    assert load_with_notes(tmp_path / "turned.xlsx").scenario.roadmap == roadmap


def test_several_stops_are_columns(tmp_path: Path) -> None:
    fleet = rightofway.FleetBuilder(grid=["...", "..."])
    fleet = fleet.add_robot("A", home="N0", stops=[("N1", 2), "N5"]).add_robot(
        "B", home="N3", target="N4", work="1/3", laps=2
    )
    write_scenario(fleet.build_scenario(), tmp_path / "stops.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "stops.xlsx")["robots"]
    assert [cell.value for cell in sheet[1]][:6] == [
        "name", "home", "stop 1", "work 1", "stop 2", "work 2",
    ]  # fmt: skip
    assert rightofway.load(tmp_path / "stops.xlsx") == fleet.build_scenario()


def test_later_keys_of_robots_and_rules_are_kept(tmp_path: Path) -> None:
    fleet = rightofway.FleetBuilder(grid=["...", "..."], occupancy="both")
    fleet = fleet.add_robot("A", home="N0", target="N5")
    (robot,) = fleet.build_scenario().robots
    scenario = replace(
        fleet.build_scenario(),
        robots=(replace(robot, radius=Fraction(1, 4)),),
        rules=Rules(occupancy="both", clearance=Fraction(1, 10)),
    )
    write_scenario(scenario, tmp_path / "sizes.xlsx")
    assert rightofway.load(tmp_path / "sizes.xlsx") == scenario


def test_a_document_with_parts_that_no_sheet_holds_is_refused() -> None:
    with pytest.raises(InputError, match=r"a workbook has no place for fleets \(write .yaml"):
        format_workbook({**TEMPLATE, "fleets": []})


def test_colours_draw_a_map_and_empty_cells_are_noted(tmp_path: Path) -> None:
    """A dark cell is blocked and a light one free; a cell with neither counts as free."""
    path = edited(
        tmp_path / "map.xlsx",
        put("map", "A2", None), fill("map", "A2", "203864"),
        put("map", "C2", None), fill("map", "C2", "FFF2CC"),
    )  # fmt: skip
    loaded = load_with_notes(path)
    grid = loaded.scenario.roadmap.grid
    assert grid is not None
    assert list(grid.as_lines()) == ["...", "@..", "..."]
    assert tell_notes(loaded) == ()
    empty = edited(tmp_path / "empty.xlsx", put("map", "B1", None))
    assert tell_notes(load_with_notes(empty)) == (
        "1 empty cell of the map counts as free, the first is map!B1",
    )


def test_a_dark_cell_is_blocked_whatever_is_written_there(tmp_path: Path) -> None:
    path = edited(
        tmp_path / "map.xlsx",
        put("map", "B1", "press"), fill("map", "B1", "1F3864"),
        fill("map", "A2", "FFFFFF"), fill("map", "B3", "000000"),
    )  # fmt: skip
    grid = rightofway.load(path).roadmap.grid
    assert grid is not None
    assert list(grid.as_lines()) == [".@.", "@.@", ".@."]


def test_a_place_may_point_to_a_cell_of_the_map(tmp_path: Path) -> None:
    """As typed, and as a spreadsheet writes it when a user clicks on the cell."""
    path = edited(
        tmp_path / "points.xlsx", put("robots", "B2", "=map!$A$3"), put("robots", "C2", "map!A1")
    )
    robot = rightofway.load(path).robots[0]
    assert [robot.home, robot.stops[0].at] == [4, 0]  # N6 and N0 of the seven free cells


def test_a_map_may_begin_anywhere_on_its_sheet(tmp_path: Path) -> None:
    def move(workbook: Any) -> None:
        workbook["map"].insert_rows(1, 2)
        workbook["robots"]["B2"], workbook["robots"]["C2"] = "map!A3", "N6"
        workbook["robots"]["B3"], workbook["robots"]["C3"] = "map!C3", "map!C5"

    scenario = rightofway.load(edited(tmp_path / "moved.xlsx", move))
    assert scenario.robots[0].home == 0


def test_numbers_are_those_that_a_user_meant(tmp_path: Path) -> None:
    """A third has 15 digits in a spreadsheet; numbers in cells for text are numbers, too."""
    path = edited(
        tmp_path / "numbers.xlsx",
        put("robots", "E2", 0.333333333333333), put("robots", "E3", "0.25"),
        put("robots", "J3", "2"), put("robots", "A3", 7),
    )  # fmt: skip
    first, second = rightofway.load(path).robots
    assert (first.speed, second.speed) == (Fraction(1, 3), Fraction(1, 4))
    assert (second.laps, second.name) == (2, "7")


def test_rules_hold_rules_units_and_what_belongs_to_the_map(tmp_path: Path) -> None:
    path = edited(
        tmp_path / "rules.xlsx",
        put("rules", "B2", "both"), put("rules", "B7", False), put("rules", "B11", 2),
        put("rules", "B14", "m"), put("rules", "B15", "s"),
    )  # fmt: skip
    scenario = rightofway.load(path)
    assert (scenario.rules.occupancy, scenario.rules.rotations) == ("both", False)
    assert Quantities.of(scenario).format_heading("time") == "time [s]"
    assert scenario.roadmap.grid is not None
    assert scenario.roadmap.grid.cell_size == 2


def test_a_roadmap_is_two_sheets_of_vertices_and_edges(tmp_path: Path) -> None:
    path = edited(
        tmp_path / "roadmap.xlsx",
        lambda workbook: workbook.remove(workbook["map"]),
        lambda workbook: workbook.create_sheet("Vertices"),
        lambda workbook: workbook.create_sheet("edges"),
    )
    workbook = openpyxl.load_workbook(path)
    for row in (("name", "x", "y"), ("dock", 0, 0), ("bay", 3, 4), ("shelf", 3, 0)):
        workbook["Vertices"].append(row)
    for row in (("from", "to", "both_ways"), ("dock", "bay", "yes"), ("bay", "shelf", "no"),
                ("shelf", "bay", "no")):  # fmt: skip
        workbook["edges"].append(row)
    for cell, value in {"B2": "dock", "C2": "bay", "B3": "shelf", "C3": "bay"}.items():
        workbook["robots"][cell] = value
    workbook.save(path)
    scenario = rightofway.load(path)
    assert scenario.roadmap.n_vertices == 3
    assert set(scenario.roadmap.lengths) == {5, 4}
    for cell, value in {"D1": "parking", "D2": "yes", "D3": "no", "E1": "charging"}.items():
        workbook["Vertices"][cell] = value
    workbook["robots"]["B2"] = workbook["robots"]["D3"] = None
    (rule,) = (row for row in workbook["rules"] if row[0].value == "homes")
    rule[1].value = "parking"
    workbook.save(path)
    loaded = load_with_notes(path)
    roadmap = loaded.scenario.roadmap
    assert roadmap.name(loaded.scenario.robots[0].home) == "dock"
    assert str(loaded.notes[-1]) == "homes dealt out: R1 at dock"
    write_scenario(loaded.scenario, tmp_path / "again.xlsx")
    assert rightofway.load(tmp_path / "again.xlsx") == loaded.scenario
    workbook["Vertices"]["D3"] = "maybe"
    workbook.save(path)
    assert faults_of(path) == ["Vertices!D3: 'maybe' is neither true nor false (write one of them)"]
    workbook["Vertices"]["D3"] = None
    workbook["edges"]["B3"] = "dok"
    workbook.save(path)
    assert faults_of(path) == ["edges!B3: no vertex is named 'dok' (did you mean 'dock'?)"]


BROKEN: dict[str, tuple[list[Edit], list[str]]] = {
    "values": (
        [put("robots", "E2", 0), put("robots", "B3", "N99"), put("rules", "B3", "-1")],
        ["robots!E2: 0 is not positive", "robots!B3: 'N99' is outside", "rules!B3: -1 is negative"],
    ),
    "a date": (
        [put("robots", "E2", datetime(2026, 1, 2)), put("robots", "E3", "fast")],  # noqa: DTZ001
        ["robots!E2: 2026-01-02 is a date or a time", "robots!E3: 'fast' is not a number"],
    ),
    "a formula that was never computed": (
        [put("robots", "E2", "=1/2")],
        ["robots!E2: the formula '=1/2' has no value yet (open the workbook in a spreadsheet"],
    ),
    "an error": ([put("robots", "E2", "#REF!")], ["robots!E2: holds the error #REF! (mend it)"]),
    "merged cells": (
        [lambda workbook: workbook["map"].merge_cells("A1:B1")],
        ["map!A1:B1: these cells are merged (unmerge them)"],
    ),
    "a heading": (
        [put("robots", "E1", "sped"), put("robots", "AM1", "name"), put("robots", "AN2", "x")],
        [
            "robots!E1: 'sped' is no key of a robot (did you mean speed?)",
            "robots!AM1: the column 'name' is given twice (take one out)",
            "robots!AN2: a value without a heading (take it out)",
        ],
    ),
    "a rule": ([put("rules", "A3", "hedway")], ["rules!A3: 'hedway' is no rule (did you mean"]),
    "a map": (
        [put("map", "B1", "wall"), put("map", "C3", 1)],
        ["map!B1: 'wall' is no cell of a map (write . or @", "map!C3: 1 is no cell of a map"],
    ),
    "a cell far away": (
        [put("map", "XFD1048576", "x")],
        ["map!XFD1048576: the map reaches from map!A1 to here: 17179869184 cells, more than"],
    ),
    "no robots": (
        [lambda workbook: workbook.remove(workbook["robots"])],
        ["the sheet robots is missing (add it; `rightofway new` writes one)"],
    ),
    "an empty sheet": (
        [lambda workbook: workbook["robots"].delete_rows(2, 9)],
        ["robots!A1: there is no robot (write headings, then one robot a row)"],
    ),
    "a robot twice": (
        [put("robots", "A3", "R1"), put("robots", "B3", "map!A1")],
        [
            "robots!A3: R1 is the name of robots!A2 already (give each its own)",
            "robots!B3: N0 is the home of R1 already",
        ],
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_all_faults_are_named_by_sheet_and_cell(tmp_path: Path, case: str) -> None:
    edits, expected = BROKEN[case]
    found = faults_of(edited(tmp_path / "broken.xlsx", *edits))
    assert len(found) == len(expected)
    for fault, start in zip(sorted(found), sorted(expected), strict=True):
        assert fault.startswith(start)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "this is no workbook (save it as .xlsx)"),
        (b"name,home\n", "this is no workbook (save it as .xlsx)"),
        (bytes.fromhex("d0cf11e0a1b11ae1"), "has a password, or is an old .xls file"),
        (b"PK\x03\x04 and nothing more", "this is no workbook (save it as .xlsx)"),
    ],
)
def test_a_file_that_is_no_workbook_says_what_it_is(
    tmp_path: Path, content: bytes, message: str
) -> None:
    (tmp_path / "file.xlsx").write_bytes(content)
    assert faults_of(tmp_path / "file.xlsx")[0].startswith(message)


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ("content.xml", "this is an OpenDocument file (save it as .xlsx)"),
        ("xl/workbook.xml", "the workbook is broken: "),
    ],
)
def test_an_archive_that_is_no_workbook_says_what_it_is(
    tmp_path: Path, part: str, message: str
) -> None:
    with zipfile.ZipFile(tmp_path / "file.xlsx", "w") as archive:
        archive.writestr(part, "<office/>")
    assert faults_of(tmp_path / "file.xlsx")[0].startswith(message)


def test_sheets_of_other_names_are_reported_with_the_nearest(tmp_path: Path) -> None:
    workbook = openpyxl.Workbook()
    workbook.active.title = "robot"
    workbook.save(tmp_path / "names.xlsx")
    assert faults_of(tmp_path / "names.xlsx") == [
        "no sheet is called map or robots; there is 'robot' (did you mean 'robots' by 'robot'?)"
    ]


def test_a_workbook_is_no_plan(tmp_path: Path) -> None:
    write_template(tmp_path / "door.xlsx")
    with pytest.raises(InputError, match="a workbook holds a scenario, not a plan"):
        rightofway.load_plan(tmp_path / "door.xlsx")


def test_a_sheet_whose_bytes_were_changed_is_refused(tmp_path: Path) -> None:
    """A comment behind the cells is changed; only the checksum of the sheet shows it."""
    whole, changed = tmp_path / "whole.xlsx", tmp_path / "changed.xlsx"
    workbook = openpyxl.Workbook()
    workbook.active.title = "robots"
    workbook.active["A1"] = "name"
    workbook.save(whole)
    with zipfile.ZipFile(whole) as old, zipfile.ZipFile(changed, "w") as new:
        for part in old.namelist():
            end = b"<!-- behind -->" if "worksheets" in part else b""
            new.writestr(part, old.read(part) + end)
    changed.write_bytes(changed.read_bytes().replace(b"<!-- behind", b"<!-- before"))
    with pytest.raises(InputError, match="broken"):
        read_sheets(changed, {"robots"}, Faults())
