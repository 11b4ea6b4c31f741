"""Results: one row for each case, and the file that holds them."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Self

from rightofway.errors import InputError, Location, Where
from rightofway.files import take_lock

Row = dict[str, Any]
"""A value for each column; None where there is none."""

Kind = Literal["text", "int", "float", "bool"]


@dataclass(frozen=True, slots=True)
class Column:
    """One column of the results."""

    name: str
    kind: Kind
    meaning: str


COLUMNS = (
    Column("key", "text", "a hash of all that defines the case"),
    Column("map", "text", "name of the map"),
    Column("scen", "text", "the `.scen` file, if any"),
    Column("fleet", "text", "name of the fleet; empty where a scenario has its own"),
    Column("planner", "text", "name of the planner"),
    Column("options", "text", "its options, defaults included"),
    Column("robots", "int", "how many"),
    Column("seed", "int", "of fleet and planner"),
    Column("limit", "float", "the time limit [s]"),
    Column("solved", "bool", "whether a plan exists that the judge accepts"),
    Column("valid", "bool", "the result of the judge; empty without a plan"),
    Column("status", "text", "the end of the case; see below"),
    Column("message", "text", "the status of the planner, or the reason of the failure"),
    Column("flowtime", "int", "sum of the completion times [ticks]"),
    Column("makespan", "int", "the latest completion time [ticks]"),
    Column("lower_bound", "int", "flowtime of the robots alone [ticks]"),
    Column("ratio", "float", "flowtime / lower bound"),
    Column("tick", "text", "length of a tick [time unit]"),
    Column("first_plan_seconds", "float", "until there was a first plan, not yet judged [s]"),
    Column("wall_seconds", "float", "that planning took, the judge included [s]"),
    Column("cpu_seconds", "float", "the same, added up over all cores [s]"),
    Column("peak_memory", "float", "most memory that its process held [MB]"),
    Column("commit", "text", "of the package, if it is known; `-dirty` if it was changed"),
    Column("version", "text", "of the package"),
    Column("cpu", "text", "model of the processor"),
    Column("cores", "int", "number of cores that may be used"),
    Column("compiler", "text", "of the native core"),
    Column("python", "text", "its version"),
    Column("figures", "text", "further figures, as JSON; see below"),
)
"""The columns of the results, in the order of the file."""

HEADER = [column.name for column in COLUMNS]

NOT_RESULTS = "this is no file of results as they are now (give another file)"


class Results:
    """A file of rows, open for writing.

    Parameters
    ----------
    path
        A CSV file.

    Raises
    ------
    InputError
        If it holds something else, or another run is writing to it.

    Notes ----- A row is one line and is written by one call, then flushed to the disk. The rest
    that a kill leaves of a line that was being written is cut off by the next run, which does the
    case again.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        self.rows: dict[str, Row] = {}
        try:
            self._file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        except OSError as error:
            message = f"cannot be opened: {error.strerror} (check the path and its permissions)"
            raise self._make_fault(message) from None
        try:
            for row in self._read_mended_rows():
                self.rows.setdefault(row["key"], row)
        except BaseException:
            os.close(self._file)
            raise

    def add(self, row: Mapping[str, Any]) -> None:
        """Write a row; a row with a known key is left out."""
        if row["key"] not in self.rows:
            self.rows[row["key"]] = dict(row)
            self._write(_write_line([_write_text(row[name]) for name in HEADER]))

    def close(self) -> None:
        """Finish the file."""
        os.close(self._file)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _read_mended_rows(self) -> Iterator[Row]:
        """Lock the file; begin it, or cut off a line that was being written; yield its rows."""
        if not take_lock(self._file):
            message = "another run is writing to it (wait for its end, or give another file)"
            raise self._make_fault(message)
        content, header = self.path.read_bytes(), _write_line(HEADER)
        if not content.startswith(header) and not header.startswith(content):
            raise self._make_fault(NOT_RESULTS, Location(line=1))
        whole = content.rfind(b"\n") + 1
        if whole < len(content):
            os.truncate(self._file, whole)
        if not whole:
            self._write(header)
        lines = content[:whole].decode("utf-8", "replace").split("\n")[1:-1]
        for number, [cells] in enumerate((csv.reader([line]) for line in lines), start=2):
            try:
                yield {
                    column.name: _read_value(cell, column.kind)
                    for column, cell in zip(COLUMNS, cells, strict=True)
                }
            except ValueError as error:
                message = f"this is no row of results: {error} (take the line out)"
                raise self._make_fault(message, Location(line=number)) from None

    def _write(self, line: bytes) -> None:
        try:
            while line:
                line = line[os.write(self._file, line) :]
            os.fsync(self._file)
        except OSError as error:
            message = f"cannot be written: {error.strerror} (the next run goes on from here)"
            raise self._make_fault(message) from None

    def _make_fault(self, message: str, where: Where = "") -> InputError:
        return InputError.at(where, message, str(self.path))


def _write_line(cells: list[str]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue().encode()


def _write_text(value: Any) -> str:
    """Return a value as a cell; without line ends, so that a row is a line."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None else " ".join(str(value).split())


def _read_value(cell: str, kind: Kind) -> Any:
    if kind == "text":
        return cell
    if cell == "":
        return None
    if kind == "bool":
        if cell not in {"yes", "no"}:
            raise ValueError(f"{cell!r} is not yes or no")
        return cell == "yes"
    return int(cell) if kind == "int" else float(cell)
