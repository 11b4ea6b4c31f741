"""Facts as English sentences; templates and sentences in plain data that programs read."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from rightofway.facts import read_fact
from rightofway.languages import read_texts
from rightofway.report.facts import write_notes

PLACE_FOR_VALUE = re.compile(r"\{\w+(:\w+)?\}")

KINDS = {"kind", "purpose"}
"""Keys whose texts programs compare: kinds, and what a visit is for (``stop 1, turn``)."""

FOR_PEOPLE = {"text", "sentence"}
"""Keys of English sentences in reports for programs, each next to a kind."""


def list_texts(data: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """Yield each text of plain data with its key; a list of a kind and values is a fact."""
    match data:
        case dict():
            for name, value in data.items():
                yield from list_texts(value, name)
        case [str(kind), dict(values)] if kind in read_texts()["facts"]:
            yield "kind", kind
            yield from list_texts(values)
        case list():
            for value in data:
                yield from list_texts(value, key)
        case str():
            yield key, data


def find_sentences(
    data: Any, for_people: Collection[str] = frozenset(FOR_PEOPLE)
) -> list[tuple[str, str]]:
    """Return the templates of plain data, and sentences that are not under a key for people."""
    return [
        (key, text)
        for key, text in list_texts(data)
        if PLACE_FOR_VALUE.search(text)
        or (key not in {*for_people, *KINDS} and text.count(" ") > 1)
        or (key in KINDS and not re.fullmatch(r"[\w,.:-]+( [\w,.:-]+)*", text))
    ]


def tell_answer(answer: Mapping[str, Any] | None) -> tuple[bool, str]:
    """Return whether a command was carried out, and the English sentence of its answer."""
    assert answer is not None
    return answer["done"], str(read_fact(answer["fact"]))


def tell_notes(found: Any) -> tuple[str, ...]:
    """Return the notes of a layout, a map, a scenario or an example as sentences."""
    return tuple(write_notes(found.notes))
