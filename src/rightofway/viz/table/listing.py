"""Lists with headings, as text, comma-separated values or a sheet: events, collisions."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from rightofway.report.quantities import Quantities
from rightofway.viz.table.terminal import MAX_LINES, measure_text

MAX_CELL = 40
"""Columns of a terminal that a cell of text may take."""

Value = str | int | float | None
"""The content of a cell; None leaves it empty."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ListColumn:
    """A column of a list.

    Attributes
    ----------
    heading
        The quantity, without its unit.
    values
        One for each row. Times are in ticks; a text may stand for a time.
    kind
        ``text``, ``number``, or ``time``, which is written in the scenario's time unit.
    for_people
        Whether it is a part of the text; files have all columns.
    """

    heading: str
    values: Sequence[Value]
    kind: Literal["text", "number", "time"] = "text"
    for_people: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Listing:
    """Columns of equal length, and how their times are written.

    Attributes
    ----------
    title
        A name for its sheet.
    columns
        The columns.
    quantities
        How times are written.
    """

    title: str
    columns: tuple[ListColumn, ...]
    quantities: Quantities

    def __len__(self) -> int:
        return len(self.columns[0].values)

    def list_headings(self) -> list[str]:
        """Return the headings, times with their unit."""
        return [
            self.quantities.format_heading(column.heading)
            if column.kind == "time"
            else column.heading
            for column in self.columns
        ]

    def list_rows(self) -> Iterator[tuple[Value, ...]]:
        """Yield the rows as numbers and text, times in the unit of their heading."""
        yield from zip(*(self._list_numbers(column) for column in self.columns), strict=True)

    def _list_numbers(self, column: ListColumn) -> Iterator[Value]:
        for value in column.values:
            if column.kind != "time" or not isinstance(value, int) or self.quantities.in_ticks:
                yield value
            else:
                time = value * self.quantities.tick
                yield time.numerator if time.denominator == 1 else float(time)

    def as_text(self, max_lines: int | None = MAX_LINES) -> str:
        """Return the list with headings above; units stand in a line of their own.

        Parameters
        ----------
        max_lines
            How many rows to write before the list is cut, with a last line that says so; None for
            all.
        """
        columns = [
            self._write_cells(column, heading, max_lines)
            for column, heading in zip(self.columns, self.list_headings(), strict=True)
            if column.for_people
        ]
        lines = [
            line.rstrip() for line in ("  ".join(cells) for cells in zip(*columns, strict=True))
        ]
        lines = [lines[0], *(line for line in lines[1:2] if line), *lines[2:]]
        if max_lines is not None and len(self) > max_lines:
            more = len(self) - max_lines
            lines.append(f"… and {more} more rows (-o FILE.txt or -o FILE.csv writes all)")
        return "\n".join(lines)

    def _write_cells(self, column: ListColumn, heading: str, max_lines: int | None) -> list[str]:
        """Return two lines of heading and the cells of a column, equally wide."""
        words, _, unit = heading.partition(" [")
        values = (self._write_value(value, column.kind) for value in column.values[:max_lines])
        cells = [words, f"[{unit}" if unit else "", *values]
        width = max(map(measure_text, cells))
        gaps = [" " * (width - measure_text(cell)) for cell in cells]
        if column.kind == "text":
            return [cell + gap for cell, gap in zip(cells, gaps, strict=True)]
        return [gap + cell for cell, gap in zip(cells, gaps, strict=True)]

    def _write_value(self, value: Value, kind: str) -> str:
        if kind == "time" and isinstance(value, int):
            return self.quantities.format_cell(value)
        text = "" if value is None else str(value)
        return text if len(text) <= MAX_CELL else f"{text[: MAX_CELL - 1]}…"

    def as_csv(self) -> str:
        """Return the list as comma-separated values, with a header."""
        text = io.StringIO(newline="")
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.list_headings())
        writer.writerows(self.list_rows())
        return text.getvalue()
