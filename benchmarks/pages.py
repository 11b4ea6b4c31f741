"""Tables and plots of the documentation, from the results of the suites.

``python -m benchmarks.pages priorities build/priorities.csv build/priorities_aisles.csv`` writes
docs/results/priorities.md, ``laps build/cyclic.csv`` docs/results/second-lap.md, and ``timetables
build/timetables.csv`` a table of it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable

from benchmarks.common import (
    IMAGES,
    RESULTS,
    save_figure,
    write_tables,
)
from benchmarks.page_laps import laps_plots, laps_tables
from benchmarks.page_priorities import priorities_plots, priorities_tables
from benchmarks.page_timetables import timetable_tables
from rightofway.bench import Results, Row


def read(paths: Iterable[str]) -> list[Row]:
    """Return the rows of files of results."""
    rows: list[Row] = []
    for path in paths:
        with Results(path) as results:
            rows += results.rows.values()
    return rows


def main(page: str, *paths: str) -> None:
    """Write the tables and plots of a page."""
    rows = read(paths)
    if page == "timetables":
        write_tables(RESULTS / "second-lap.md", "timetables", timetable_tables(rows))
        return
    name, tables, plots = {
        "priorities": ("priorities", priorities_tables, priorities_plots),
        "laps": ("second-lap", laps_tables, laps_plots),
    }[page]
    write_tables(RESULTS / f"{name}.md", "table", tables(rows))
    for picture, figure in plots(rows):
        save_figure(figure, IMAGES / f"{picture}.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
