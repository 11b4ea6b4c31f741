"""The table written out: text for a terminal, comma-separated values, an Excel workbook."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.files import write_whole
from rightofway.viz.table.terminal import MAX_LINES, measure_text
from rightofway.viz.table.timespace import MAX_CELLS, Cell, Mark, TimeSpaceTable

MAX_TICKS_OF_SHEET = 16_384 - 2
"""A sheet has 16384 columns; the first two are robot and kind of row."""

LONGEST_STEP = Fraction(10)
"""Where a tick is below one time unit, a long text has columns up to this [time unit]."""

LEGEND_WIDTH = 40
"""Columns that a legend takes, however narrow the terminal is."""

SIGNS: dict[Mark | None, str] = {"collision": "*", "swap": "!", "near": "~", "wait": "=", None: " "}
MEANINGS: dict[Mark, str] = {
    "collision": "two robots in one place",
    "swap": "two robots swap their places",
    "near": "two robots are too near",
    "wait": "waits",
}

GAP = "  "
"""Between the names and the first column; a column ends in a sign and a blank itself."""


def as_text(table: TimeSpaceTable, width: int = 80, max_lines: int | None = MAX_LINES) -> str:
    """Return a table as text.

    Parameters
    ----------
    table
        The table.
    width
        Columns of the terminal. A block shows at least one tick, however narrow it is.
    max_lines
        About how many lines to write; None for all. A longer table has columns of several ticks, up
        to `LONGEST_STEP`, or only the columns in which a robot changes its cell, whichever are
        fewer. It is cut if that is not enough. A line below the table says each of these.

    Returns
    -------
    str
        Blocks of ticks one below the other, each row with its robot's name, without those that have
        ended. After a place, ``*`` marks a collision, ``!`` a swap, ``~``
        robots that are too near for their sizes, and ``=`` a wait.

    Raises
    ------
    InputError
        If the table is too large to be written in full.
    """
    if max_lines is None:
        table.refuse_more_than(MAX_CELLS)
    labels = [f"{row.robot} {row.kind}" for row in table.rows]
    names = max(map(measure_text, (table.heading, *labels)))
    room = width - names - len(GAP) + 1
    size = _measure_column(table)
    if max_lines is not None and table.step == 1:
        blocks_shown = max(max_lines // (len(labels) + 2), 1)
        table = _reduce_columns(table, blocks_shown * (room // (size + len("* "))))
        size = _measure_column(table)
    columns = max(room // (size + len("* ")), 1)
    blocks: list[str] = []
    lines, longest = 0, 0
    for begin in range(0, len(table.ticks), columns):
        if max_lines is not None and blocks and lines + len(labels) + 2 > max_lines:
            break
        block = list(_write_block(table, labels, table.ticks[begin : begin + columns], names, size))
        blocks.append("\n".join(block[:max_lines]))
        lines, longest = lines + len(block) + 1, max(longest, len(block))
    rows_are_cut = max_lines is not None and longest > max_lines
    columns_shown = min(len(blocks) * columns, len(table.ticks))
    hints = _write_hints(table, columns_shown, rows_are_cut=rows_are_cut)
    return "\n\n".join((*blocks, *_write_legend(table, max(width, LEGEND_WIDTH)), *hints))


def _reduce_columns(table: TimeSpaceTable, columns: int) -> TimeSpaceTable:
    """Return a table of at most that number of columns, or the fewest that hide little."""
    if len(table.ticks) <= columns:
        return table
    has_short_ticks = table.quantities.tick < 1 and not table.quantities.in_ticks
    longer = table.limit_columns(columns, LONGEST_STEP) if has_short_ticks else table
    return min(longer, table.keep_changes(), key=lambda candidate: len(candidate.ticks))


def _measure_column(table: TimeSpaceTable) -> int:
    """Return how wide places and times are."""
    places = {str(run.cell.place) for row in table.rows for run in row.runs}
    times = {table.describe_time(tick) for tick in table.ticks[-2:]}
    return max(map(measure_text, (*places, *times)))


def _write_block(
    table: TimeSpaceTable, labels: list[str], ticks: Sequence[int], names: int, size: int
) -> Iterator[str]:
    yield _write_line(
        table.heading, [Cell(table.describe_time(tick), None) for tick in ticks], names, size
    )
    for label, row in zip(labels, table.rows, strict=True):
        cells = row.list_cells_at(ticks, table.step)
        if cells:
            yield _write_line(label, cells, names, size)


def _write_line(label: str, cells: list[Cell], names: int, size: int) -> str:
    texts = ((str(cell.place), SIGNS[cell.mark]) for cell in cells)
    columns = " ".join(" " * (size - measure_text(place)) + place + sign for place, sign in texts)
    return f"{label}{' ' * (names - measure_text(label))}{GAP}{columns}".rstrip()


def _write_legend(table: TimeSpaceTable, width: int) -> Iterator[str]:
    marks = {run.cell.mark for row in table.rows for run in row.runs}
    notes = [f"{SIGNS[mark]} {meaning}" for mark, meaning in MEANINGS.items() if mark in marks]
    quantities = replace(table.quantities, in_ticks=False)
    if table.quantities.in_ticks and quantities.tick != 1:
        notes.append(f"a tick lasts {quantities.format_duration(1)}")
    elif not table.changes and table.step * quantities.tick != 1:
        notes.append(f"a column lasts {quantities.format_duration(table.step)}")
    if table.changes:
        notes.append("columns without a change are left out")
    number = next((run.cell.place for row in table.rows for run in row.runs), None)
    if quantities.units.length and isinstance(number, int):
        notes.append(f"{number}: the cell N{number} of reports")
    lines: list[str] = []
    for note in notes:
        if lines and measure_text(lines[-1]) + len("   ") + measure_text(note) <= width:
            lines[-1] += f"   {note}"
        else:
            lines.append(note)
    if lines:
        yield "\n".join(lines)


def _write_hints(table: TimeSpaceTable, ticks: int, *, rows_are_cut: bool) -> Iterator[str]:
    """Yield the parts that a cut text leaves out, and how to see them."""
    missing = ["rows"] if rows_are_cut else []
    if ticks < len(table.ticks):
        shown, last = (
            table.describe_time(table.ticks[ticks - 1]),
            table.describe_time(table.last_tick),
        )
        missing.append(f"columns after {shown}, up to {last}")
    if missing:
        yield (
            f"… {' and '.join(missing)} are left out"
            "\n  (choose with --from, --to, --step and --robots; -o FILE.txt writes all;"
            "\n  --events lists each visit in one line)"
        )


def as_csv(table: TimeSpaceTable) -> str:
    """Return a table as comma-separated values.

    Parameters
    ----------
    table
        The table.

    Returns
    -------
    str
        A header of ``robot``, ``row`` and the times, then a line of bare places for each row. A row
        with collisions, swaps or waits is followed by a line with these, named for example
        ``final marks``.

    Raises
    ------
    InputError
        If the table is too large.
    """
    table.refuse_more_than(MAX_CELLS)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["robot", "row", *map(table.describe_time, table.ticks)])
    for row in table.rows:
        cells = row.list_cells_at(table.ticks, table.step)
        writer.writerow([row.robot, row.kind, *(cell.place for cell in cells)])
        if any(cell.mark for cell in cells):
            writer.writerow([row.robot, f"{row.kind} marks", *(cell.mark or "" for cell in cells)])
    return text.getvalue()


def write_csv(table: TimeSpaceTable, path: str | os.PathLike[str]) -> None:
    """Write a table as comma-separated values (UTF-8), as `as_csv` returns them.

    Parameters
    ----------
    table
        The table.
    path
        Where.

    Raises
    ------
    InputError
        If the table is too large, or the file cannot be written; one that was there before is
        untouched.
    """
    write_whole(path, as_csv(table))


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
    from rightofway.viz.table.workbook import make_workbook

    write_whole(path, make_workbook(table))
