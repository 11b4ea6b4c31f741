"""The page on laps says what was measured."""

from pathlib import Path

from benchmarks.laps_page import tables, write_page
from benchmarks.laps_rows import load, measure, save
from benchmarks.marked import tables_in
from tests.builders.pages import DOCS

PAGE = DOCS / "laps.md"


def test_the_tables_are_those_of_the_figures() -> None:
    assert tables_in(PAGE, "table") == tables(load())


def test_writing_the_page_again_changes_nothing(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_bytes(PAGE.read_bytes())
    write_page(load(), page)
    assert page.read_bytes() == PAGE.read_bytes()


def test_rows_are_read_as_they_were_written(tmp_path: Path) -> None:
    rows = [row for row, _ in zip(measure([0]), range(4), strict=False)]
    save(rows, tmp_path / "rows.csv")
    assert load(tmp_path / "rows.csv") == rows
