"""Scenarios written as a workbook, with hints and lists of choices where a user fills it in."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.extras import load_library
from rightofway.files import make_archive, write_whole
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.tables import SPOTS
from rightofway.model.attributes import Attribute
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES

WALL, HEAD = "404040", "D9E2EF"
"""Fills of blocked cells and of headings."""

ROWS = 1000
"""Rows with hints, below the headings."""

Hint = tuple[str, str, str]
"""A key, what it is, and the choices with commas between, if it has a few."""


def _list_hints(attributes: Sequence[Attribute]) -> Iterator[Hint]:
    for attribute in attributes:
        yield attribute.key, attribute.description, ",".join(attribute.words)


ROBOT_HINTS: tuple[Hint, ...] = (
    ("name", "a name of its own", ""),
    ("home", "where it begins and ends: a cell of the map like map!A1, or N0, [0, 2], a name", ""),
    ("target", "where it works, written like home; for several places use stop 1, stop 2, …", ""),
    ("work", "how long it works there; empty is 0", ""),
    *_list_hints(ROBOT_ATTRIBUTES),
    ("size", "[length, width] instead of a radius: the circle around it [length unit]", ""),
)
"""Empty cells of a robot follow the rules."""

RULE_HINTS: tuple[Hint, ...] = (
    *_list_hints(RULE_ATTRIBUTES),
    ("cell_size", "side of a cell of the map", ""),
    ("y", "down, or up: which way y grows", "down,up"),
    ("origin", "[x, y] of the map's lower left corner on the site", ""),
    ("length unit", "what lengths are measured in: mm, cm or m", "mm,cm,m"),
    ("time unit", "what times are measured in: ms, s, min or h", "ms,s,min,h"),
    ("start", "the instant of time 0, like 2026-11-28T06:00, for times of day", ""),
    ("homes", "parking: robots without a home start from parking and charging places", "parking"),
)

HELP = (
    "Fill in the sheets map, robots and rules, save the file, then run:",
    "    rightofway plan FILE.xlsx --page plan.html",
    "    rightofway plan FILE.xlsx -o result.xlsx",
    "map: one cell of the sheet is one cell of the floor. Write . for free and @ for blocked, or",
    "fill cells: a dark colour is blocked, whatever is written there; an empty cell without a dark",
    "colour is free.",
    "robots: one robot in a row. Select a cell to see what belongs there. A place is a cell of the",
    "map (write map!A1, or type = and click on the cell), its number (N0 is the first cell, they",
    "are counted row by row), its [row, column] from 0, or the name of a vertex.",
    "Several stops: replace target and work by the columns stop 1, work 1, stop 2, work 2, …",
    "Instead of map, the sheets vertices (name, x, y) and edges (from, to, length, both_ways).",
    "A vertex with true in its column parking or charging is such a place: where the rule homes is",
    "parking, robots without a home start there. With true in column pass, robots only drive",
    "through the vertex.",
    "closures, if needed: a place in column at, or [A, B] in column edge; from, until, radius.",
    "actions, if needed: a place in column name; work, pick, drop: the actions there.",
    "rules: an empty value stands for the default. Other sheets are not read.",
)

OF_JOBS = ("jobs", "batteries", "charging")
"""Keys of a document that only a scenario with jobs has."""

NUMBER_DIGITS = 11
"""Most digits of a number in a cell; one with more is text. A spreadsheet keeps 15 digits, and the
reader takes a number of 12 or more that is next to a simple fraction for that fraction."""

TEMPLATE: dict[str, Any] = {
    "format": SCENARIO_FORMAT,
    "map": {"grid": ["...", "@.@", "..."]},
    "robots": [
        {"name": "R1", "home": "map!A1", "target": "map!A3"},
        {"name": "R2", "home": "map!C1", "target": "map!C3", "speed": "1/2", "work": 3},
    ],
    "rules": {},
}


def write_template(path: Path | str) -> None:
    """Write a small scenario as a workbook to be edited: a door, and two robots.

    Parameters
    ----------
    path
        Where.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    write_whole(path, format_workbook(TEMPLATE))


def format_workbook(document: dict[str, Any]) -> bytes:
    """Return the workbook of a scenario document.

    Parameters
    ----------
    document
        A document with its map inlined.

    Raises
    ------
    InputError
        If a part of it has no place in the sheets.
    """
    openpyxl = load_library("openpyxl", "a workbook")
    _refuse_more(document)
    workbook = openpyxl.Workbook()
    workbook.remove(workbook.active)
    where = document["map"]
    if "grid" in where:
        _write_grid(workbook.create_sheet("map"), where["grid"])
    else:
        _write_roadmap(workbook, where["roadmap"])
    _write_robots(workbook.create_sheet("robots"), document["robots"])
    of_map = {key: where[key] for key in where if key not in {"grid", "roadmap", "obstacles"}}
    given = {**document.get("rules", {}), **of_map}
    given |= {f"{key} unit": unit for key, unit in document.get("units", {}).items()}
    given |= {key: document[key] for key in ("charging", "start") if key in document}
    _write_rules(workbook.create_sheet("rules"), given)
    if "closures" in document:
        _write_closures(workbook.create_sheet("closures"), document["closures"])
    if "jobs" in document:
        _write_jobs(workbook.create_sheet("jobs"), document["jobs"])
    for key in ("batteries", "actions"):
        if key in document:
            records = [{"name": name, **own} for name, own in document[key].items()]
            _write_records(workbook.create_sheet(key), ["name"], records)
    sheet = workbook.create_sheet("how to")
    sheet.column_dimensions["A"].width = 100
    for line in HELP:
        sheet.append([line])
    return make_archive(workbook.save)


def _refuse_more(document: dict[str, Any]) -> None:
    """Refuse a document with parts that would be lost."""
    known = {"format", "map", "robots", "rules", "units", "start", "closures", "actions", *OF_JOBS}
    more = document.keys() - known
    roadmap = document["map"].get("roadmap", {})
    more |= roadmap.keys() - {"vertices", "edges", *SPOTS}
    if more:
        message = f"a workbook has no place for {' and '.join(sorted(more))} (write .yaml or .json)"
        raise InputError.at("", message)


def _write_grid(sheet: Any, lines: Sequence[str]) -> None:
    """Write a map; blocked cells are coloured by a rule, so that another character changes them."""
    from openpyxl.formatting.rule import FormulaRule  # type: ignore[import-untyped]
    from openpyxl.styles import (  # type: ignore[import-untyped]
        Alignment,
        Border,
        Font,
        PatternFill,
        Side,
    )
    from openpyxl.utils import get_column_letter  # type: ignore[import-untyped]

    side = Side(style="thin", color="BFBFBF")
    border, centre = Border(side, side, side, side), Alignment("center", "center")
    faint = Font(name="Calibri", size=11, color="A6A6A6")
    for row, line in enumerate(lines, 1):
        for column, character in enumerate(line, 1):
            cell = sheet.cell(row, column, character)
            cell.border, cell.alignment, cell.font = border, centre, faint
    for column in range(1, len(lines[0]) + 1):
        sheet.column_dimensions[get_column_letter(column)].width = 4
    last = f"{get_column_letter(len(lines[0]))}{len(lines)}"
    is_wall = 'AND(LEN(A1)=1,ISERROR(FIND(A1,".GS")))'
    wall = PatternFill("solid", bgColor=WALL)
    sheet.conditional_formatting.add(f"A1:{last}", FormulaRule(formula=[is_wall], fill=wall))
    hint = "Write . for free and @ for blocked, or fill the cell: dark is blocked."
    _add_hint(sheet, f"A1:{last}", "map", hint, ".,@", strict=False)


def _write_robots(sheet: Any, robots: Sequence[dict[str, Any]]) -> None:
    from rightofway.io.scenario.shape import OF_JOBS as ROBOT_KEYS_OF_JOBS
    from rightofway.io.scenario.shape import RobotDocument

    most = max((len(robot.get("stops", ())) for robot in robots), default=0)
    trips = [robot.get("stops") or [_get_only_stop(robot)] for robot in robots]
    of_stop = ("work", "actions") if any("actions" in stop for stop in chain(*trips)) else ("work",)
    stops = [f"{noun} {k}" for k in range(1, most + 1) for noun in ("stop", *of_stop)]
    hints = {key: (text, choices) for key, text, choices in ROBOT_HINTS}
    usual = [key for key in hints if not (stops and key in {"target", "work"})]
    keys = [*usual[:2], *stops, *usual[2:]]
    more = {*ROBOT_KEYS_OF_JOBS, *(() if stops else ("actions",))}
    keys += dict.fromkeys(key for robot in robots for key in robot if key in more)
    rows = []
    for robot, trip in zip(robots, trips, strict=True):
        cells = {key: _convert_to_cell(value) for key, value in robot.items() if key != "stops"}
        for number, stop in enumerate(trip if stops else (), 1):
            cells[f"stop {number}"] = stop.get("at")
            cells |= {f"{key} {number}": _convert_to_cell(stop.get(key)) for key in of_stop}
        rows.append([cells.get(key) for key in keys])
    _write_table(sheet, keys, rows)
    hints |= {"stop": ("a place to work at, in order", "")}
    for column, key in enumerate(keys, 1):
        kind = key.rstrip(" 0123456789")
        text, choices = hints.get(kind) or (_find_description(RobotDocument, kind), "")
        letter = sheet.cell(1, column).column_letter
        _add_hint(sheet, f"{letter}2:{letter}{ROWS}", key, text, choices)


def _get_only_stop(robot: dict[str, Any]) -> dict[str, Any]:
    """Return the stop of a robot with a target."""
    keys = {"at": "target", "work": "work", "actions": "actions"}
    return {key: robot[name] for key, name in keys.items() if name in robot}


def _write_rules(sheet: Any, given: dict[str, Any]) -> None:
    from rightofway.io.scenario.shape import MapDocument

    _write_table(sheet, ["rule", "value", "what it is"], [])
    more = [key for key in given if key not in {hint[0] for hint in RULE_HINTS}]
    hints = (*RULE_HINTS, *((key, _find_description(MapDocument, key), "") for key in more))
    for row, (key, text, choices) in enumerate(hints, 2):
        sheet.cell(row, 1, key)
        sheet.cell(row, 2, _convert_to_cell(given.get(key))).number_format = "@"
        sheet.cell(row, 3, text)
        _add_hint(sheet, f"B{row}", key, text, choices)
    for letter, width in zip("ABC", (14, 14, 80), strict=True):
        sheet.column_dimensions[letter].width = width


def _write_closures(sheet: Any, closures: Sequence[dict[str, Any]]) -> None:
    from rightofway.io.scenario.shape import ClosureDocument

    keys = ["at", "edge", "from", "until", "radius"]
    _write_table(
        sheet, keys, [[_convert_to_cell(closure.get(key)) for key in keys] for closure in closures]
    )
    for letter, key in zip("ABCDE", keys, strict=True):
        _add_hint(
            sheet, f"{letter}2:{letter}{ROWS}", key, _find_description(ClosureDocument, key), ""
        )


def _write_jobs(sheet: Any, jobs: Sequence[dict[str, Any]]) -> None:
    from rightofway.io.scenario.work_shape import JobDocument

    keys = _write_records(sheet, ["name", "at", "work", "pickup", "dropoff"], jobs)
    for column, key in enumerate(keys, 1):
        letter, text = sheet.cell(1, column).column_letter, _find_description(JobDocument, key)
        _add_hint(sheet, f"{letter}2:{letter}{ROWS}", key, text, "")


def _write_records(
    sheet: Any, usual: Sequence[str], records: Sequence[dict[str, Any]]
) -> Sequence[str]:
    """Write a row for each mapping; return the headings, the usual ones and all others in use."""
    keys = list(dict.fromkeys([*usual, *chain.from_iterable(records)]))
    rows = [[_convert_to_cell(record.get(key)) for key in keys] for record in records]
    _write_table(sheet, keys, rows)
    return keys


def _write_roadmap(workbook: Any, roadmap: dict[str, Any]) -> None:
    vertices, edges = workbook.create_sheet("vertices"), workbook.create_sheet("edges")
    rows = []
    for name, vertex in roadmap["vertices"].items():
        x, y = vertex["at"] if isinstance(vertex, dict) else vertex
        more = (
            {key: _convert_to_cell(vertex[key]) for key in vertex if key != "at"}
            if isinstance(vertex, dict)
            else {}
        )
        spots = {key: "true" for key in SPOTS if name in roadmap.get(key, ())}
        rows.append(
            {"name": name, "x": _convert_to_cell(x), "y": _convert_to_cell(y), **more, **spots}
        )
    heads = list(dict.fromkeys(chain(("name", "x", "y"), *rows)))
    _write_table(vertices, heads, [[row.get(key) for key in heads] for row in rows])
    keys = list(dict.fromkeys(["from", "to", "length", "both_ways", *chain(*roadmap["edges"])]))
    ways = [[_convert_to_cell(edge.get(key)) for key in keys] for edge in roadmap["edges"]]
    _write_table(edges, keys, ways)
    hint = "true: it can be driven back"
    _add_hint(edges, f"D2:D{max(ROWS, len(ways) + 1)}", "both_ways", hint, "true,false")


def _write_table(sheet: Any, keys: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """Write headings that stay in sight, and rows; columns are text, so that 1/2 is no date."""
    from openpyxl.styles import Font, PatternFill

    sheet.append(list(keys))
    for cell in sheet[1]:
        cell.font, cell.fill = (
            Font(name="Calibri", size=11, bold=True),
            PatternFill("solid", fgColor=HEAD),
        )
        sheet.column_dimensions[cell.column_letter].width = 14
        sheet.column_dimensions[cell.column_letter].number_format = "@"
    sheet.freeze_panes = "A2"
    for number, row in enumerate(rows, 2):
        for column, value in enumerate(row, 1):
            if value is None:
                continue
            cell = sheet.cell(number, column, value)
            cell.number_format = "@"
            if isinstance(value, str):
                cell.data_type = "s"  # a name that begins with = is no formula


def _add_hint(
    sheet: Any, cells: str, title: str, text: str, choices: str, *, strict: bool = True
) -> None:
    """Show a hint when a cell is selected, and a list of choices where there are a few."""
    from openpyxl.worksheet.datavalidation import DataValidation  # type: ignore[import-untyped]

    rule = DataValidation(type="list" if choices else None, allow_blank=True)
    if choices:
        rule.formula1, rule.showErrorMessage = f'"{choices}"', strict
        rule.errorTitle, rule.error = title, f"give one of: {choices.replace(',', ', ')}"
    rule.promptTitle, rule.prompt, rule.showInputMessage = title, text, True
    sheet.add_data_validation(rule)
    rule.add(cells)


def _find_description(model: Any, key: str) -> str:
    """Return the description of a key of a document."""
    fields = {field.alias or name: field for name, field in model.fields.items()}
    return fields[key].description if key in fields else ""


def _convert_to_cell(value: Any) -> Any:
    """Return a value of a document as a cell holds it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and float(f"{value:.{NUMBER_DIGITS}g}") != value:
        return repr(value)  # text: a number would lose its last digits
    if isinstance(value, dict) or (
        isinstance(value, list) and any(isinstance(item, dict) for item in value)
    ):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple) and all(isinstance(item, str | dict) for item in value):
        return json.dumps(value, ensure_ascii=False)  # a name may look like a number
    return f"[{', '.join(map(str, value))}]" if isinstance(value, list | tuple) else value
