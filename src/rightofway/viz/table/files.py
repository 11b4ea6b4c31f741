"""The table in files: comma-separated values for programs, a workbook for people."""

from __future__ import annotations

import csv
import io
import os

from rightofway.files import write_whole
from rightofway.viz.table.timespace import MAX_CELLS, TimeSpaceTable

__all__ = ["MAX_TICKS_OF_SHEET", "write_csv", "write_xlsx"]

MAX_TICKS_OF_SHEET = 16_384 - 2
"""A sheet has 16384 columns; the first two are robot and kind of row."""


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
    table
        The table.
    path
        Where.

    Raises
    ------
    InputError
        If the table is too large for a sheet, or the file cannot be written; one that was there
        before is untouched.
    """
    table.refuse_more_than(MAX_TICKS_OF_SHEET)
    from rightofway.viz.table.workbook import workbook_of

    write_whole(path, workbook_of(table))
