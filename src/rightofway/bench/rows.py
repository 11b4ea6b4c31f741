"""Results: one row for each case, and the file that they are kept in."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Self

from rightofway.bench.extras import need, needed
from rightofway.errors import InputError
from rightofway.files import write_whole

try:
    import fcntl
except ImportError:  # pragma: no cover (not on Windows)
    fcntl = None  # type: ignore[assignment]

__all__ = ["COLUMNS", "Column", "Results", "Row"]

Row = dict[str, Any]
"""A value for each column; None where there is none."""

Kind = Literal["text", "int", "float", "bool"]


@dataclass(frozen=True, slots=True)
class Column:
    """One column of the results."""

    name: str
    kind: Kind
    what: str


COLUMNS = (
    Column("key", "text", "what the case is known by: a hash of all that defines it"),
    Column("map", "text", "name of the map"),
    Column("scen", "text", "the `.scen` file, if any"),
    Column("fleet", "text", "name of the fleet; empty where a scenario has its own"),
    Column("planner", "text", "name of the planner"),
    Column("options", "text", "its options, defaults included"),
    Column("robots", "int", "how many"),
    Column("seed", "int", "of fleet and planner"),
    Column("limit", "float", "the time limit [s]"),
    Column("solved", "bool", "whether there is a plan that the judge passes"),
    Column("valid", "bool", "what the judge says of the plan; empty where there is none"),
    Column("status", "text", "how it ended; see below"),
    Column("message", "text", "what the planner did, or what went wrong"),
    Column("flowtime", "int", "sum of the completion times [ticks]"),
    Column("makespan", "int", "the latest completion time [ticks]"),
    Column("lower_bound", "int", "no flowtime is smaller [ticks]"),
    Column("ratio", "float", "flowtime / lower bound"),
    Column("tick", "text", "how long a tick is [time unit]"),
    Column("first_plan_seconds", "float", "until there was a first plan, not yet judged [s]"),
    Column("wall_seconds", "float", "that planning took, the judge included [s]"),
    Column("cpu_seconds", "float", "the same, added up over all cores [s]"),
    Column("peak_memory", "float", "most memory that its process held [MB]"),
    Column("commit", "text", "of the package, if it is known; `-dirty` if it was changed"),
    Column("version", "text", "of the package"),
    Column("cpu", "text", "model of the processor"),
    Column("cores", "int", "how many may be used"),
    Column("compiler", "text", "of the native core"),
    Column("python", "text", "its version"),
)

HEADER = [column.name for column in COLUMNS]


class Results:
    """A file of rows, open for more.

    Parameters
    ----------
    path
        ``.parquet`` for Parquet, anything else for CSV.

    Raises
    ------
    InputError
        If it holds something else, or another run is writing to it.

    Notes
    -----
    A row is one line and is written by one call, then flushed to the disk. What a kill leaves of a
    line that was being written is cut off by the next run, which does the case again. Parquet
    files cannot grow: rows are kept in a CSV file beside it until the run ends.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        self._is_parquet = self.path.suffix.lower() == ".parquet"
        if self._is_parquet:
            need("pyarrow", "a Parquet file")
        self.rows: dict[str, Row] = {}
        if self._is_parquet and self.path.exists():
            self._keep(_read_parquet(self.path))
        self._journal = _Journal(self._journal_path())
        self._keep(self._journal.rows())

    def _journal_path(self) -> Path:
        return self.path.with_name(f"{self.path.name}.csv") if self._is_parquet else self.path

    def _keep(self, rows: Iterable[Row]) -> None:
        for row in rows:
            self.rows.setdefault(row["key"], row)

    def add(self, row: Mapping[str, Any]) -> None:
        """Write a row; one whose key is there already is left out."""
        if row["key"] not in self.rows:
            self.rows[row["key"]] = dict(row)
            self._journal.append(row)

    def close(self) -> None:
        """Finish the file."""
        try:
            if self._is_parquet:
                _write_parquet(self.path, list(self.rows.values()))
                self._journal.path.unlink()
        finally:
            self._journal.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        self.close()


class _Journal:
    """A CSV file that only grows, by whole lines."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        except OSError as error:
            message = f"cannot be opened: {error.strerror} (check the path and its permissions)"
            raise InputError.at("", message, str(path)) from None
        try:
            self._lock()
            self._content = path.read_bytes()
            self._mend()
        except BaseException:
            self.close()
            raise

    def _lock(self) -> None:
        try:
            if fcntl is not None:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            message = "another run is writing to it (wait for its end, or give another file)"
            raise InputError.at("", message, str(self.path)) from None

    def _mend(self) -> None:
        """Cut off a line that was being written when its run was killed; begin a new file."""
        header = _line(HEADER)
        if not self._content.startswith(header) and not header.startswith(self._content):
            message = "this is no file of results as they are now (give another file)"
            raise InputError.at("line 1", message, str(self.path))
        whole = self._content.rfind(b"\n") + 1
        if whole < len(self._content):
            os.truncate(self._file, whole)
            self._content = self._content[:whole]
        if not whole:
            self._write(header)

    def rows(self) -> list[Row]:
        """Return what was there when it was opened."""
        lines = self._content.decode("utf-8", "replace").split("\n")[1:-1]
        return [self._row(number, line) for number, line in enumerate(lines, start=2)]

    def _row(self, number: int, line: str) -> Row:
        [cells] = csv.reader([line])
        try:
            return {
                column.name: _value(cell, column.kind)
                for column, cell in zip(COLUMNS, cells, strict=True)
            }
        except ValueError as error:
            message = f"this is no row of results: {error} (take the line out)"
            raise InputError.at(f"line {number}", message, str(self.path)) from None

    def append(self, row: Mapping[str, Any]) -> None:
        self._write(_line([_text(row[name]) for name in HEADER]))

    def _write(self, line: bytes) -> None:
        try:
            while line:
                line = line[os.write(self._file, line) :]
            os.fsync(self._file)
        except OSError as error:
            message = f"cannot be written: {error.strerror} (the next run goes on from here)"
            raise InputError.at("", message, str(self.path)) from None

    def close(self) -> None:
        os.close(self._file)


def _line(cells: list[str]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue().encode()


def _text(value: Any) -> str:
    """Return a value as a cell; without line ends, so that a row is a line."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return " ".join(str(value).split())


def _value(cell: str, kind: Kind) -> Any:
    if kind == "text":
        return cell
    if cell == "":
        return None
    if kind == "bool":
        return {"yes": True, "no": False}[cell] if cell in {"yes", "no"} else _refuse(cell)
    return int(cell) if kind == "int" else float(cell)


def _refuse(cell: str) -> None:
    raise ValueError(f"{cell!r} is not yes or no")


def _read_parquet(path: Path) -> list[Row]:
    parquet = needed("pyarrow.parquet", "a Parquet file")
    arrow = needed("pyarrow", "a Parquet file")
    try:
        table = parquet.read_table(path)
    except (OSError, arrow.ArrowInvalid) as error:
        message = f"cannot be read: {' '.join(str(error).split())} (give another file)"
        raise InputError.at("", message, str(path)) from None
    if table.column_names != HEADER:
        message = "this is no file of results as they are now (give another file)"
        raise InputError.at("", message, str(path))
    rows: list[Row] = table.to_pylist()
    return rows


def _write_parquet(path: Path, rows: list[Row]) -> None:
    arrow = needed("pyarrow", "a Parquet file")
    parquet = needed("pyarrow.parquet", "a Parquet file")
    kinds = {
        "text": arrow.string(), "int": arrow.int64(), "float": arrow.float64(),
        "bool": arrow.bool_(),
    }  # fmt: skip
    schema = arrow.schema([(column.name, kinds[column.kind]) for column in COLUMNS])
    content = io.BytesIO()
    parquet.write_table(arrow.Table.from_pylist(rows, schema=schema), content)
    write_whole(path, content.getvalue())
