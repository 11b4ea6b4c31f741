"""Tables of robots, of a sheet or a CSV file, as the robots of a scenario document.

A row is a robot. Headings are the keys of a robot; several stops are columns ``stop 1``,
``work 1``, ``stop 2`` and so on.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rightofway.errors import (
    InputError,
    InputFault,
    Location,
    Steps,
    Where,
    in_file,
    nearest,
    shown,
)
from rightofway.io.faults import Faults
from rightofway.io.text import parse_yaml, read_text
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES

NOTES = {"note", "notes", "hint", "comment", "remark"}
"""Columns that are not read."""

STOP = re.compile(r"(stop|work) ?([1-9][0-9]?)")
"""Headings of several stops and the work there."""

PLACE_KEYS = {"home", "target", "at"}
"""Keys whose values are places."""

WORD_KEYS = {"name", *(it.key for it in (*ROBOT_ATTRIBUTES, *RULE_ATTRIBUTES) if it.is_text)}
"""Keys whose values are text, also where they look like numbers."""

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
        What is wrong with cells, so that they are no part of the document.
    """

    part: Any
    cells: dict[Steps, Where] = field(default_factory=dict)
    faults: tuple[InputFault, ...] = ()

    @contextmanager
    def locate(self) -> Iterator[None]:
        """Report faults of the document read inside at their cells, after those of the cells."""
        try:
            yield
        except InputError as error:
            places = {fault.location for fault in self.faults}
            moved = (fault.relocate(self.cells) for fault in error.faults)
            more = (fault for fault in moved if fault.location not in places)
            raise InputError([*self.faults, *more]) from None
        if self.faults:
            raise InputError(self.faults)


def robots_of_rows(rows: Iterable[Row], cell: CellOf, known: Iterable[str]) -> CellDocument:
    """Return the robots of a table.

    Parameters
    ----------
    rows
        The rows that are not empty; the first holds the headings.
    cell
        Returns the place of a cell.
    known
        The keys of a robot.

    Returns
    -------
    CellDocument
        The list of robots. Faults are headings that are unknown or given twice, and values without
        a heading.
    """
    reading, rows = _Reading(cell), iter(rows)
    first, headings = next(rows, (1, {}))
    reading.take_headings(first, headings, [key for key in known if key != "stops"])
    for number, values in rows:
        reading.take_robot(number, values)
    if not reading.robots:
        message = "there is no robot (write headings, then one robot a row)"
        reading.faults.note(cell(first, 1), message)
    return CellDocument(part=reading.robots, cells=reading.cells, faults=reading.faults.found)


class _Reading:
    """The robots read so far, where their keys stand, and what is wrong with the table."""

    def __init__(self, cell: CellOf) -> None:
        self.cell = cell
        self.columns: dict[int, str] = {}
        self.robots: list[dict[str, Any]] = []
        self.cells: dict[Steps, Where] = {}
        self.faults = Faults()

    def take_headings(self, row: int, headings: Mapping[int, Any], known: Sequence[str]) -> None:
        """Note the key of each column, and headings that are none."""
        for column, heading in headings.items():
            key, place = heading_key(heading), self.cell(row, column)
            if key in self.columns.values() and key not in NOTES:
                self.faults.note(place, f"the column {key!r} is given twice (take one out)")
                key = "note"
            elif not (key in known or STOP.fullmatch(key) or key in NOTES):
                near, listed = nearest(key, known), ", ".join(known)
                hint = f"did you mean {near}?" if near else f"known: {listed}, stop 1, work 1, …"
                self.faults.note(place, f"{shown(heading)} is no key of a robot ({hint})")
                key = "note"
            self.columns[column] = key

    def take_robot(self, row: int, values: Mapping[int, Any]) -> None:
        """Add the robot of a row."""
        place, robot = ("robots", len(self.robots)), dict[str, Any]()
        stops: dict[int, dict[str, Any]] = {}
        self.cells[place] = self.cell(row, 1)
        for column in values.keys() - self.columns.keys():
            self.faults.note(self.cell(row, column), "a value without a heading (take it out)")
        for column, heading in self.columns.items():
            if heading in NOTES or (column not in values and STOP.fullmatch(heading)):
                continue
            here, stop = self.cell(row, column), STOP.fullmatch(heading)
            if stop:  # stops are counted as they are given, so that one may be left empty
                target = stops.setdefault(int(stop[2]), {})
                key = "at" if stop[1] == "stop" else "work"
                index = sorted(stops).index(int(stop[2]))
                self.cells.setdefault((*place, "stops", index), here)
                self.cells[*place, "stops", index, key] = here
            else:
                target, key = robot, heading
                self.cells[*place, key] = here
            if column in values:
                value = self.faults.attempt(here, value_of, key, values[column])
                target |= {} if value is None else {key: value}
        if stops:
            robot["stops"] = [stops[number] for number in sorted(stops)]
        self.robots.append(robot)


def heading_key(heading: Any) -> str:
    """Return the key that a heading stands for: ``Speed [m/s]`` is ``speed``."""
    words = re.sub(r"\[[^\[\]]*\]|\([^()]*\)|\*", "", str(heading)).strip().lower()
    return words if STOP.fullmatch(words) else "_".join(words.split())


def value_of(key: str, value: Any) -> Any:
    """Return the value of a cell as a document has it under a key.

    Parameters
    ----------
    key
        The key.
    value
        What the cell holds.
    """
    if not isinstance(value, str):
        return str(value) if key in WORD_KEYS and not isinstance(value, bool) else value
    if key not in WORD_KEYS and value[0] in "[{":
        try:
            return parse_yaml(value)
        except InputError as error:  # its line is one of the cell
            raise InputError.at("", error.faults[0].words) from None
    if key in WORD_KEYS | PLACE_KEYS:
        return value
    if WHOLE.fullmatch(value):
        return int(value)
    return value.replace(",", ".") if DECIMAL_COMMA.fullmatch(value) else value


def robots_of_csv(path: Path, known: Iterable[str], names_it: Where) -> CellDocument:
    """Return the robots of a CSV file: columns between commas, semicolons or tabs.

    Parameters
    ----------
    path
        The file.
    known
        The keys of a robot.
    names_it
        Where the document names the file.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    with in_file(str(path)):
        lines = read_text(path).splitlines()
        delimiter = max(",;\t", key=lines[0].count) if lines else ","
        try:
            rows = list(csv.reader(lines, delimiter=delimiter, strict=True))
        except csv.Error as error:
            raise InputError.at("", f"{error} (check the quotes)") from None
    filled = (
        (number, {at: text.strip() for at, text in enumerate(row, 1) if text.strip()})
        for number, row in enumerate(rows, 1)
    )
    headings = [heading_key(text) for text in rows[0]] if rows else []

    def cell(row: int, column: int) -> Location:
        is_named = row > 1 and 1 < column <= len(headings)
        steps = (headings[column - 1],) if is_named and headings[column - 1] else ()
        return Location(file=str(path), line=row, path=steps).within(names_it)

    return robots_of_rows(((number, row) for number, row in filled if row), cell, known)
