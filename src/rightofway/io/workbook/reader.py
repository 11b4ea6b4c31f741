"""A workbook read as a scenario: sheets map (or vertices and edges), robots and rules."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, Steps, Where, in_file, nearest, shown
from rightofway.io.faults import Faults
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.scenario.reader import Loaded, read_scenario
from rightofway.io.tables import NOTES, CellDocument, heading_key, robots_of_rows, value_of
from rightofway.io.workbook.sheets import Sheet, read_sheets, reference
from rightofway.model.robot import RULE_ATTRIBUTES

SHEETS = ("map", "robots", "rules", "vertices", "edges", "closures")
"""Sheets that are read, by lower-case name."""

SPOTS = ("parking", "charging")
"""Columns of vertices that are true for such a place."""

VERTEX_KEYS = ("name", "x", "y", "barred", "surcharge", *SPOTS)

MAX_CELLS = 1_000_000
"""Cells of a map, at most."""

TRUTHS = {it.key for it in RULE_ATTRIBUTES if it.kind == "truth"}
"""Rules that are true or false."""

YES_NO = {"true": True, "yes": True, "false": False, "no": False}

HOMES = "homes"
"""The row of the rules sheet that belongs to the whole scenario."""

UNIT_KEYS = {"length_unit": "length", "time_unit": "time"}
"""Rows of the rules sheet that are units, and their keys there."""


def load_workbook_scenario(path: Path | str) -> Loaded:
    """Return the scenario of a workbook with the notes of its reader.

    Parameters
    ----------
    path
        A file that ends in .xlsx.

    Raises
    ------
    InputError
        With every independent fault, its sheet and cell, its value and the remedy.
    """
    path = Path(path)
    with in_file(str(path)):
        faults, notes = Faults(), list[str]()
        found = _document(read_sheets(path, SHEETS, faults), faults, notes)
        with found.locate():
            loaded = read_scenario(found.part, path.parent)
        return Loaded(scenario=loaded.scenario, notes=(*notes, *loaded.notes))


def _document(sheets: Mapping[str, Sheet], faults: Faults, notes: list[str]) -> CellDocument:
    """Return the scenario document of the sheets, and where each place of it stands."""
    document: dict[str, Any] = {"format": SCENARIO_FORMAT}
    cells: dict[Steps, Where] = {}
    offset = (1, 1)
    if "map" in sheets and "vertices" in sheets:
        faults.note("map", "a map and vertices are given (take one of the two sheets out)")
    elif "map" in sheets:
        grid = faults.attempt("", _grid, sheets["map"], notes)
        if grid is not None:
            lines, offset, grid_cells = grid
            document["map"] = {"grid": lines}
            cells |= grid_cells
    elif "vertices" in sheets and "edges" in sheets:
        drawn = faults.attempt("", _roadmap, sheets["vertices"], sheets["edges"], cells)
        if drawn is not None:
            document["map"] = {"roadmap": drawn}
    else:
        missing = "edges" if "vertices" in sheets else "map"
        faults.note("", f"the sheet {missing} is missing (add it; `rightofway new` writes one)")
    if "robots" in sheets:
        robots = _robots(sheets["robots"], offset)
        document["robots"] = robots.part
        cells |= {("robots",): sheets["robots"].location, **robots.cells}
        faults.add(robots.faults)
    else:
        faults.note("", "the sheet robots is missing (add it; `rightofway new` writes one)")
    if "rules" in sheets:
        _add_rules(sheets["rules"], document, cells, faults)
        cells["rules",] = sheets["rules"].location
    document |= _closures(sheets, offset, cells, faults)
    if not document.get("robots") or "map" not in document:
        faults.stop()
    return CellDocument(part=document, cells=cells, faults=faults.found)


def _grid(
    sheet: Sheet, notes: list[str]
) -> tuple[list[str], tuple[int, int], dict[Steps, Where]] | None:
    """Return the rows of a map, its first row and column, and the cells of its rows."""
    used = sheet.values.keys() | sheet.dark.keys()
    if not used:
        message = "the map is empty (write . for free and @ for blocked, or fill cells)"
        raise InputError.at(sheet.location, message)
    top, left = min(row for row, _ in used), min(column for _, column in used)
    bottom, right = max(row for row, _ in used), max(column for _, column in used)
    count = (bottom - top + 1) * (right - left + 1)
    if count > MAX_CELLS:
        last = sheet.cell(*max(used, key=lambda each: (each[0] + each[1], each)))
        message = (
            f"the map reaches from {sheet.cell(top, left).cell} to here: {count} cells, more than"
            f" {MAX_CELLS} (clear what stands beside the map)"
        )
        raise InputError.at(last, message)
    faults, empty = Faults(), []
    lines = []
    for row in range(top, bottom + 1):
        line = ""
        for column in range(left, right + 1):
            value, dark = sheet.values.get((row, column)), sheet.dark.get((row, column))
            if value is None or dark:
                if value is dark is None:
                    empty.append((row, column))
                line += "@" if dark else "."
            elif isinstance(value, str) and len(value) == 1:
                line += value
            else:
                message = f"{shown(value)} is no cell of a map (write . or @, or fill the cell)"
                faults.note(sheet.cell(row, column), message)
        lines.append(line)
    faults.stop()
    if empty:
        count_as = (
            "empty cell of the map counts" if len(empty) == 1 else "empty cells of the map count"
        )
        notes.append(f"{len(empty)} {count_as} as free, the first is {sheet.cell(*empty[0]).cell}")
    cells: dict[Steps, Where] = {("map",): sheet.location, ("map", "grid"): sheet.location}
    cells |= {("map", "grid", k): sheet.cell(top + k, left) for k in range(len(lines))}
    return lines, (top, left), cells


def _robots(sheet: Sheet, offset: tuple[int, int]) -> CellDocument:
    from rightofway.io.scenario.shape import RobotDocument

    known = [field.alias or name for name, field in RobotDocument.model_fields.items()]
    rows = (
        (number, {column: _in_map(value, offset) for column, value in values.items()})
        for number, values in sheet.rows()
    )
    return robots_of_rows(rows, sheet.cell, known)


def _closures(
    sheets: Mapping[str, Sheet], offset: tuple[int, int], cells: dict[Steps, Where], faults: Faults
) -> dict[str, Any]:
    """Return the part of a document with the closures in the rows of a sheet, if there is one."""
    from rightofway.io.scenario.shape import ClosureDocument

    if "closures" not in sheets:
        return {}
    sheet = sheets["closures"]
    known = [field.alias or name for name, field in ClosureDocument.model_fields.items()]
    closures = list[dict[str, Any]]()
    for row, found, columns in faults.attempt("", _table, sheet, known) or ():
        place = ("closures", len(closures))
        cells[place] = sheet.cell(row, 1)
        cells |= {(*place, key): sheet.cell(row, column) for key, column in columns.items()}
        read = {
            key: faults.attempt(
                sheet.cell(row, columns[key]), value_of, key, _in_map(value, offset)
            )
            for key, value in found.items()
        }
        closures.append({key: value for key, value in read.items() if value is not None})
    return {"closures": closures}


def _in_map(value: Any, offset: tuple[int, int]) -> Any:
    """Return what a cell holds; for a reference to a cell of the map its row and column there."""
    cell = reference(value) if isinstance(value, str) else None
    if cell is None:
        return value
    return f"[{cell[0] - offset[0]}, {cell[1] - offset[1]}]"


def _add_rules(
    sheet: Sheet, document: dict[str, Any], cells: dict[Steps, Where], faults: Faults
) -> None:
    """Add the rows of the rules sheet: rules, units, and what belongs to the map."""
    from rightofway.io.scenario.shape import MAPS, MapDocument, RulesDocument

    rules = [field.alias or name for name, field in RulesDocument.model_fields.items()]
    of_map = [name for name in MapDocument.model_fields if name not in MAPS]
    known = [*rules, *of_map, *UNIT_KEYS, HOMES]
    seen = set[str]()
    parts: dict[str, dict[str, Any]] = {"rules": {}, "units": {}, "map": {}}
    for row, values in sheet.rows():
        name, value = values.get(1), values.get(2)
        key = heading_key(name)
        if key in {"rule", "rules", "key"} or name is None:
            continue
        if key not in known:
            near = nearest(key, known)
            hint = f"did you mean {near}?" if near else f"known: {', '.join(known)}"
            faults.note(sheet.cell(row, 1), f"{shown(name)} is no rule ({hint})")
            continue
        if key in seen:
            faults.note(sheet.cell(row, 1), f"the rule {key} is given twice (take one out)")
            continue
        seen.add(key)
        part = "units" if key in UNIT_KEYS else "map" if key in of_map else "rules"
        path: Steps = (key,) if key == HOMES else (part, UNIT_KEYS.get(key, key))
        cells[path] = sheet.cell(row, 2)
        read = (
            faults.attempt(sheet.cell(row, 2), value_of, key, value) if value is not None else None
        )
        if read is not None and key == HOMES:
            document[HOMES] = read
        elif read is not None:
            is_word = isinstance(read, str) and key in TRUTHS
            parts[part][UNIT_KEYS.get(key, key)] = (
                YES_NO.get(read.lower(), read) if is_word else read
            )
    if parts["rules"]:
        document["rules"] = parts["rules"]
    if parts["units"]:
        document["units"] = parts["units"]
    if "map" in document:
        document["map"] |= parts["map"]


def _roadmap(vertices: Sheet, edges: Sheet, cells: dict[Steps, Where]) -> dict[str, Any]:
    """Return the roadmap of a sheet of vertices and a sheet of edges."""
    from rightofway.io.scenario.shape import EdgeDocument

    faults, positions, first_row = Faults(), dict[str, Any](), dict[str, int]()
    spots: dict[str, list[str]] = {key: [] for key in SPOTS}
    for row, found, columns in faults.attempt("", _table, vertices, VERTEX_KEYS) or ():
        name = str(found.get("name", ""))
        missing = [key for key in ("name", "x", "y") if key not in found]
        if missing:
            message = f"has no {' and no '.join(missing)} (give name, x and y)"
            faults.note(vertices.cell(row, 1), message)
        if name in first_row:
            message = f"{shown(name)} is in {{other}} already (take one out)"
            faults.note(vertices.cell(row, 1), message, vertices.cell(first_row[name], 1))
        first_row.setdefault(name, row)
        position = [found.get("x", 0), found.get("y", 0)]
        more = {key: value_of(key, found[key]) for key in ("barred", "surcharge") if key in found}
        positions[name] = {"at": position, **more} if more else position
        for key, names in spots.items():
            is_one = YES_NO.get(str(found.get(key, False)).lower())
            if is_one is None:
                message = f"{shown(found[key])} is neither true nor false (write one of them)"
                faults.note(vertices.cell(row, columns[key]), message)
            elif is_one:
                names.append(name)
        cells["map", "roadmap", "vertices", name] = vertices.cell(row, 1)
    known = [field.alias or name for name, field in EdgeDocument.model_fields.items()]
    ways = list[dict[str, Any]]()
    for row, found, columns in faults.attempt("", _table, edges, known) or ():
        place = ("map", "roadmap", "edges", len(ways))
        cells[place] = edges.cell(row, 1)
        cells |= {(*place, key): edges.cell(row, column) for key, column in columns.items()}
        way = dict[str, Any]()
        for key, value in found.items():
            at = edges.cell(row, columns[key])
            is_name = key in {"from", "to"}
            way[key] = str(value) if is_name else faults.attempt(at, value_of, key, value)
        both = way.get("both_ways")
        if isinstance(both, str):
            way["both_ways"] = YES_NO.get(both.lower(), both)
        ways.append(way)
    faults.stop()
    drawn = ("map", "roadmap")
    cells |= {drawn[:1]: vertices.location, drawn: vertices.location}
    cells |= {(*drawn, "vertices"): vertices.location, (*drawn, "edges"): edges.location}
    spots = {key: names for key, names in spots.items() if names}
    return {"vertices": positions, "edges": ways, **spots}


def _table(
    sheet: Sheet, known: Collection[str]
) -> list[tuple[int, dict[str, Any], dict[str, int]]]:
    """Return the rows of a sheet: number, values by heading, and the column of each heading."""
    faults, rows = Faults(), sheet.rows()
    first, headings = next(rows, (1, {}))
    columns: dict[str, int] = {}
    for column, heading in headings.items():
        key = heading_key(heading)
        if key in known:
            columns[key] = column
        elif key not in NOTES:
            near = nearest(key, known)
            hint = f"did you mean {near}?" if near else f"known: {', '.join(known)}"
            faults.note(sheet.cell(first, column), f"{shown(heading)} is unknown ({hint})")
    faults.stop()
    return [
        (row, {key: values[at] for key, at in columns.items() if at in values}, columns)
        for row, values in rows
    ]
