"""Plain data of text files: exact numbers, limits of depth and length, columns of faults.

Plain data are mappings, lists, text, whole numbers, decimals, true, false and nothing. The readers
of YAML, JSON and TOML reject everything else in a file by an InputError with its place.
"""

from __future__ import annotations

import math
from decimal import Decimal
from io import StringIO
from itertools import islice
from typing import Any

from rightofway.errors import InputError, Location, quote

MAX_DEPTH = 64
"""Mappings and lists inside each other, at most; ours need a dozen."""

LONGEST_TOKEN = 40
"""A number of more characters stays text when a file is read, and is refused as a number."""

LARGEST_EXPONENT = 400
"""A decimal with a larger exponent stays text, too."""

SHORT_LINE = 80
"""Characters of a line in which a fault is found by eye."""

EXCERPT = 25
"""Characters before and after a fault that a message shows of a longer line."""


def read_whole(token: str) -> int | str:
    """Return a whole number of a file, or its text where it is too long."""
    return int(token) if len(token) <= LONGEST_TOKEN else token


def read_decimal(token: str) -> Decimal | str:
    """Return a decimal of a file exactly, or its text where no float comes near it."""
    _, _, exponent = token.lower().partition("e")
    if len(token) > LONGEST_TOKEN or abs(int(exponent or "0")) > LARGEST_EXPONENT:
        return token
    return Decimal(token) if math.isfinite(float(token)) else token


def describe_column(text: str, line: int, column: int) -> str:
    """Return the column of a fault with the text around it; nothing where the line is short.

    Line and column count from 1.
    """
    written = next(islice(StringIO(text), line - 1, None), "").rstrip("\n")
    if len(written) <= SHORT_LINE:
        return ""
    around = written[max(column - 1 - EXCERPT, 0) : column - 1 + EXCERPT]
    return f" at column {column}, in {quote(around)}"


def check_depth(data: Any) -> None:
    """Refuse data in which mappings and lists are inside each other more than `MAX_DEPTH` deep."""
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
    raise make_depth_fault()


def make_depth_fault(line: int | None = None) -> InputError:
    """Return the fault of data that are nested too deeply, with the line where it is known."""
    message = f"values are nested more than {MAX_DEPTH} deep (a document needs no such depth)"
    return InputError.at(Location(line=line), message)


def make_line_fault(line: int, message: str) -> InputError:
    """Return the fault of a line of a text."""
    return InputError.at(Location(line=line), message)
