"""Sentences for people: English text that keeps template and values, for other languages.

A sentence is written once, in English, where it is made. What shows it in another language has a
table from English templates to templates of that language; the values are put into either.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self

__all__ = ["Phrase", "counted", "joined", "parts_of"]


class Phrase(str):
    """English text made of a template and values.

    Parameters
    ----------
    template
        The text, with ``{name}`` where a value stands.
    **values
        Names and numbers, as text; or phrases.

    Examples
    --------
    >>> phrase = Phrase("{place} cannot be reached", place=Phrase("station {name}", name="Dock"))
    >>> phrase
    'station Dock cannot be reached'
    >>> parts_of(phrase)
    ['{place} cannot be reached', {'place': ['station {name}', {'name': 'Dock'}]}]
    """

    __slots__ = ("template", "values")

    template: str
    values: dict[str, str]

    def __new__(cls, template: str, /, **values: str) -> Self:
        """Return the text, with its values in their places."""
        made = super().__new__(cls, template.format(**values))
        made.template, made.values = template, values
        return made

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, str]]:
        """Return what a copy is made of."""
        return (self.template,), self.values


def parts_of(text: str) -> Any:
    """Return a phrase as plain data for JSON: its template and its values; other text as it is.

    Parameters
    ----------
    text
        Text for people.
    """
    if not isinstance(text, Phrase):
        return text
    return [text.template, {name: parts_of(value) for name, value in text.values.items()}]


def counted(number: int | str, one: str, many: str) -> Phrase:
    """Return how many things there are: ``1 vertex``, ``2 vertices``.

    Parameters
    ----------
    number
        How many, as a number or as a person writes it.
    one, many
        The thing, and several of them.
    """
    return Phrase(f"{{number}} {one if str(number) == '1' else many}", number=str(number))


def joined(items: Sequence[str]) -> str:
    """Return items as a sentence has them: ``R1, R2 and R3``.

    Parameters
    ----------
    items
        Names or phrases, one at least.
    """
    first, *rest = items
    for item in rest[:-1]:
        first = Phrase("{first}, {second}", first=first, second=item)
    return Phrase("{first} and {last}", first=first, last=rest[-1]) if rest else first
