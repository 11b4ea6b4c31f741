"""Small suites for tests, and what comes out of them."""

from __future__ import annotations

import csv
import time
from collections.abc import Callable
from pathlib import Path

__all__ = ["rows_of", "soon", "write_suite"]

SUITE = """format = "rightofway-suite/1"
counts = [3]
seeds = [{seeds}]
limits = [5]
maps = [{{random = {{size = [8, 8]}}}}]
planners = [{planners}]
"""


def write_suite(*planners: str, seeds: int = 1) -> None:
    """Write ``suite.toml``: three robots on an empty grid, a case for each planner and seed."""
    names = ", ".join(f'{{name = "{name}"}}' for name in planners)
    text = SUITE.format(planners=names, seeds=", ".join(map(str, range(seeds))))
    Path("suite.toml").write_text(text, encoding="utf-8")


def rows_of(path: Path | str) -> list[dict[str, str]]:
    """Return the rows of a CSV file."""
    with Path(path).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def soon(is_so: Callable[[], object], seconds: float = 30) -> bool:
    """Return whether something becomes true within some seconds; as soon as it does."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if is_so():
            return True
        time.sleep(0.05)
    return False
