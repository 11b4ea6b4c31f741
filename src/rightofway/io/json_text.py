"""JSON: read strictly to plain data, and laid out for people."""

from __future__ import annotations

import json
from collections import Counter
from typing import Any

from rightofway.errors import InputError, InputFault, quote
from rightofway.io.plain_data import (
    check_depth,
    describe_column,
    make_depth_fault,
    make_line_fault,
    read_decimal,
    read_whole,
)

SPREAD_KEYS = {"scenario", "map", "grid", "roadmap", "vertices", "edges", "robots"}
SPREAD_KEYS |= {"planner", "decisions", "reroutes", "steady"}
"""Values of these keys are spread over lines in JSON; each item in them stays on one line."""

_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)

_MARK = "\ufdd0"
"""A text between the items of a long list; it is no character, so that no name contains it."""


def parse_json(text: str) -> Any:
    """Return the data of a JSON text; no key may be given twice, nor be nested too deeply."""
    doubled: list[tuple[dict[str, Any], str]] = []  # mappings, each with a key given twice

    def mapping_of(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        mapping = dict(pairs)
        if len(mapping) < len(pairs):
            counts = Counter(key for key, _ in pairs)
            doubled.extend((mapping, key) for key, count in counts.items() if count > 1)
        return mapping

    try:
        data = json.loads(
            text,
            object_pairs_hook=mapping_of,
            parse_float=read_decimal,
            parse_int=read_whole,
            parse_constant=str,  # NaN and Infinity: words, and refused as words
        )
    except json.JSONDecodeError as error:
        column = describe_column(text, error.lineno, error.colno)
        raise make_line_fault(error.lineno, f"{error.msg}{column} (check the JSON there)") from None
    except RecursionError:
        raise make_depth_fault() from None
    check_depth(data)
    if doubled:
        raise InputError(
            InputFault(
                _find_path(mapping, data),
                f"the key {quote(key)} is given twice (take one out)",
            )
            for mapping, key in doubled
        )
    return data


def _find_path(target: dict[str, Any], data: Any) -> tuple[str | int, ...]:
    waiting: list[tuple[tuple[str | int, ...], Any]] = [((), data)]
    while waiting:
        path, node = waiting.pop()
        if node is target:
            return path
        if isinstance(node, dict | list):
            steps = node.items() if isinstance(node, dict) else enumerate(node)
            waiting += [((*path, step), child) for step, child in steps]
    return ()  # a key given twice has overwritten the mapping


def format_json(document: dict[str, Any]) -> str:
    """Return a document as JSON text with one row, robot or edge on a line."""
    return _write_spread(document, "\n") + "\n"


def _write_spread(value: dict[str, Any] | list[Any], margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, list):
        return f"[{inner}{f',{inner}'.join(_format_json_lines(value))}{margin}]"
    pairs = (
        f"{format_json_line(key)}: "
        + (_write_spread(child, inner) if _is_spread(key, child) else format_json_line(child))
        for key, child in value.items()
    )
    return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"


def _is_spread(key: str, value: Any) -> bool:
    return key in SPREAD_KEYS and isinstance(value, list | dict) and bool(value)


def _format_json_lines(values: list[Any]) -> list[str]:
    """Return each of several values on a line; all by one call of the encoder, which is slow."""
    marked: list[Any] = [_MARK] * (2 * len(values) - 1)
    marked[::2] = values
    lines = format_json_line(marked)[1:-1].split(f', "{_MARK}", ')
    return lines if len(lines) == len(values) else list(map(format_json_line, values))


def format_json_line(value: Any) -> str:
    """Return a value as JSON text on one line."""
    return _ENCODER.encode(value)
