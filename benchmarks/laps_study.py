"""How long transients and periods are on random fleets: figures, tables and plots of docs/laps.md.

``python -m benchmarks.laps_study`` measures anew (about ten minutes); with ``--again`` the tables
and plots are made of the figures there are. ``--seeds 0 10 --rows part.csv`` measures a part.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.laps_page import write_page
from benchmarks.laps_plots import draw_all
from benchmarks.laps_rows import ROWS, SEEDS, load, measure, save


def main() -> None:
    """Measure, then write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true", help="do not measure")
    parser.add_argument("--seeds", type=int, nargs=2, default=(0, SEEDS), help="from, up to")
    parser.add_argument("--rows", type=Path, default=ROWS, help="where the figures are")
    given = parser.parse_args()
    if not given.again:
        save(list(measure(range(*given.seeds))), given.rows)
    if given.rows == ROWS:
        rows = load()
        write_page(rows)
        draw_all(rows)


if __name__ == "__main__":
    main()
