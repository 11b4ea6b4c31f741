"""Sentences for people: English text that keeps its kind and values, for other languages.

The templates of a kind are in ``texts/``, one file for each language. Pages put the values into the
template of their language.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from typing import Any, Self

from rightofway.languages import VALUE, find_text, list_values

__all__ = [
    "Phrase",
    "PhraseBook",
    "chain_items",
    "join_first",
    "join_items",
    "mark_figure",
    "say_count",
    "to_parts",
]


class Phrase(str):
    """English text made of a template and values.

    Parameters
    ----------
    kind
        The key of its templates.
    **values
        Names and numbers, as text; or phrases. Those that the template does not name are dropped.

    Examples
    --------
    >>> phrase = Phrase("no way to cells", places=Phrase("named station", name="Dock"))
    >>> phrase
    'No way leads to station Dock'
    >>> to_parts(phrase)
    ['no way to cells', {'places': ['named station', {'name': 'Dock'}]}]
    """

    __slots__ = ("kind", "values")

    kind: str
    values: dict[str, str]

    def __new__(cls, kind: str, /, **values: str) -> Self:
        """Return the text, with its values in their places."""
        template = strip_forms(find_text(kind, values.get("number", "")))
        phrase = super().__new__(cls, template.format(**values))
        phrase.kind = kind
        phrase.values = {name: values.get(name, "") for name in list_values(kind)}
        return phrase

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, str]]:
        """Return what a copy is made of."""
        return (self.kind,), self.values


@cache
def strip_forms(template: str) -> str:
    """Return a template with the names of its values only."""
    return VALUE.sub(r"{\1}", template)


def to_parts(data: Any) -> Any:
    """Return plain data for JSON with each phrase as its kind and its values.

    Parameters
    ----------
    data
        Text for people, or lists and mappings with such text; all else stays as it is.
    """
    if isinstance(data, Phrase):
        return [data.kind, to_parts(data.values)]
    if isinstance(data, dict):
        return {key: to_parts(value) for key, value in data.items()}
    return [to_parts(value) for value in data] if isinstance(data, list) else data


SHOWN = 5
"""Pieces that a sentence names."""


def join_first(pieces: Sequence[str]) -> str:
    """Return the first of some names and the number of the others: ``A, B, C, D, E and 2 more``.

    Parameters
    ----------
    pieces
        Names or phrases, one at least.
    """
    shown, left = list(pieces[:SHOWN]), len(pieces) - SHOWN
    if left > 0:
        shown.append(Phrase("number more", number=str(left)))
    return join_items(shown)


class PhraseBook:
    """Phrases of which many are alike, as plain data for JSON: each text is there once.

    Attributes
    ----------
    entries
        Text, or a phrase: the index of its kind, then of each value, in the order of their names.

    Examples
    --------
    >>> book = PhraseBook()
    >>> book.add(Phrase("named station", name="Dock")), book.add("Dock")
    (2, 1)
    >>> book.entries
    ['named station', 'Dock', [0, 1]]
    """

    def __init__(self) -> None:
        self.entries: list[str | list[int]] = []
        self._index: dict[str | tuple[int, ...], int] = {}

    def add(self, text: str) -> int:
        """Return the index of a text or a phrase.

        Parameters
        ----------
        text
            Text for people.
        """
        if not isinstance(text, Phrase):
            return self._add(str(text))
        return self._add((self._add(text.kind), *map(self.add, text.values.values())))

    def _add(self, entry: str | tuple[int, ...]) -> int:
        if entry not in self._index:
            self._index[entry] = len(self.entries)
            self.entries.append(entry if isinstance(entry, str) else list(entry))
        return self._index[entry]


FIGURE = re.compile(r"\d[.%]")
"""Differences of languages in numbers: the decimal point, and the space before ``%``."""


def mark_figure(text: str) -> str:
    """Return a number with its unit, marked so that pages write it as their language does.

    Parameters
    ----------
    text
        The number as English has it: ``6 min 23.5 s``, ``4.4%``.

    Examples
    --------
    >>> to_parts([mark_figure("1.5 s"), mark_figure("2 s")])
    [['figure', {'figure': '1.5 s'}], '2 s']
    """
    return Phrase("figure", figure=text) if FIGURE.search(text) else text


def say_count(number: int | str, singular: str, plural: str) -> str:
    """Return how many things there are, in English: ``1 vertex``, ``2 vertices``.

    Parameters
    ----------
    number
        How many, as a number or as a person writes it.
    singular, plural
        The thing, and several of them.
    """
    return f"{number} {singular if str(number) == '1' else plural}"


def chain_items(items: Sequence[str], kind: str = "next in list") -> str:
    """Return items one after another: ``R1, R2, R3``.

    Parameters
    ----------
    items
        Names or phrases, one at least.
    kind
        The kind of the text of two of them, ``first`` and ``second``.
    """
    first, *rest = items
    for item in rest:
        first = Phrase(kind, first=first, second=item)
    return first


def join_items(items: Sequence[str]) -> str:
    """Return items as a sentence has them: ``R1, R2 and R3``.

    Parameters
    ----------
    items
        Names or phrases, one at least.
    """
    *others, last = items
    return Phrase("last of list", first=chain_items(others), last=last) if others else last
