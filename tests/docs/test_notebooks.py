"""Notebooks are run by `docs/refresh.py --check`; here is what that comparison sees."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location
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


def test_a_page_of_a_notebook_has_its_text_code_results_and_pictures() -> None:
    spec = spec_from_file_location("notebook_pages", DOCS / "_ext" / "notebook_pages.py")
    assert spec
    assert spec.loader
    pages = module_from_spec(spec)
    spec.loader.exec_module(pages)
    for notebook in NOTEBOOKS:
        written = notebook.read_text(encoding="utf-8")
        cells = json.loads(written)["cells"]
        page = "\n\n".join(pages.convert_notebook(written))
        for cell in cells:
            assert "".join(cell["source"]).rstrip() in page
        results = [output for cell in cells for output in cell.get("outputs", [])]
        pictures = sum("image/png" in output.get("data", {}) for output in results)
        assert page.count('src="data:image/png;base64,') == pictures > 0
        assert page.count("```text") == len(results) - pictures
