"""The table as a workbook, which is where the paper's tables come from."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from rightofway.errors import InputError
from rightofway.extras import load_library
from rightofway.files import make_archive
from rightofway.viz.table.listing import Listing
from rightofway.viz.table.timespace import Mark, Place, RowKind, TimeSpaceTable

openpyxl = load_library("openpyxl", "a workbook")
Font, PatternFill = openpyxl.styles.Font, openpyxl.styles.PatternFill

FILLS: dict[Mark | None, Any] = {
    # Orange and light blue: apart for colour-blind eyes too.
    "collision": PatternFill("solid", fgColor="F4B183"),
    "swap": PatternFill("solid", fgColor="D9A6E8"),
    "near": PatternFill("solid", fgColor="FFE699"),
    "wait": PatternFill("solid", fgColor="BDD7EE"),
    None: None,
}
FACE = {"name": "Calibri", "size": 11}
BOLD, GREY = Font(bold=True, **FACE), Font(color="7F7F7F", **FACE)
WRONG = Font(bold=True, color="C00000", **FACE)
FONTS: dict[RowKind, Any] = {"planned": GREY, "final": None, "list 1": None, "list 2": None}

LEGEND: tuple[tuple[str, str, Any, Mark | None], ...] = (
    ("planned", "the place of the robot if no robot waited for another", GREY, None),
    ("final", "where it is in the plan", None, None),
    ("list 1", "where it is if the first of the two robots waits on a tie", None, None),
    ("list 2", "where it is if the second of the two robots waits on a tie", None, None),
    ("", "another robot has the same place", None, "collision"),
    ("", "two robots exchange their places", None, "swap"),
    ("", "another robot is too near for their sizes", None, "near"),
    ("", "the robot waits", None, "wait"),
)

MAX_ROWS_OF_SHEET = 2**20 - 1
"""A sheet has 2**20 rows; the first is the heading."""

UNPRINTABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
"""Characters that no workbook may hold."""


def make_workbook(table: TimeSpaceTable) -> bytes:
    """Return the workbook of a table that fits into a sheet."""
    workbook = openpyxl.Workbook(write_only=True)
    write_table(workbook.create_sheet("time and space"), table)
    write_legend(workbook.create_sheet("legend"), table)
    return make_archive(workbook.save)


def make_sheets(lists: Sequence[Listing]) -> bytes:
    """Return a workbook with a sheet for each list, named by its title.

    Raises
    ------
    InputError
        If a list has more rows than a sheet.
    """
    workbook = openpyxl.Workbook(write_only=True)
    for listing in lists:
        write_list(workbook.create_sheet(listing.title), listing)
    return make_archive(workbook.save)


def write_list(sheet: Any, listing: Listing) -> None:
    """Write a list into an empty sheet: bold headings that stay in sight, filters, numbers."""
    if len(listing) > MAX_ROWS_OF_SHEET:
        message = (
            f"{len(listing)} rows, a sheet has room for {MAX_ROWS_OF_SHEET}"
            " (choose fewer with --from, --to and --robots, or write .csv)"
        )
        raise InputError.at(listing.title, message)
    headings = listing.list_headings()
    sheet.freeze_panes = "A2"
    sheet.auto_filter.ref = (
        f"A1:{openpyxl.utils.get_column_letter(len(headings))}{len(listing) + 1}"
    )
    for number, (heading, column) in enumerate(zip(headings, listing.columns, strict=True), 1):
        texts = {str(value) for value in column.values if isinstance(value, str)}
        widen(sheet, number, number, {heading, *texts})
    sheet.append([make_cell(sheet, heading, font=BOLD) for heading in headings])
    for row in listing.list_rows():
        sheet.append([None if value is None else make_cell(sheet, value) for value in row])


def write_table(sheet: Any, table: TimeSpaceTable) -> None:
    """Write a time/space table into an empty sheet, collisions, swaps and waits coloured."""
    sheet.freeze_panes = "C2"  # robots, kinds of row and ticks stay in sight
    places = {str(run.cell.place) for row in table.rows for run in row.runs}
    widen(sheet, 1, 1, {"robot", *(row.robot for row in table.rows)})
    widen(sheet, 2, 2, set(FONTS))
    widen(sheet, 3, len(table.ticks) + 2, {table.describe_time(table.last_tick), *places})
    times = (_number(table.describe_time(tick)) for tick in table.ticks)
    sheet.append([make_cell(sheet, title, font=BOLD) for title in ("robot", "row", *times)])
    for row in table.rows:
        font = FONTS[row.kind]
        names = [make_cell(sheet, row.robot, font=BOLD), make_cell(sheet, row.kind, font=font)]
        cells = (
            make_cell(sheet, place, font=None if mark else font, mark=mark)
            for place, mark in row.list_cells_at(table.ticks, table.step)
        )
        sheet.append([*names, *cells])


def write_legend(sheet: Any, table: TimeSpaceTable) -> None:
    """Write the meaning of fonts and colours of a table."""
    widen(sheet, 1, 1, {name for name, *_ in LEGEND})
    widen(sheet, 2, 2, {meaning for _, meaning, *_ in LEGEND})
    kinds = {"", *(row.kind for row in table.rows)}
    for name, meaning, font, mark in (entry for entry in LEGEND if entry[0] in kinds):
        sheet.append([make_cell(sheet, name, font=font, mark=mark), meaning])
    lasts = replace(table.quantities, in_ticks=False).format_duration(table.step)
    sheet.append([table.heading, f"the first row; a column lasts {lasts}"])


def _number(text: str) -> int | float:
    return float(text) if "." in text else int(text)


def make_cell(
    sheet: Any, value: Place | float, *, font: Any = None, mark: Mark | None = None
) -> Any:
    """Return a cell of a sheet that is written row by row; text is never a formula."""
    text = UNPRINTABLE.sub("\ufffd", value) if isinstance(value, str) else value
    cell = openpyxl.cell.WriteOnlyCell(sheet, text)
    if isinstance(text, str):
        cell.data_type = "s"  # a name that begins with = is no formula
    if font:
        cell.font = font
    if FILLS[mark]:
        cell.fill = FILLS[mark]
    return cell


def widen(sheet: Any, first: int, last: int, texts: set[str]) -> None:
    """Make columns as wide as their longest text."""
    letter = openpyxl.utils.get_column_letter(first)
    width = max(map(len, texts)) + 2
    sheet.column_dimensions[letter] = openpyxl.worksheet.dimensions.ColumnDimension(
        sheet, index=letter, min=first, max=last, width=width
    )
