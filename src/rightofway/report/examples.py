"""The examples of the package: their folder, their names and subjects."""

from __future__ import annotations

from pathlib import Path

SUFFIXES = (".yaml", ".toml")
"""Endings of the examples; what else is in their folder belongs to one of them."""


def find_examples_folder() -> Path:
    """Return the folder of the examples: in the installed package, or in a clone at its top."""
    package = Path(__file__).parents[1]
    installed = package / "examples"
    return installed if installed.is_dir() else package.parents[1] / "examples"


def list_example_names() -> list[str]:
    """Return the names of the examples, those of subfolders last."""
    folder = find_examples_folder()
    paths = [path.relative_to(folder) for path in folder.rglob("*") if path.suffix in SUFFIXES]
    return [str(path.with_suffix("")) for path in sorted(paths, key=lambda p: (len(p.parts), p))]


def read_first_sentence(path: Path) -> str:
    """Return the first sentence of the comment that an example begins with."""
    lines = path.read_text(encoding="utf-8").splitlines()
    comment = [line.removeprefix("#").strip() for line in lines[:5] if line.startswith("#")]
    return " ".join(comment).partition(". ")[0].removesuffix(".")
