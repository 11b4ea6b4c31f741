"""Plain data to JSON text that people can read: one row, robot or edge on a line."""

from __future__ import annotations

import json
from typing import Any

__all__ = ["Rendered", "json_line", "json_text"]

OPEN = {"scenario", "map", "grid", "roadmap", "vertices", "edges", "robots"}
OPEN |= {"planner", "decisions", "reroutes", "steady"}
"""What stands in these keys is spread over lines; everything inside their items is not."""

ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)


class Rendered(str):
    """JSON text that stands in a document in place of its value."""

    __slots__ = ()


def json_text(document: dict[str, Any]) -> str:
    """Return a document as JSON text; the same document gives the same text."""
    return _spread(document, "\n") + "\n"


def _spread(value: dict[str, Any] | list[Any], margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, list):
        return f"[{inner}{f',{inner}'.join(map(json_line, value))}{margin}]"
    pairs = (
        f"{json_line(key)}: {_spread(child, inner) if key in OPEN and child else json_line(child)}"
        for key, child in value.items()
    )
    return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"


def json_line(value: Any) -> str:
    """Return a value as JSON text on one line."""
    if isinstance(value, Rendered):
        return value
    return ENCODER.encode(value)
