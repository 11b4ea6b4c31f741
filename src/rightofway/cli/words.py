"""Sentences about plans: robots and places by name, durations, lines of at most 80 columns."""

from __future__ import annotations

import textwrap

from rightofway.model import Plan

__all__ = ["COLUMNS", "names_of", "ticks", "wrapped"]

COLUMNS = 80


def names_of(plan: Plan) -> list[str]:
    """Return the names of the robots."""
    return [robot.name for robot in plan.scenario.robots]


def ticks(number: int) -> str:
    """Return a number of ticks in words."""
    return f"{number} tick" + "s" * (number != 1)


def wrapped(text: str, indent: str = "") -> list[str]:
    """Return the lines of a sentence."""
    return textwrap.wrap(text, COLUMNS, initial_indent=indent, subsequent_indent=indent + "    ")
