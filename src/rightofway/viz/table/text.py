"""The table as text, in blocks of columns that fit a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from unicodedata import combining, east_asian_width

from rightofway.viz.table.timespace import MAX_CELLS, Cell, Mark, TimeSpaceTable

__all__ = ["as_text"]

SIGNS: dict[Mark | None, str] = {"collision": "*", "wait": "=", None: " "}
MEANINGS: dict[Mark, str] = {"collision": "two robots in one place", "wait": "waits"}

GAP = "  "
"""Between the names and the first column; a column ends in a sign and a blank itself."""


def as_text(table: TimeSpaceTable, width: int = 80) -> str:
    """Write a table for people.

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
    names = max(_width(label) for label in ("tick", *_labels(table)))
    places = {str(run.cell.place) for row in table.rows for run in row.runs}
    size = max(map(_width, (*places, str(table.last_tick))))
    columns = max((width - names - len(GAP) + 1) // (size + len("* ")), 1)
    blocks = (
        "\n".join(_block(table, table.ticks[begin : begin + columns], names, size))
        for begin in range(0, len(table.ticks), columns)
    )
    return "\n\n".join((*blocks, *_legend(table)))


def _labels(table: TimeSpaceTable) -> list[str]:
    return [f"{row.robot} {row.kind}" for row in table.rows]


def _block(table: TimeSpaceTable, ticks: range, names: int, size: int) -> Iterator[str]:
    yield _line("tick", [Cell(tick, None) for tick in ticks], names, size)
    for label, row in zip(_labels(table), table.rows, strict=True):
        cells = row.cells(ticks[0], ticks[-1])
        if cells:
            yield _line(label, cells, names, size)


def _line(label: str, cells: list[Cell], names: int, size: int) -> str:
    texts = ((str(cell.place), SIGNS[cell.mark]) for cell in cells)
    columns = " ".join(" " * (size - _width(place)) + place + sign for place, sign in texts)
    return f"{label}{' ' * (names - _width(label))}{GAP}{columns}".rstrip()


def _legend(table: TimeSpaceTable) -> Iterator[str]:
    notes = [
        f"{SIGNS[mark]} {meaning}" for mark, meaning in MEANINGS.items() if mark in table.marks
    ]
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
