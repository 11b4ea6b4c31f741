"""The table written out: text for a terminal, comma-separated values, an Excel workbook."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator
from unicodedata import combining, east_asian_width

from rightofway.files import write_whole
from rightofway.viz.table.timespace import MAX_CELLS, Cell, Mark, TimeSpaceTable

MAX_TICKS_OF_SHEET = 16_384 - 2
"""A sheet has 16384 columns; the first two are robot and kind of row."""

SIGNS: dict[Mark | None, str] = {"collision": "*", "wait": "=", None: " "}
MEANINGS: dict[Mark, str] = {"collision": "two robots in one place", "wait": "waits"}

GAP = "  "
"""Between the names and the first column; a column ends in a sign and a blank itself."""


def as_text(table: TimeSpaceTable, width: int = 80) -> str:
    """Return a table as text.

    Parameters
    ----------
    table
        The table.
    width
        Columns of the terminal. A block shows at least one tick, however narrow it is.

    Returns
    -------
    str
        Blocks of ticks one below the other, each row with its robot's name, without those that have
        ended. After a place, ``*`` marks a collision and ``=`` a wait.

    Raises
    ------
    InputError
        If the table is too large.
    """
    table.refuse_more_than(MAX_CELLS)
    labels = [f"{row.robot} {row.kind}" for row in table.rows]
    names = max(map(_width, ("tick", *labels)))
    places = {str(run.cell.place) for row in table.rows for run in row.runs}
    size = max(map(_width, (*places, str(table.last_tick))))
    columns = max((width - names - len(GAP) + 1) // (size + len("* ")), 1)
    blocks = (
        "\n".join(_block(table, labels, table.ticks[begin : begin + columns], names, size))
        for begin in range(0, len(table.ticks), columns)
    )
    return "\n\n".join((*blocks, *_legend(table)))


def _block(
    table: TimeSpaceTable, labels: list[str], ticks: range, names: int, size: int
) -> Iterator[str]:
    yield _line("tick", [Cell(tick, None) for tick in ticks], names, size)
    for label, row in zip(labels, table.rows, strict=True):
        cells = row.cells(ticks[0], ticks[-1])
        if cells:
            yield _line(label, cells, names, size)


def _line(label: str, cells: list[Cell], names: int, size: int) -> str:
    texts = ((str(cell.place), SIGNS[cell.mark]) for cell in cells)
    columns = " ".join(" " * (size - _width(place)) + place + sign for place, sign in texts)
    return f"{label}{' ' * (names - _width(label))}{GAP}{columns}".rstrip()


def _legend(table: TimeSpaceTable) -> Iterator[str]:
    marks = {run.cell.mark for row in table.rows for run in row.runs}
    notes = [f"{SIGNS[mark]} {meaning}" for mark, meaning in MEANINGS.items() if mark in marks]
    if table.tick != 1:
        notes.append(f"a tick lasts {table.tick}")
    if notes:
        yield "   ".join(notes)


def _width(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    return sum(
        0 if combining(character) else 2 if east_asian_width(character) in "WF" else 1
        for character in text
    )


def write_csv(table: TimeSpaceTable, path: str | os.PathLike[str]) -> None:
    """Write a table as comma-separated values (UTF-8): bare places, no marks.

    Parameters
    ----------
    table
        The table.
    path
        Where. A header of ``robot``, ``row`` and the ticks, then a line for each row.

    Raises
    ------
    InputError
        If the table is too large, or the file cannot be written; one that was there before is
        untouched.
    """
    table.refuse_more_than(MAX_CELLS)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["robot", "row", *table.ticks])
    writer.writerows([row.robot, row.kind, *row.places] for row in table.rows)
    write_whole(path, text.getvalue())


def write_xlsx(table: TimeSpaceTable, path: str | os.PathLike[str]) -> None:
    """Write a table as an Excel workbook: collisions and waits coloured, with a legend.

    Parameters
    ----------
    table, path
        As for `write_csv`.

    Raises
    ------
    InputError
        As for `write_csv`, or if the table is too large for a sheet.
    """
    table.refuse_more_than(MAX_TICKS_OF_SHEET)
    from rightofway.viz.table.workbook import workbook_of

    write_whole(path, workbook_of(table))
