"""Notebooks as pages: cells and their results become Markdown while the documentation is built."""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

SUFFIX = ".ipynb"


def show_notebook(app: Sphinx, page: str, source: list[str]) -> None:
    """Replace the JSON text of a notebook by Markdown; other pages stay as they are."""
    path = app.env.doc2path(page)
    if path.suffix == SUFFIX:
        source[0] = "\n\n".join([*convert_notebook(source[0]), f"{{download}}`{path.name}`"])


def convert_notebook(text: str) -> Iterator[str]:
    """Yield the blocks of a page: text, code, and the results of each cell below it."""
    for cell in json.loads(text)["cells"]:
        written = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            yield written
            continue
        yield fence(written, "python")
        for output in cell["outputs"]:
            yield from show_output(output)


def show_output(output: dict[str, Any]) -> Iterator[str]:
    """Yield a result: its picture where it has one, otherwise its text."""
    data = output.get("data", {"text/plain": output.get("text", [])})
    if "image/png" in data:
        picture = data["image/png"].replace("\n", "")
        yield f'<img alt="Output of the cell" src="data:image/png;base64,{picture}">'
    else:
        yield fence("".join(data["text/plain"]), "text")


def fence(text: str, language: str) -> str:
    """Return a fenced block."""
    return f"```{language}\n{text.rstrip()}\n```"


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the reader, before that of the comments for code hosts."""
    app.add_source_suffix(SUFFIX, "markdown")
    app.connect("source-read", show_notebook, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
