"""Lines of reports: 80 columns, tables of times, counts."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable

from rightofway.quantities import Quantities, Value

COLUMNS = 80
"""Longest line of a report."""

MAX_NAME = 40
"""Columns that a robot's name may take in a table."""

NO_BREAK = "\N{NO-BREAK SPACE}"
"""A space at which no line is broken."""

UNIT = re.compile(r"(?<=\d) (?=[a-z])|(?<=\d h) (?=\d)|(?<=\d min) (?=\d)")
"""The spaces within ``2 min 34.3 s``."""


def wrapped(text: str, indent: str = "") -> list[str]:
    """Return the lines of a sentence; a number and its unit stay in one line."""
    return _broken(text, indent, indent + "    ").splitlines()


def row(key: str, text: str, column: int) -> str:
    """Return a row of a report: a key, and from a column on its text, on several lines if long."""
    return _broken(text, f"{key:{column}}", " " * column)


def _broken(text: str, first: str, following: str) -> str:
    joined = UNIT.sub(NO_BREAK, text)
    filled = textwrap.fill(joined, COLUMNS, initial_indent=first, subsequent_indent=following)
    return filled.replace(NO_BREAK, " ")


def short(name: str, columns: int = MAX_NAME) -> str:
    """Return a robot's name in the columns that it may take."""
    return name if len(name) <= columns else f"{name[: columns - 1]}…"


def counted(number: int, noun: str) -> str:
    """Return a number and its noun: ``1 more robot``, ``3 more robots``."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def further(quantities: Quantities) -> Callable[[Value], str]:
    """Return how times after the first one of a sentence are written.

    Where all times are in one unit, ``time 4`` goes on with ``13``, ``8 ticks`` with ``9``.
    """
    is_one_unit = quantities.in_ticks or not quantities.time_unit
    return quantities.cell if is_one_unit else quantities.duration
