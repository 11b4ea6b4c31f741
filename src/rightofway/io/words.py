"""How values and places of a document look in messages."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable
from decimal import Decimal
from fractions import Fraction

__all__ = ["is_printable", "nearest", "place_of", "shown"]

FEW = 4
"""Items of a list that a message shows."""

MANY = 500
"""Known words that are searched for the one that was meant."""

LONGEST = 60
"""Characters of a value that a message shows."""


def shown(value: object) -> str:
    """Return a value as a message shows it: printable, on one line, and not longer than needed."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return f"a mapping of {len(value)}"
    if isinstance(value, list | tuple):
        return _list_shown(value)
    if isinstance(value, int) and value.bit_length() > LONGEST * 3:
        return f"a number of {value.bit_length()} bits"
    if isinstance(value, str):
        value = value[: 2 * LONGEST]  # its repr would be as long as it is
    written = str(value) if isinstance(value, int | Decimal | Fraction) else repr(value)
    return written if len(written) <= LONGEST else f"{written[: LONGEST - 1]}…"


def _list_shown(items: list[object] | tuple[object, ...]) -> str:
    is_long = len(items) > FEW or any(isinstance(item, list | tuple) for item in items)
    return f"a list of {len(items)}" if is_long else f"[{', '.join(map(shown, items))}]"


def is_printable(text: str) -> bool:
    """Return whether a name may stand in tables and messages: not empty, no control codes."""
    return bool(text) and text.isprintable()


def nearest(word: object, known: Collection[str]) -> str | None:
    """Return the known word that was probably meant; None where the search would take long."""
    text = str(word)
    if len(text) > LONGEST or len(known) > MANY:
        return None
    return next(iter(difflib.get_close_matches(text, known, n=1)), None)


def place_of(parts: Iterable[str | int]) -> str:
    """Return a path into a document as text: ``robots[3].stops[0].work``."""
    place = ""
    for part in parts:
        if isinstance(part, str) and part.isidentifier():
            place += f".{part}" if place else part
        else:
            place += f"[{shown(part)}]"
    return place
