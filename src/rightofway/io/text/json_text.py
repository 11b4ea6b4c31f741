"""JSON text to plain data: mappings, lists, text, whole numbers, decimals, true, false, nothing."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from functools import partial
from typing import Any

from rightofway.errors import InputError, InputFault
from rightofway.io.text.exact import decimal, whole
from rightofway.io.words import place_of, shown

__all__ = ["MAX_DEPTH", "parse_json"]

MAX_DEPTH = 64
"""Mappings and lists inside each other, at most; ours need a dozen."""


def parse_json(text: str) -> Any:
    """Return the data of a JSON text, decimals exactly as they are written.

    Raises
    ------
    InputError
        For a fault in the syntax, a key given twice, or too deep a nesting.
    """
    doubled: list[tuple[dict[str, Any], str]] = []
    data = _loaded(text, partial(_mapping, doubled))
    _check_depth(data)
    if doubled:
        raise InputError(_twice(data, mapping, key) for mapping, key in doubled)
    return data


def _loaded(text: str, mapping_of: Callable[[list[tuple[str, Any]]], dict[str, Any]]) -> Any:
    try:
        return json.loads(
            text,
            object_pairs_hook=mapping_of,
            parse_float=decimal,
            parse_int=whole,
            parse_constant=str,  # NaN and Infinity: words, and refused as such
        )
    except json.JSONDecodeError as error:
        message = f"line {error.lineno}: {error.msg} (check the JSON there)"
        raise InputError.at("", message) from None
    except RecursionError:
        raise _too_deep() from None


def _mapping(
    doubled: list[tuple[dict[str, Any], str]], pairs: list[tuple[str, Any]]
) -> dict[str, Any]:
    """Return a mapping; note it in ``doubled`` with each key that is given twice."""
    mapping = dict(pairs)
    if len(mapping) < len(pairs):
        counts = Counter(key for key, _ in pairs)
        doubled += [(mapping, key) for key, count in counts.items() if count > 1]
    return mapping


def _twice(data: Any, mapping: dict[str, Any], key: str) -> InputFault:
    message = f"the key {shown(key)} is given twice (take one out)"
    return InputFault(place_of(_path_to(mapping, data)), message)


def _path_to(target: dict[str, Any], data: Any) -> tuple[str | int, ...]:
    waiting: list[tuple[tuple[str | int, ...], Any]] = [((), data)]
    while waiting:
        path, node = waiting.pop()
        if node is target:
            return path
        if isinstance(node, dict | list):
            steps = node.items() if isinstance(node, dict) else enumerate(node)
            waiting += [((*path, step), child) for step, child in steps]
    return ()  # it was itself overwritten by a key given twice


def _check_depth(data: Any) -> None:
    level = [data] if isinstance(data, dict | list) else []
    for _ in range(MAX_DEPTH):
        level = [
            child
            for node in level
            for child in (node.values() if isinstance(node, dict) else node)
            if isinstance(child, dict | list)
        ]
        if not level:
            return
    raise _too_deep()


def _too_deep() -> InputError:
    message = f"values are nested more than {MAX_DEPTH} deep (a document needs no such depth)"
    return InputError.at("", message)
