"""Tables that stand in a page under marks like ``<!-- table: paper -->``, and are made anew."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

__all__ = ["tables_in", "write_tables"]


def tables_in(page: Path, kind: str) -> dict[str, str]:
    """Return the tables of a page that are marked as of a kind, by their names."""
    text = page.read_text(encoding="utf-8")
    return {place["name"]: place["table"] for place in _marked(kind).finditer(text)}


def write_tables(page: Path, kind: str, made: Mapping[str, str]) -> None:
    """Put tables under their marks, in place of those that stand there."""
    text = page.read_text(encoding="utf-8")
    put = _marked(kind).sub(lambda place: place["mark"] + made[place["name"]], text)
    page.write_text(put, encoding="utf-8")


def _marked(kind: str) -> re.Pattern[str]:
    mark = rf"^(?P<mark><!-- {kind}: (?P<name>.*) -->\n\n)"
    return re.compile(rf"{mark}(?P<table>(?:\|.*\n)*)", re.MULTILINE)
