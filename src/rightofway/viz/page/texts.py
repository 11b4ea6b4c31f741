"""The texts that a page brings along: its labels, and the templates of the facts that it shows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from rightofway.languages import LANGUAGES, VALUE, read_texts

PARTS = {"jobs": "work", "driven": "driven", "shift": "shift", "compared": "comparison"}
"""Labels that only some pages need: the key of the labels, and that of the data they are for."""


def find_texts(payload: Mapping[str, object], *, is_whole: bool = False) -> dict[str, Any]:
    """Return the texts of a page in each language: labels, and templates of the kinds in its data.

    Labels of `PARTS` are for pages with these parts only. A whole set has the templates of all
    kinds, for a page that gets facts later.
    """
    strings = set() if is_whole else set(_list_strings(payload))
    return {
        language: {
            "name": texts["name"],
            "page": _choose_labels(texts["page"], payload),
            "facts": texts["facts"] if is_whole else _choose_facts(texts, strings),
        }
        for language, texts in zip(LANGUAGES, map(read_texts, LANGUAGES), strict=True)
    }


def _choose_labels(labels: Mapping[str, Any], payload: Mapping[str, object]) -> dict[str, Any]:
    left_out = {part for part, key in PARTS.items() if key not in payload}
    return {key: label for key, label in labels.items() if key not in left_out}


def _choose_facts(texts: Mapping[str, Any], strings: set[str]) -> dict[str, Any]:
    """Return the templates of the kinds in a payload, and those that these or labels refer to."""
    facts = texts["facts"]
    chosen, kinds = dict[str, Any](), {*strings, *_list_forms(texts["page"])}
    while kinds := {kind for kind in kinds if kind in facts and kind not in chosen}:
        chosen |= {kind: facts[kind] for kind in sorted(kinds)}
        kinds = set(_list_forms([facts[kind] for kind in kinds]))
    return chosen


def _list_forms(texts: object) -> Iterable[str]:
    return (form for text in _list_strings(texts) for _, form in VALUE.findall(text))


def _list_strings(data: object) -> Iterator[str]:
    if isinstance(data, str):
        yield data
    elif isinstance(data, Mapping):
        for value in data.values():
            yield from _list_strings(value)
    elif isinstance(data, list | tuple):
        for value in data:
            if not isinstance(value, int):  # most of a large payload are numbers
                yield from _list_strings(value)
