"""Plain data to JSON text that people can read: one row, robot or edge on a line."""

from __future__ import annotations

import json
from typing import Any

__all__ = ["json_text"]

OPEN = {"scenario", "map", "grid", "roadmap", "vertices", "edges", "robots"}
OPEN |= {"planner", "decisions", "reroutes", "steady"}
"""What stands in these keys is spread over lines; everything inside their items is not."""


def json_text(document: dict[str, Any]) -> str:
    """Return a document as JSON text; the same document gives the same text."""
    return _spread(document, "\n") + "\n"


def _spread(value: dict[str, Any] | list[Any], margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, list):
        return f"[{inner}{f',{inner}'.join(map(_line, value))}{margin}]"
    pairs = (
        f"{_line(key)}: {_spread(child, inner) if key in OPEN and child else _line(child)}"
        for key, child in value.items()
    )
    return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
