"""Sentences for people: English text that keeps template and values, for other languages.

A sentence is written once, in English, where it is made. What shows it in another language has a
table from English templates to templates of that language; the values are put into either.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from string import Formatter
from typing import Any, Self

MAX_TEXT = 100_000
"""Characters of a text that is read as template and values: values may be phrases of phrases."""

__all__ = [
    "Phrase",
    "PhraseBook",
    "chain_items",
    "join_first",
    "join_items",
    "join_parts",
    "mark_figure",
    "say_count",
    "to_parts",
]


class Phrase(str):
    """English text made of a template and values.

    Parameters
    ----------
    template
        The text, with ``{name}`` where a value stands.
    **values
        Names and numbers, as text; or phrases. Those that the template does not name are dropped.

    Examples
    --------
    >>> phrase = Phrase("{place} cannot be reached", place=Phrase("station {name}", name="Dock"))
    >>> phrase
    'station Dock cannot be reached'
    >>> to_parts(phrase)
    ['{place} cannot be reached', {'place': ['station {name}', {'name': 'Dock'}]}]
    """

    __slots__ = ("template", "values")

    template: str
    values: dict[str, str]

    def __new__(cls, template: str, /, **values: str) -> Self:
        """Return the text, with its values in their places."""
        phrase = super().__new__(cls, template.format(**values))
        phrase.template = template
        phrase.values = {name: values[name] for name in list_names(template)}
        return phrase

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, str]]:
        """Return what a copy is made of."""
        return (self.template,), self.values


@cache
def list_names(template: str) -> tuple[str, ...]:
    """Return the names of the values of a template, each once, in their order."""
    names = (name for _, name, _, _ in Formatter().parse(template) if name is not None)
    return tuple(dict.fromkeys(names))


def to_parts(data: Any) -> Any:
    """Return plain data for JSON with each phrase as its template and its values.

    Parameters
    ----------
    data
        Text for people, or lists and mappings with such text; all else stays as it is.
    """
    if isinstance(data, Phrase):
        return [data.template, to_parts(data.values)]
    if isinstance(data, dict):
        return {key: to_parts(value) for key, value in data.items()}
    return [to_parts(value) for value in data] if isinstance(data, list) else data


def join_parts(data: Any) -> str:
    """Return the text that `to_parts` turned into plain data.

    Parameters
    ----------
    data
        Text, or a list of a template and its values.

    Raises
    ------
    ValueError
        If the data are neither, the template names no such value, or the text is too long.
    """
    if isinstance(data, str):
        return data
    match data:
        case [str(template), dict(values)]:
            texts = {str(name): join_parts(value) for name, value in values.items()}
        case _:
            remedy = "give text, or a template and a mapping of its values"
            raise ValueError(f"{data!r:.60} is no text ({remedy})")
    try:
        parts = [*Formatter().parse(template)]
    except ValueError as error:
        raise ValueError(f"{template!r:.60} is no template ({error})") from None
    size = 0
    for literal, name, spec, conversion in parts:
        is_plain = name is None or (name.isidentifier() and name in texts)
        if not is_plain or spec or conversion:
            raise ValueError(f"{template!r:.60} has no value for {name!r:.60} (give each a text)")
        size += len(literal) + len(texts[name] if name else "")
    if size > MAX_TEXT:
        raise ValueError(f"the text has {size} characters (give {MAX_TEXT} at most)")
    return Phrase(template, **texts)


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
        shown.append(Phrase("{number} more", number=str(left)))
    return join_items(shown)


class PhraseBook:
    """Phrases of which many are alike, as plain data for JSON: each text is there once.

    Attributes
    ----------
    entries
        Text, or a phrase: the index of its template, then of each value, in the order in which the
        template names them.

    Examples
    --------
    >>> book = PhraseBook()
    >>> book.add(Phrase("station {name}", name="Dock")), book.add("Dock")
    (2, 1)
    >>> book.entries
    ['station {name}', 'Dock', [0, 1]]
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
        return self._add((self._add(text.template), *map(self.add, text.values.values())))

    def _add(self, entry: str | tuple[int, ...]) -> int:
        if entry not in self._index:
            self._index[entry] = len(self.entries)
            self.entries.append(entry if isinstance(entry, str) else list(entry))
        return self._index[entry]


FIGURE = re.compile(r"\d[.%]")
"""What languages write differently in a number: the decimal point, and the space before ``%``."""


def mark_figure(text: str) -> str:
    """Return a number with its unit, marked so that pages write it as their language does.

    Parameters
    ----------
    text
        The number as English has it: ``6 min 23.5 s``, ``4.4%``.

    Examples
    --------
    >>> to_parts([mark_figure("1.5 s"), mark_figure("2 s")])
    [['{figure}', {'figure': '1.5 s'}], '2 s']
    """
    return Phrase("{figure}", figure=text) if FIGURE.search(text) else text


def say_count(number: int | str, singular: str, plural: str) -> Phrase:
    """Return how many things there are: ``1 vertex``, ``2 vertices``.

    Parameters
    ----------
    number
        How many, as a number or as a person writes it.
    singular, plural
        The thing, and several of them.
    """
    noun = singular if str(number) == "1" else plural
    return Phrase(f"{{number}} {noun}", number=number if isinstance(number, str) else str(number))


def chain_items(items: Sequence[str], template: str = "{first}, {second}") -> str:
    """Return items one after another: ``R1, R2, R3``.

    Parameters
    ----------
    items
        Names or phrases, one at least.
    template
        What stands between two of them.
    """
    first, *rest = items
    for item in rest:
        first = Phrase(template, first=first, second=item)
    return first


def join_items(items: Sequence[str]) -> str:
    """Return items as a sentence has them: ``R1, R2 and R3``.

    Parameters
    ----------
    items
        Names or phrases, one at least.
    """
    *others, last = items
    return Phrase("{first} and {last}", first=chain_items(others), last=last) if others else last
