"""Sheets of a workbook as plain values by cell, read with care for files that anybody made.

A workbook is a zip archive of XML. Sheets are streamed, so that a cell in the last corner of a
sheet costs no memory. Whatever a cell holds that is not a value is an InputError with its place.
"""

from __future__ import annotations

import io
import re
import warnings
import zipfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, Location, find_nearest, quote
from rightofway.extras import load_library
from rightofway.io.content import read_content
from rightofway.io.faults import Faults

MAX_BYTES = 2**28
"""Largest content of a workbook that is read, unpacked [bytes]."""

MAX_CELLS = 2_000_000
"""Most cells of a sheet that are read, empty ones left of others included."""

MAX_ROWS = 2**20
"""Rows of a sheet."""

DENOMINATOR = 1000
"""A decimal that a program computed from a fraction with at most this denominator is read as it."""

CLOSE = Fraction(1, 10**12)
"""Relative distance up to which a decimal is read as such a fraction."""

OLD_OFFICE = b"\xd0\xcf\x11\xe0"
"""How files of Excel 97 begin, and workbooks with a password."""

MERGED = re.compile(rb"""<(?:\w+:)?mergeCell\s[^>]*?ref=["']([A-Z0-9:]+)["']""")

DARK = 128
"""A fill is a wall if it is darker than this, of 255."""

THEME = (255, 0, 230, 80, 110)
"""About how light the colours of a theme are: background, text, both again, then accents."""

Position = tuple[int, int]
"""Row and column, from 1 as a workbook counts."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """The content of a sheet.

    Attributes
    ----------
    name
        Its name in the workbook.
    values
        The values of the cells that hold any: text, whole numbers, fractions, true or false.
    dark
        For cells with a fill, whether it is dark.
    """

    name: str
    values: dict[Position, Any] = field(default_factory=dict)
    dark: dict[Position, bool] = field(default_factory=dict)

    @property
    def location(self) -> Location:
        """The sheet as a place."""
        return Location(cell=self.name)

    def locate_cell(self, row: int, column: int) -> Location:
        """Return the place of a cell: ``robots!E4``."""
        from openpyxl.utils import get_column_letter  # type: ignore[import-untyped]

        return Location(cell=f"{self.name}!{get_column_letter(column)}{row}")

    def list_rows(self) -> Iterator[tuple[int, dict[int, Any]]]:
        """Yield the rows that are not empty: their number, and their values by column."""
        by_row: dict[int, dict[int, Any]] = {}
        for (row, column), value in sorted(self.values.items()):
            by_row.setdefault(row, {})[column] = value
        yield from by_row.items()


def read_sheets(path: Path, wanted: Collection[str], faults: Faults) -> dict[str, Sheet]:
    """Return those sheets of a workbook that are wanted, by lower-case name.

    Raises
    ------
    InputError
        If the file is no workbook, or has none of these sheets.
    """
    data = _read_content(path)
    sheets: dict[str, Sheet] = {}
    with _open_workbook(data, cached=False) as workbook:
        for name in workbook.sheetnames:
            key = name.strip().lower()
            if key in wanted and hasattr(workbook[name], "iter_rows"):  # a chart sheet has no rows
                if key in sheets:
                    faults.note(Location(cell=name), f"two sheets are called {key} (take one out)")
                    continue
                merged = _list_merged_cells(data, workbook[name])
                for cells in merged:
                    where = Location(cell=f"{name}!{cells}")
                    faults.note(where, "these cells are merged (unmerge them)")
                sheets[key] = _read_sheet(workbook[name], faults, data)
        if not sheets:
            raise _make_no_sheet(workbook.sheetnames, wanted)
    return sheets


def _read_content(path: Path) -> bytes:
    data = bytes(read_content(path, MAX_BYTES))
    if data.startswith(OLD_OFFICE):
        message = "has a password, or is an old .xls file (save it as .xlsx without a password)"
        raise InputError.at("", message)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            size = sum(part.file_size for part in archive.infolist())
            names = archive.namelist()
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError):
        raise InputError.at("", "this is no workbook (save it as .xlsx)") from None
    if "content.xml" in names:
        raise InputError.at("", "this is an OpenDocument file (save it as .xlsx)")
    if size > MAX_BYTES:
        raise _make_too_long()
    return data


def _make_too_long() -> InputError:
    message = f"its content is longer than {MAX_BYTES} bytes (is it the right file?)"
    return InputError.at("", message)


@contextmanager
def _open_workbook(data: bytes, *, cached: bool) -> Iterator[Any]:
    """Yield a workbook that streams its sheets, with formulas or with the values they had."""
    openpyxl = load_library("openpyxl", "a workbook")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # on parts that we do not read
        try:
            workbook = openpyxl.load_workbook(
                io.BytesIO(data), read_only=True, data_only=cached, keep_links=False
            )
        except Exception as error:  # noqa: BLE001 (a broken file may raise anything there)
            raise _make_broken(error) from None
    try:
        yield workbook
    finally:
        workbook.close()


def _make_broken(error: Exception) -> InputError:
    reason = " ".join(str(error).split()) or type(error).__name__
    message = (
        f"the workbook is broken: {quote(reason)} (open it in a spreadsheet, and save it again)"
    )
    return InputError.at("", message)


def _make_no_sheet(names: list[str], wanted: Collection[str]) -> InputError:
    near = [(name, find_nearest(name.strip().lower(), wanted)) for name in names]
    meant = next((f"did you mean {near!r} by {name!r}?" for name, near in near if near), "")
    remedy = meant or "rightofway new FILE.xlsx writes a workbook to begin with"
    listed = ", ".join(map(repr, names[:5])) or "none"
    return InputError.at("", f"no sheet is called map or robots; there is {listed} ({remedy})")


def _list_merged_cells(data: bytes, worksheet: Any) -> list[str]:
    """Return the ranges of merged cells; a streamed sheet does not tell them."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            xml = archive.read(worksheet._worksheet_path)  # noqa: SLF001
    except Exception as error:  # noqa: BLE001 (openpyxl reads no further than a sheet ends)
        raise _make_broken(error) from None
    return [reference.decode() for reference in MERGED.findall(xml)]


def _read_sheet(worksheet: Any, faults: Faults, data: bytes) -> Sheet:
    """Read the cells of a sheet; note those that hold no value."""
    sheet = Sheet(name=worksheet.title)
    formulas: dict[Position, str] = {}
    try:
        for row in _read_rows(worksheet):
            for cell in row:
                if cell.value is None and not getattr(cell, "has_style", False):
                    continue
                position = (cell.row, cell.column)
                dark = _is_dark(cell)
                if dark is not None:
                    sheet.dark[position] = dark
                if cell.data_type == "f":
                    formulas[position] = str(getattr(cell.value, "text", cell.value))
                elif cell.value is not None:
                    _keep(sheet, position, cell.value, cell.data_type, faults)
    except InputError:
        raise
    except Exception as error:  # noqa: BLE001 (a broken file may raise anything there)
        raise _make_broken(error) from None
    if formulas:
        _keep_computed(sheet, formulas, faults, data)
    return sheet


def _read_rows(worksheet: Any) -> Iterator[Any]:
    """Yield the rows of a sheet, empty ones too, with the cells up to the last one of each."""
    seen = 0
    worksheet.reset_dimensions()  # what the file claims may be wrong
    for row in worksheet.iter_rows(max_row=MAX_ROWS):
        seen += len(row)
        if seen > MAX_CELLS:
            message = f"more than {MAX_CELLS} cells are in use (clear those that do not count)"
            raise InputError.at(worksheet.title, message)
        yield row


def _keep_computed(
    sheet: Sheet, formulas: dict[Position, str], faults: Faults, data: bytes
) -> None:
    """Add the values that formulas had when the workbook was saved.

    A formula that only points to a cell of the map is kept as text: it is a place.
    """
    computed = set()
    with _open_workbook(data, cached=True) as workbook:
        for row in _read_rows(workbook[sheet.name]):
            for cell in row:
                position = (getattr(cell, "row", 0), getattr(cell, "column", 0))
                if position not in formulas:
                    continue
                computed.add(position)
                if is_reference(formulas[position]):
                    sheet.values[position] = formulas[position]
                elif cell.value is not None:
                    _keep(sheet, position, cell.value, cell.data_type, faults)
                else:
                    computed.discard(position)
    for position in formulas.keys() - computed:
        message = (
            f"the formula {quote(formulas[position])} has no value yet"
            " (open the workbook in a spreadsheet and save it, or write the value)"
        )
        faults.note(sheet.locate_cell(*position), message)


def is_reference(text: str) -> bool:
    """Return whether a text points to a cell of the map: ``=map!C3``, ``map!$C$3``."""
    return find_reference(text) is not None


def find_reference(text: str) -> Position | None:
    """Return row and column of the cell of the map that a text points to."""
    from openpyxl.utils import column_index_from_string

    match = re.fullmatch(
        r"=?\$?'?map'?!\$?([A-Z]{1,3})\$?([0-9]{1,7})", text.strip(), re.IGNORECASE
    )
    try:
        return (int(match[2]), column_index_from_string(match[1])) if match else None
    except ValueError:
        return None


def _keep(sheet: Sheet, position: Position, value: Any, kind: str, faults: Faults) -> None:
    """Add a value of a cell, or note why it is none."""
    place = sheet.locate_cell(*position)
    if kind == "e":
        faults.note(place, f"holds the error {value} (mend it)")
    elif isinstance(value, time) or (isinstance(value, datetime) and value.time() != time()):
        sheet.values[position] = value.isoformat("T") if isinstance(value, datetime) else str(value)
    elif isinstance(value, datetime | date | timedelta):
        message = (
            f"{str(value).removesuffix(' 00:00:00')} is a date or a time; spreadsheets make dates"
            " of entries like 1/2"
            " (format the cell as text and write 1/2, or write 0.5)"
        )
        faults.note(place, message)
    elif isinstance(value, bool | int):
        sheet.values[position] = value
    elif isinstance(value, float):
        number = _restore_exact(value)
        if number is None:
            faults.note(place, f"{value} is not a number (write a number)")
        else:
            sheet.values[position] = number
    elif str(value).strip():
        sheet.values[position] = str(value).strip()


def _restore_exact(value: float) -> int | Fraction | None:
    """Return the number that a user meant by a decimal of 15 digits: 0.333333333333333 is 1/3."""
    if value != value or value in {float("inf"), float("-inf")}:  # noqa: PLR0124 (NaN)
        return None
    exact = Fraction(repr(value))
    near = exact.limit_denominator(DENOMINATOR)
    number = near if abs(near - exact) <= CLOSE * abs(exact) else exact
    return int(number) if number.denominator == 1 else number


def _is_dark(cell: Any) -> bool | None:
    """Return whether the fill of a cell is dark; None without a fill."""
    if not getattr(cell, "has_style", False):
        return None
    fill = cell.fill
    if fill is None or fill.fill_type is None:
        return None
    colour = fill.fgColor if fill.fill_type == "solid" else fill.bgColor
    light: float
    if colour.type == "theme":
        light = THEME[colour.theme] if colour.theme < len(THEME) else THEME[-1]
    elif colour.type == "indexed":
        from openpyxl.styles.colors import COLOR_INDEX  # type: ignore[import-untyped]

        light = _measure_lightness(
            COLOR_INDEX[colour.indexed] if colour.indexed < len(COLOR_INDEX) else ""
        )
    else:
        light = _measure_lightness(str(colour.rgb))
    tint = float(colour.tint or 0)
    return light * (1 + tint) < DARK if tint < 0 else light + (255 - light) * tint < DARK


def _measure_lightness(rgb: str) -> float:
    if not re.fullmatch("[0-9A-Fa-f]{6,8}", rgb):
        return 0
    red, green, blue = (int(rgb[-6:][k : k + 2], 16) for k in (0, 2, 4))
    return (299 * red + 587 * green + 114 * blue) / 1000
