"""Run notebooks, and store the output of their cells: text and pictures.

Animated pages are left out of the file, because each has 300 kB; a text replaces them. `refresh.py`
in this folder runs all notebooks; ``python docs/notebooks.py FILE ...`` runs some.
"""  # noqa: INP001 (a script, run by its path)

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output
from traitlets.config import Config

KEPT = ("image/png", "text/plain")
"""Forms of a result that stay in the file."""

Cell = dict[str, Any]


def run_notebook(path: Path) -> str:
    """Return the text of a notebook whose cells have been run, in a folder of their own."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    config = Config(
        {"HistoryManager": {"enabled": False}, "InteractiveShell": {"colors": "nocolor"}}
    )
    shell = InteractiveShell.instance(config=config)
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            code = (cell for cell in notebook["cells"] if cell["cell_type"] == "code")
            for count, cell in enumerate(code, start=1):
                run_cell(shell, cell, count)
        finally:
            os.chdir(before)
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def run_cell(shell: InteractiveShell, cell: Cell, count: int) -> None:
    """Run a cell and store its output and its result below it."""
    with shell.display_trap, capture_output() as captured:
        done = shell.run_cell("".join(cell["source"]))
    done.raise_error()
    cell["execution_count"] = count
    cell["outputs"] = [
        *printed(captured.stdout),
        *(result(shown.data, old_pictures(cell), count) for shown in captured.outputs),
    ]


def printed(text: str) -> Iterator[Cell]:
    """Yield the printed text of a cell."""
    if text:
        yield {"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}


def old_pictures(cell: Cell) -> list[str]:
    """Return the pictures below a cell."""
    data = (output.get("data", {}) for output in cell["outputs"])
    return [each["image/png"] for each in data if "image/png" in each]


def result(data: dict[str, Any], pictures: list[str], count: int) -> Cell:
    """Return a result; an existing picture is kept, because libraries compress differently."""
    kept = {form: data[form] for form in KEPT if form in data}
    if "image/png" in kept and pictures:
        kept["image/png"] = pictures[0]
    if "text/plain" in kept:
        kept["text/plain"] = kept["text/plain"].splitlines(keepends=True)
    return {"data": kept, "execution_count": count, "metadata": {}, "output_type": "execute_result"}


if __name__ == "__main__":
    for name in sys.argv[1:]:
        Path(name).write_text(run_notebook(Path(name)), encoding="utf-8")
