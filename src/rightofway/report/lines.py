"""Reports of 80 columns: paragraphs, facts and tables, laid out for a terminal."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from rightofway.report.quantities import Quantities
from rightofway.units import Value

COLUMNS = 80
"""Longest line of a report."""

MAX_NAME = 40
"""Columns that a robot's name may take beside a column that is not aligned."""

MAX_FACT = 4 * COLUMNS
"""Characters of a fact; a longer one is cut."""

NO_BREAK = "\N{NO-BREAK SPACE}"
"""A space at which no line is broken."""

UNIT = re.compile(r"(?<=\d) (?=[a-z])|(?<=\d h) (?=\d)|(?<=\d min) (?=\d)")
"""The spaces within ``2 min 34.3 s``."""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A sentence with an indent; text alone is a paragraph without one, empty text a blank line."""

    text: str
    indent: str = ""


@dataclass(frozen=True, slots=True)
class Line:
    """Text whose lines are not broken, because their width matters."""

    text: str


@dataclass(frozen=True, slots=True)
class Facts:
    """Keys, each with a text beside it: one column for all."""

    rows: Sequence[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of cells with a name before each; columns are aligned to the right.

    Attributes
    ----------
    head
        The heading of the names, then those of the columns.
    rows
        A name, then its cells; a row may have one cell in place of all.
    has_remarks
        Whether the last column has text, aligned to the left and cut at the end of the line.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    has_remarks: bool = False


Part = str | Paragraph | Line | Facts | Table


def lay_out(parts: Iterable[Part]) -> str:
    """Return a report."""
    return "\n".join(line for part in parts for line in _split_lines(part))


def _split_lines(part: Part) -> Iterator[str]:
    match part:
        case Paragraph(text, indent):
            yield from _wrap_sentence(text, indent, indent + "    ")
        case Line(text):
            yield text
        case Facts(rows):
            column = max(len(key) for key, _ in rows) + 2
            for key, text in rows:
                fact = textwrap.shorten(text, MAX_FACT, placeholder=" …")
                yield from _wrap_sentence(fact, f"{key:{column}}", " " * column)
        case Table():
            yield from _write_rows(part)
        case _:
            yield from _wrap_sentence(part, "", "    ") or [""]


def _write_rows(table: Table) -> Iterator[str]:
    rows = [list(row) for row in (table.head, *table.rows)]
    columns = len(table.head)
    widths = [
        max(len(row[k]) for row in rows if len(row) == columns)
        for k in range(1, columns - table.has_remarks)
    ]
    room = MAX_NAME if table.has_remarks else COLUMNS - sum(widths) - 2 * len(widths)
    names = [shorten_name(row[0], room) for row in rows]
    first = max(map(len, names))
    for name, row in zip(names, rows, strict=True):
        cells = row[1:]
        if len(row) == columns:
            aligned = zip(row[1:], widths, strict=False)
            cells = [f"{cell:>{width}}" for cell, width in aligned] + row[1 + len(widths) :]
        yield shorten_name(f"{name:{first}}  {'  '.join(cells)}".rstrip(), COLUMNS)


def _wrap_sentence(text: str, first: str, following: str) -> list[str]:
    """Return the lines of a sentence; a number and its unit stay in one line."""
    joined = UNIT.sub(NO_BREAK, text)
    lines = textwrap.wrap(joined, COLUMNS, initial_indent=first, subsequent_indent=following)
    return [line.replace(NO_BREAK, " ") for line in lines]


def shorten_name(name: str, columns: int = MAX_NAME) -> str:
    """Return a robot's name in the columns that it may take."""
    return name if len(name) <= columns else f"{name[: columns - 1]}…"


def choose_further_format(quantities: Quantities) -> Callable[[Value], str]:
    """Return how times after the first one of a sentence are written.

    Where all times are in one unit, ``time 4`` goes on with ``13``, ``8 ticks`` with ``9``.
    """
    is_one_unit = quantities.in_ticks or not quantities.time_unit
    return quantities.format_cell if is_one_unit else quantities.format_duration
