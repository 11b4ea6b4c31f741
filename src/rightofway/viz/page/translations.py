"""What the library says in other languages: `texts/library.json` has a table for each of them.

A page takes along what it says; the studio has the whole file.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import cache

from rightofway.viz.page.scripts import asset


@cache
def tables() -> Mapping[str, Mapping[str, str]]:
    """Return, for each language, its own of each English template."""
    known: Mapping[str, Mapping[str, str]] = json.loads(asset("texts/library.json"))
    return known


def translations_for(*parts: object) -> dict[str, dict[str, str]]:
    """Return what plain data need of the tables."""
    said = set(_texts(parts))
    return {
        language: {template: own for template, own in table.items() if template in said}
        for language, table in tables().items()
    }


def _texts(data: object) -> Iterator[str]:
    if isinstance(data, str):
        yield data
    elif isinstance(data, Mapping):
        for value in data.values():
            yield from _texts(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _texts(value)
