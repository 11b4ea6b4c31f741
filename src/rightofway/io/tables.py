"""Tables of robots, of a sheet or a CSV file, as the robots of a scenario document.

A row is a robot. Headings are the keys of a robot; several stops are columns ``stop 1``,
``work 1``, ``actions 1``, ``stop 2`` and so on.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from rightofway.errors import (
    InputError,
    InputFault,
    Location,
    Steps,
    Where,
    find_nearest,
    name_file,
    quote,
)
from rightofway.facts import Fact
from rightofway.io.content import read_text
from rightofway.io.faults import Faults
from rightofway.io.locations import locate_inner
from rightofway.io.yaml_text import parse_yaml
from rightofway.kinds.table import TRUTH
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES

NOTES = {"note", "notes", "hint", "comment", "remark"}
"""Columns that are not read."""

STOP = re.compile(r"(stop|work|actions) ?([1-9][0-9]?)")
"""Headings of several stops, the work and the actions there."""

PLACE_KEYS = {"home", "target", "at", "pickup", "dropoff"}
"""Keys whose values are places."""

SPOTS = ("parking", "charging")
"""Columns of vertices that are true for such a place."""

TRUTH_KEYS = {
    "both_ways",
    "pass",
    "turning",
    "urgent",
    *SPOTS,
    *(attribute.key for attribute in RULE_ATTRIBUTES if attribute.kind is TRUTH),
}
"""Keys whose values are true or false."""

YES_NO = {"true": True, "yes": True, "false": False, "no": False}

AT_STOP = {"stop": "at", "work": "work", "actions": "actions"}
"""The key of a stop for each heading."""

WORD_KEYS = {
    "name",
    "battery",
    "robot",
    "load_id",
    "load_type",
    *(attribute.key for attribute in (*ROBOT_ATTRIBUTES, *RULE_ATTRIBUTES) if attribute.is_text),
}
"""Keys whose values are text, also where they look like numbers."""

LIST_KEYS = {"types", "after"}
"""Keys whose values are lists of names, with commas between."""

DECIMAL_COMMA = re.compile(r"[+-]?(0,[0-9]+|[0-9]+,([0-9]{1,2}|[0-9]{4,}))")
"""A decimal as half of the world writes it; 1,000 may be a thousand and is refused."""

WHOLE = re.compile(r"[+-]?[0-9]{1,9}")

Row = tuple[int, Mapping[int, Any]]
"""The number of a row, and its values by column."""

CellOf = Callable[[int, int], Location]
"""Returns the place of a row and a column."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CellDocument:
    """A part of a document that was read from cells, and where each value of it stands.

    Attributes
    ----------
    part
        Plain data, as a document has it.
    cells
        For paths into the document, like ``("robots", 2, "speed")``, the place of the cell.
    faults
        Faults of cells, which are no part of the document.
    text
        Of JSON or YAML, the text in which lines of faults are looked up.
    notes
        What was left out.
    """

    part: Any
    cells: dict[Steps, Where] = field(default_factory=dict)
    faults: tuple[InputFault, ...] = ()
    text: str = ""
    notes: tuple[Fact, ...] = ()

    @contextmanager
    def locate(self) -> Iterator[None]:
        """Report faults of the document read inside at their cells, after those of the cells."""
        try:
            yield
        except InputError as error:
            places = {fault.location for fault in self.faults}
            moved = [fault.relocate(self.cells) for fault in error.faults]
            moved = [*locate_inner(moved, self.text)] if self.text else moved
            more = (fault for fault in moved if fault.location not in places)
            raise InputError([*self.faults, *more]) from None
        if self.faults:
            raise InputError(self.faults)


def read_records(
    rows: Iterable[Row],
    cell: CellOf,
    path: Steps,
    known: Iterable[str],
    *,
    noun: str,
    words: Collection[str] = WORD_KEYS,
    has_stops: bool = False,
) -> CellDocument:
    """Return the rows of a table as a list of mappings.

    Returns
    -------
    CellDocument
        The list. Faults are headings that are unknown or given twice, values without a heading, and
        cells that cannot be read.
    """
    rows, known, faults = iter(rows), list(known), Faults()
    columns, cells, records = dict[int, str](), dict[Steps, Where](), list[dict[str, Any]]()
    first, headings = next(rows, (1, {}))
    for column, heading in headings.items():
        key, place = find_heading_key(heading), cell(first, column)
        is_stop = has_stops and STOP.fullmatch(key) is not None
        if key in columns.values() and key not in NOTES:
            faults.note(place, f"the column {key!r} is given twice (take one out)")
            key = "note"
        elif not (is_stop or key in known or key in NOTES):
            near, listed = find_nearest(key, known), ", ".join(known)
            more = ", stop 1, work 1, …" if has_stops else ""
            hint = f"did you mean {near}?" if near else f"known: {listed}{more}"
            faults.note(place, f"{quote(heading)} is no key of {noun} ({hint})")
            key = "note"
        columns[column] = key
    for number, values in rows:
        record_path, record = (*path, len(records)), dict[str, Any]()
        cells[record_path] = cell(number, 1)
        for column in values.keys() - columns.keys():
            faults.note(cell(number, column), "a value without a heading (take it out)")
        for column, key in columns.items():
            if key in NOTES:
                continue
            cells[*record_path, key] = place = cell(number, column)
            if column in values:
                value = faults.attempt(place, read_cell_value, key, values[column], words)
                record |= {} if value is None else {key: value}
        records.append(record)
    return CellDocument(part=records, cells=cells, faults=faults.found)


def read_robots_of_rows(rows: Iterable[Row], cell: CellOf, known: Iterable[str]) -> CellDocument:
    """Return the robots of a table; columns ``stop 1``, ``work 1``, … become stops."""
    keys = [key for key in known if key != "stops"]
    table = read_records(rows, cell, ("robots",), keys, noun="a robot", has_stops=True)
    if not table.part:
        fault = InputFault(cell(1, 1), "there is no robot (write headings, then one robot a row)")
        return replace(table, faults=(*table.faults, fault))
    for index, robot in enumerate(table.part):
        stops: dict[int, dict[str, Any]] = {}
        given = {key: match for key in robot if (match := STOP.fullmatch(key))}
        for key, match in given.items():
            stops.setdefault(int(match[2]), {})[AT_STOP[match[1]]] = robot.pop(key)
        numbers = sorted(stops)  # stops are counted as they are given: one may be left empty
        for key, match in given.items():
            place = ("robots", index, "stops", numbers.index(int(match[2])))
            table.cells.setdefault(place, table.cells["robots", index, key])
            table.cells[*place, AT_STOP[match[1]]] = table.cells["robots", index, key]
        if stops:
            robot["stops"] = [stops[number] for number in numbers]
    return table


def read_jobs_of_rows(rows: Iterable[Row], cell: CellOf, known: Iterable[str]) -> CellDocument:
    """Return the jobs of a table: one a row, by the keys of a job."""
    return read_records(rows, cell, ("jobs",), known, noun="a job")


def find_heading_key(heading: Any) -> str:
    """Return the key that a heading stands for: ``Speed [m/s]`` is ``speed``."""
    words = re.sub(r"\[[^\[\]]*\]|\([^()]*\)|\*", "", str(heading)).strip().lower()
    return words if STOP.fullmatch(words) else "_".join(words.split())


def read_cell_value(key: str, value: Any, words: Collection[str] = WORD_KEYS) -> Any:
    """Return the value of a cell as a document has it under a key; ``words`` are keys of text."""
    if isinstance(value, str) and key not in words and value[0] in "[{":
        try:
            return parse_yaml(value)
        except InputError as error:  # its line is one of the cell
            raise InputError.at("", error.faults[0].words) from None
    if key in LIST_KEYS and not isinstance(value, bool):
        return [name.strip() for name in str(value).split(",")]
    if isinstance(value, str):
        return _read_text(key, value, words)
    return str(value) if key in words and not isinstance(value, bool) else value


def _read_text(key: str, value: str, words: Collection[str]) -> Any:
    """Return the value of a cell with text that is no list and no mapping."""
    if key in TRUTH_KEYS:
        return YES_NO.get(value.lower(), value)
    if key in words or key in PLACE_KEYS or key.startswith("stop "):
        return value
    if WHOLE.fullmatch(value):
        return int(value)
    return value.replace(",", ".") if DECIMAL_COMMA.fullmatch(value) else value


def read_csv(path: Path, names_it: Steps) -> tuple[Iterator[Row], CellOf]:
    """Return the rows of a CSV file, with columns between commas, semicolons or tabs.

    Cells have places at the key of the document that names the file.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    with name_file(str(path)):
        return split_rows(read_text(path), names_it, str(path))


def split_rows(text: str, names_it: Steps, file: str = "") -> tuple[Iterator[Row], CellOf]:
    """Return the rows of a text with columns between commas, semicolons or tabs.

    Cells have places at the key of the document that names the file.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    lines = text.splitlines()
    delimiter = max(",;\t", key=lines[0].count) if lines else ","
    try:
        rows = list(csv.reader(lines, delimiter=delimiter, strict=True))
    except csv.Error as error:
        raise InputError.at("", f"{error} (check the quotes)") from None
    filled = (
        (number, {at: text.strip() for at, text in enumerate(row, 1) if text.strip()})
        for number, row in enumerate(rows, 1)
    )
    headings = [find_heading_key(text) for text in rows[0]] if rows else []

    def cell(row: int, column: int) -> Location:
        is_named = row > 1 and 1 < column <= len(headings)
        steps = (headings[column - 1],) if is_named and headings[column - 1] else ()
        return Location(path=names_it, inner=Location(file=file, line=row, path=steps))

    return ((number, row) for number, row in filled if row), cell
