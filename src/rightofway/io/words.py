"""How places of a document look in messages."""

from __future__ import annotations

from collections.abc import Iterable

from rightofway.errors import is_printable, nearest, shown

__all__ = ["is_printable", "nearest", "place_of", "shown"]


def place_of(parts: Iterable[str | int]) -> str:
    """Return a path into a document as text: ``robots[3].stops[0].work``."""
    place = ""
    for part in parts:
        if isinstance(part, str) and part.isidentifier():
            place += f".{part}" if place else part
        else:
            place += f"[{shown(part)}]"
    return place
