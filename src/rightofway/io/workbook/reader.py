"""A workbook read as a scenario: sheets map (or vertices and edges), robots and rules."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, Steps, Where, find_nearest, name_file, quote
from rightofway.facts import Fact
from rightofway.io.faults import Faults, list_keys
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.scenario.reader import Loaded, read_scenario
from rightofway.io.tables import (
    SPOTS,
    WORD_KEYS,
    CellDocument,
    Row,
    find_heading_key,
    read_cell_value,
    read_jobs_of_rows,
    read_records,
    read_robots_of_rows,
)
from rightofway.io.workbook.sheets import Sheet, find_reference, read_sheets

SHEETS = ("map", "robots", "rules", "vertices", "edges", "closures", "jobs", "batteries", "actions")
"""Sheets that are read, by lower-case name."""

ATTRIBUTES = ("barred", "surcharge", "pass", "heading", "turning")
"""Columns of vertices whose values are those of a document."""

VERTEX_KEYS = ("name", "x", "y", *ATTRIBUTES, *SPOTS)

MAX_CELLS = 1_000_000
"""Cells of a map, at most."""

OF_SCENARIO = ("homes", "charging", "start")
"""Rows of the rules sheet that belong to the whole scenario."""

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
    with name_file(str(path)):
        faults, notes = Faults(), list[Fact]()
        document = _make_document(read_sheets(path, SHEETS, faults), faults, notes)
        with document.locate():
            loaded = read_scenario(document.part, path.parent)
        return Loaded(scenario=loaded.scenario, notes=(*notes, *loaded.notes))


def _make_document(sheets: Mapping[str, Sheet], faults: Faults, notes: list[Fact]) -> CellDocument:
    """Return the scenario document of the sheets, and where each place of it stands."""
    from rightofway.io.scenario.shape import ClosureDocument, RobotDocument

    document: dict[str, Any] = {"format": SCENARIO_FORMAT}
    cells: dict[Steps, Where] = {}
    offset = (1, 1)
    if "map" in sheets and "vertices" in sheets:
        faults.note("map", "a map and vertices are given (take one of the two sheets out)")
    elif "map" in sheets:
        grid = faults.attempt("", _read_grid, sheets["map"], notes)
        if grid is not None:
            lines, offset, grid_cells = grid
            document["map"] = {"grid": lines}
            cells |= grid_cells
    elif "vertices" in sheets and "edges" in sheets:
        drawn = _read_roadmap(sheets["vertices"], sheets["edges"])
        document["map"] = {"roadmap": drawn.part}
        cells |= drawn.cells
        faults.add(drawn.faults)
    else:
        missing = "edges" if "vertices" in sheets else "map"
        faults.note("", f"the sheet {missing} is missing (add it; `rightofway new` writes one)")
    if "robots" in sheets:
        sheet = sheets["robots"]
        robots = read_robots_of_rows(
            _read_rows(sheet, offset), sheet.locate_cell, list_keys(RobotDocument)
        )
        document["robots"] = robots.part
        cells |= {("robots",): sheet.location, **robots.cells}
        faults.add(robots.faults)
    else:
        faults.note("", "the sheet robots is missing (add it; `rightofway new` writes one)")
    if "rules" in sheets:
        _add_rules(sheets["rules"], document, cells, faults)
        cells["rules",] = sheets["rules"].location
    if "closures" in sheets:
        sheet, known = sheets["closures"], list_keys(ClosureDocument)
        closures = read_records(
            _read_rows(sheet, offset), sheet.locate_cell, ("closures",), known, noun="a closure"
        )
        document["closures"] = closures.part
        cells |= closures.cells
        faults.add(closures.faults)
    _add_work(sheets, offset, document, cells, faults)
    if not document.get("robots") or "map" not in document:
        faults.stop()
    return CellDocument(part=document, cells=cells, faults=faults.found)


def _add_work(
    sheets: Mapping[str, Sheet],
    offset: tuple[int, int],
    document: dict[str, Any],
    cells: dict[Steps, Where],
    faults: Faults,
) -> None:
    """Add the jobs, the batteries and the actions of places."""
    from rightofway.io.scenario.shape import PlaceActionsDocument
    from rightofway.io.scenario.work_shape import BatteryDocument, JobDocument

    if "jobs" in sheets:
        sheet = sheets["jobs"]
        rows = _read_rows(sheet, offset)
        jobs = read_jobs_of_rows(rows, sheet.locate_cell, list_keys(JobDocument))
        document["jobs"] = jobs.part
        cells |= {("jobs",): sheet.location, **jobs.cells}
        faults.add(jobs.faults)
    for key, shape, noun in (
        ("batteries", BatteryDocument, "a battery"),
        ("actions", PlaceActionsDocument, "actions of a place"),
    ):
        if key in sheets:
            _add_named(sheets[key], (key, list_keys(shape), noun), document, cells, faults)


def _add_named(
    sheet: Sheet,
    records: tuple[str, Sequence[str], str],
    document: dict[str, Any],
    cells: dict[Steps, Where],
    faults: Faults,
) -> None:
    """Add a mapping with the names of rows as keys; ``records`` are its key, keys and noun."""
    key, known, noun = records
    table = read_records(sheet.list_rows(), sheet.locate_cell, (key,), ["name", *known], noun=noun)
    names = [str(record.pop("name", "")) for record in table.part]
    for index, name in enumerate(names):
        if name in names[:index]:
            message = f"{quote(name)} is in {{other}} already (take one out)"
            faults.note(table.cells[key, index], message, table.cells[key, names.index(name)])
    document[key] = dict(zip(names, table.part, strict=True))
    cells[key,] = sheet.location
    for (_, row, *steps), place in table.cells.items():
        cells[key, names[int(row)], *steps] = place
    faults.add(table.faults)


def _read_grid(
    sheet: Sheet, notes: list[Fact]
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
        last = sheet.locate_cell(*max(used, key=lambda cell: (cell[0] + cell[1], cell)))
        message = (
            f"the map reaches from {sheet.locate_cell(top, left).cell} to here: {count} cells,"
            f" more than {MAX_CELLS} (clear what stands beside the map)"
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
                message = f"{quote(value)} is no cell of a map (write . or @, or fill the cell)"
                faults.note(sheet.locate_cell(row, column), message)
        lines.append(line)
    faults.stop()
    if empty:
        first = str(sheet.locate_cell(*empty[0]).cell)
        notes.append(Fact("empty cells free", cells=len(empty), cell=first))
    cells: dict[Steps, Where] = {("map",): sheet.location, ("map", "grid"): sheet.location}
    cells |= {("map", "grid", k): sheet.locate_cell(top + k, left) for k in range(len(lines))}
    return lines, (top, left), cells


def _read_rows(sheet: Sheet, offset: tuple[int, int]) -> Iterator[Row]:
    """Yield the rows of a sheet whose places may be cells of the map."""
    for number, values in sheet.list_rows():
        yield (
            number,
            {column: _convert_reference(value, offset) for column, value in values.items()},
        )


def _convert_reference(value: Any, offset: tuple[int, int]) -> Any:
    """Return the value of a cell; for a reference to a cell of the map its row and column there."""
    cell = find_reference(value) if isinstance(value, str) else None
    if cell is None:
        return value
    return f"[{cell[0] - offset[0]}, {cell[1] - offset[1]}]"


def _add_rules(
    sheet: Sheet, document: dict[str, Any], cells: dict[Steps, Where], faults: Faults
) -> None:
    """Add the rows of the rules sheet: rules, units, and keys of the map."""
    from rightofway.io.scenario.shape import MAPS, MapDocument, RulesDocument

    rules = list_keys(RulesDocument)
    of_map = [name for name in MapDocument.fields if name not in MAPS]
    known = [*rules, *of_map, *UNIT_KEYS, *OF_SCENARIO]
    seen = set[str]()
    parts: dict[str, dict[str, Any]] = {"rules": {}, "units": {}, "map": {}}
    for row, values in sheet.list_rows():
        name, value = values.get(1), values.get(2)
        key = find_heading_key(name)
        if key in {"rule", "rules", "key"} or name is None:
            continue
        if key not in known:
            near = find_nearest(key, known)
            hint = f"did you mean {near}?" if near else f"known: {', '.join(known)}"
            faults.note(sheet.locate_cell(row, 1), f"{quote(name)} is no rule ({hint})")
            continue
        if key in seen:
            faults.note(sheet.locate_cell(row, 1), f"the rule {key} is given twice (take one out)")
            continue
        seen.add(key)
        part = "units" if key in UNIT_KEYS else "map" if key in of_map else "rules"
        path: Steps = (key,) if key in OF_SCENARIO else (part, UNIT_KEYS.get(key, key))
        cells[path] = sheet.locate_cell(row, 2)
        read = (
            faults.attempt(sheet.locate_cell(row, 2), read_cell_value, key, value)
            if value is not None
            else None
        )
        if read is not None and key in OF_SCENARIO:
            document[key] = read
        elif read is not None:
            parts[part][UNIT_KEYS.get(key, key)] = read
    if parts["rules"]:
        document["rules"] = parts["rules"]
    if parts["units"]:
        document["units"] = parts["units"]
    if "map" in document:
        document["map"] |= parts["map"]


def _read_roadmap(vertices: Sheet, edges: Sheet) -> CellDocument:
    """Return the roadmap of a sheet of vertices and a sheet of edges."""
    from rightofway.io.scenario.shape import EdgeDocument

    path, faults, first = ("map", "roadmap"), Faults(), dict[str, int]()
    table = read_records(
        vertices.list_rows(), vertices.locate_cell, (), VERTEX_KEYS, noun="a vertex"
    )
    ways = read_records(
        edges.list_rows(),
        edges.locate_cell,
        (*path, "edges"),
        list_keys(EdgeDocument),
        noun="an edge",
        words={*WORD_KEYS, "from", "to", "id"},
    )
    faults.add((*table.faults, *ways.faults))
    cells: dict[Steps, Where] = {
        **{path[:k]: vertices.location for k in (1, 2)},
        (*path, "vertices"): vertices.location,
        (*path, "edges"): edges.location,
        **ways.cells,
    }
    positions = dict[str, Any]()
    spots: dict[str, list[str]] = {key: [] for key in SPOTS}
    for index, row_data in enumerate(table.part):
        name, row = row_data.get("name", ""), table.cells[index,]
        missing = [key for key in ("name", "x", "y") if key not in row_data]
        if missing:
            faults.note(row, f"has no {' and no '.join(missing)} (give name, x and y)")
        if name in first:
            message = f"{quote(name)} is in {{other}} already (take one out)"
            faults.note(row, message, table.cells[first[name],])
        first.setdefault(name, index)
        position = [row_data.get("x", 0), row_data.get("y", 0)]
        more = {key: row_data[key] for key in ATTRIBUTES if key in row_data}
        positions[name] = {"at": position, **more} if more else position
        for key, names in spots.items():
            if not isinstance(row_data.get(key, False), bool):
                message = f"{quote(row_data[key])} is neither true nor false (write one of them)"
                faults.note(table.cells[index, key], message)
            elif row_data.get(key):
                names.append(name)
        cells[*path, "vertices", name] = row
    drawn = {"vertices": positions, "edges": ways.part}
    drawn |= {key: names for key, names in spots.items() if names}
    return CellDocument(part=drawn, cells=cells, faults=faults.found)
