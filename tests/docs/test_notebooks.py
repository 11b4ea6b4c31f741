"""Notebooks are run by `docs/refresh.py --check`; here is what that comparison sees."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.builders.pages import DOCS

NOTEBOOKS = sorted(DOCS.glob("*.ipynb"))


def run(path: Path, *sources: str) -> subprocess.CompletedProcess[str]:
    """Write a notebook of cells and run it in a process of its own, because IPython changes it."""
    cells = [
        {"cell_type": "code", "execution_count": None, "outputs": [], "source": [source]}
        for source in sources
    ]
    path.write_text(json.dumps({"cells": cells}), encoding="utf-8")
    return subprocess.run(
        [sys.executable, DOCS / "notebooks.py", path], capture_output=True, text=True, check=False
    )


def outputs(path: Path) -> list[list[dict[str, Any]]]:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell["outputs"] for cell in cells]


def test_results_and_what_is_printed_stand_below_their_cells(tmp_path: Path) -> None:
    assert run(tmp_path / "a.ipynb", "a = 1\nprint(a)", "a + 1").returncode == 0
    printed, shown = outputs(tmp_path / "a.ipynb")
    assert [output["text"] for output in printed] == [["1\n"]]
    assert [output["data"] for output in shown] == [{"text/plain": ["2"]}]


def test_a_cell_that_fails_ends_the_run(tmp_path: Path) -> None:
    done = run(tmp_path / "a.ipynb", "1 / 0")
    assert done.returncode == 1
    assert "ZeroDivisionError" in done.stderr


def test_there_is_a_notebook_and_each_of_its_cells_has_been_run() -> None:
    assert NOTEBOOKS
    for notebook in NOTEBOOKS:
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        counts = [cell["execution_count"] for cell in cells if cell["cell_type"] == "code"]
        assert counts == list(range(1, len(counts) + 1))
