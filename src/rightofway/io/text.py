"""Text files to plain data and back: UTF-8, JSON and TOML read strictly, JSON laid out for people.

Plain data are mappings, lists, text, whole numbers, decimals, true, false and nothing. Whatever a
file holds instead is an InputError with its place. YAML has a module of its own.
"""

from __future__ import annotations

import json
import re
import sys
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, InputFault, shown
from rightofway.io.faults import place_of
from rightofway.io.numbers import decimal, whole
from rightofway.io.yaml_text import MAX_DEPTH, parse_yaml

__all__ = [
    "MAX_BYTES",
    "Rendered",
    "json_line",
    "json_text",
    "parse_json",
    "parse_toml",
    "read_document",
    "read_text",
]

MAX_BYTES = 2**29
"""Largest file that is read [bytes]."""

SPREAD_KEYS = {"scenario", "map", "grid", "roadmap", "vertices", "edges", "robots"}
SPREAD_KEYS |= {"planner", "decisions", "reroutes", "steady"}
"""Values of these keys are spread over lines in JSON; each item in them stays on one line."""

_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
_TOML_PLACE = re.compile(r"(?P<what>.*) \((?P<place>at .*)\)", re.DOTALL)


class Rendered(str):
    """JSON text that stands in a document in place of its value."""

    __slots__ = ()


def read_document(path: Path) -> Any:
    """Return the data of a YAML or JSON file, told apart by its name, else by its start."""
    text = read_text(path)
    suffix = path.suffix.lower()
    if suffix == ".map":
        message = "a map has no robots (write a scenario with map: {file: ...}, or give a .scen)"
        raise InputError.at("", message)
    if suffix == ".toml":
        message = "TOML is for the suites of benchmarks (write scenarios and plans as YAML or JSON)"
        raise InputError.at("", message)
    looks_like_json = text.lstrip().startswith(("{", "["))
    is_json = suffix == ".json" or (suffix not in {".yaml", ".yml"} and looks_like_json)
    return parse_json(text) if is_json else parse_yaml(text)


def read_text(path: Path) -> str:
    """Return the text of a file, UTF-8 with any kind of line end; ``-`` is standard input."""
    source = str(path)
    try:
        data = _read(path, MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise InputError.at("", _why_unreadable(error), source) from None
    if not data.strip():
        raise InputError.at("", "the file is empty (give it some content)", source)
    if len(data) > MAX_BYTES:
        message = f"the file is longer than {MAX_BYTES} bytes (is it the right one?)"
        raise InputError.at("", message, source)
    return _decoded(data, source).replace("\r\n", "\n").replace("\r", "\n")


def _read(path: Path, size: int) -> bytes:
    if str(path) == "-":
        return sys.stdin.buffer.read(size)
    with path.open("rb") as file:
        return file.read(size)


def _why_unreadable(error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file (check the path)"
    if isinstance(error, IsADirectoryError):
        return "this is a directory (give a file in it)"
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"the file cannot be read: {reason} (check the path and its permissions)"


def _decoded(data: bytes, source: str) -> str:
    if data[:2] in {b"\xff\xfe", b"\xfe\xff"}:
        raise InputError.at("", "the file is UTF-16 text (save it as UTF-8)", source)
    if b"\0" in data:
        at = data.index(b"\0")
        raise InputError.at("", f"the file is not text: byte {at} is 0 (give a text file)", source)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        message = f"line {line}: byte {data[error.start]:#x} is not UTF-8 (save the file as UTF-8)"
        raise InputError.at("", message, source) from None


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
            parse_float=decimal,
            parse_int=whole,
            parse_constant=str,  # NaN and Infinity: words, and refused as words
        )
    except json.JSONDecodeError as error:
        message = f"line {error.lineno}: {error.msg} (check the JSON there)"
        raise InputError.at("", message) from None
    except RecursionError:
        raise _too_deep() from None
    _check_depth(data)
    if doubled:
        raise InputError(
            InputFault(
                place_of(_path_to(mapping, data)),
                f"the key {shown(key)} is given twice (take one out)",
            )
            for mapping, key in doubled
        )
    return data


def _path_to(target: dict[str, Any], data: Any) -> tuple[str | int, ...]:
    waiting: list[tuple[tuple[str | int, ...], Any]] = [((), data)]
    while waiting:
        path, node = waiting.pop()
        if node is target:
            return path
        if isinstance(node, dict | list):
            steps = node.items() if isinstance(node, dict) else enumerate(node)
            waiting += [((*path, step), child) for step, child in steps]
    return ()  # a key given twice has overwritten the mapping


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


def json_text(document: dict[str, Any]) -> str:
    """Return a document as JSON text with one row, robot or edge on a line."""
    return _spread(document, "\n") + "\n"


def _spread(value: dict[str, Any] | list[Any], margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, list):
        return f"[{inner}{f',{inner}'.join(map(json_line, value))}{margin}]"
    pairs = (
        f"{json_line(key)}: "
        f"{_spread(child, inner) if key in SPREAD_KEYS and child else json_line(child)}"
        for key, child in value.items()
    )
    return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"


def json_line(value: Any) -> str:
    """Return a value as JSON text on one line."""
    return value if isinstance(value, Rendered) else _ENCODER.encode(value)


def parse_toml(text: str) -> dict[str, Any]:
    """Return the data of a TOML text."""
    try:
        return tomllib.loads(text, parse_float=decimal)
    except RecursionError:
        raise InputError.at("", "it is nested too deeply (make it flatter)") from None
    except ValueError as error:
        found = _TOML_PLACE.fullmatch(str(error))
        what, place = (found["what"], found["place"]) if found else (str(error), "")
        message = f"this is no TOML: {what[:1].lower()}{what[1:]} (mend it)"
        raise InputError.at(place.removeprefix("at "), message) from None
