"""The modules of the package as syntax trees, parsed once for all tests that read them."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

__all__ = ["SOURCES", "parse_module", "parse_modules"]

SOURCES = Path(__file__).parents[2] / "src" / "rightofway"


@cache
def parse_module(path: Path) -> ast.Module:
    """Return the syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


def parse_modules(under: Path = SOURCES) -> dict[Path, ast.Module]:
    """Return the modules of the package, or of a folder in it, parsed."""
    return {path: parse_module(path) for path in sorted(under.rglob("*.py"))}
