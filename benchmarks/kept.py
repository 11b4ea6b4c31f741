"""Rows of a long measurement, kept as they come, so that it can go on where it was interrupted."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

__all__ = ["Kept"]

Row = dict[str, Any]
"""What was measured, by name."""


class Kept:
    """Rows in a file, a line of JSON for each.

    Parameters
    ----------
    path
        The file; without it, nothing is kept yet.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        text = path.read_text(encoding="utf-8") if path.is_file() else ""
        lines = [json.loads(line) for line in text.splitlines()]
        self._rows: dict[tuple[str, ...], Row] = {tuple(one["key"]): one["row"] for one in lines}

    def __getitem__(self, key: tuple[str, ...]) -> Row:
        return self._rows[key]

    def take(self, key: tuple[str, ...], measure: Callable[..., Row], *given: str) -> None:
        """Measure a row, unless it is there; keep it, and say so."""
        if key in self._rows:
            return
        began = time.perf_counter()
        row = self._rows[key] = measure(*given)
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"key": key, "row": row}) + "\n")
        print(f"{time.perf_counter() - began:6.1f} s  {', '.join(key)}", file=sys.stderr)  # noqa: T201
