"""What a page takes along of the sentences in other languages: the templates that it says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rightofway.languages import read_tables


def find_translations(*parts: object) -> dict[str, dict[str, str]]:
    """Return what plain data need of the read_tables."""
    templates = set(_list_texts(parts))
    return {
        language: {template: own for template, own in table.items() if template in templates}
        for language, table in read_tables().items()
    }


def _list_texts(data: object) -> Iterator[str]:
    if isinstance(data, str):
        yield data
    elif isinstance(data, Mapping):
        for value in data.values():
            yield from _list_texts(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _list_texts(value)
