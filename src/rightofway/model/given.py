"""What callers give to the functions of the package, checked: scenarios, plans, seeds, robots."""

from __future__ import annotations

from collections.abc import Callable
from numbers import Integral
from typing import Any

from rightofway.arguments import is_whole
from rightofway.errors import InputError, Where, quote
from rightofway.model.plan import Plan
from rightofway.model.scenario import Scenario
from rightofway.values import allow_none, make_class_reader, read_at, read_function, read_truth

LARGEST_SEED = 2**32 - 1
"""Planners draw from this many streams."""


def require_scenario(scenario: Scenario, place: Where = "scenario") -> Scenario:
    """Return what a caller gave as a scenario.

    Raises
    ------
    InputError
        If it is none.
    """
    remedy = "load a file with rightofway.load, or build a fleet with FleetBuilder"
    return read_at(place, make_class_reader(Scenario, "no scenario", remedy), scenario)


def require_plan(plan: Plan, place: Where = "plan") -> Plan:
    """Return what a caller gave as a plan; parameters and errors as for `require_scenario`."""
    return read_at(
        place, make_class_reader(Plan, "no plan", "load a file with rightofway.load_plan"), plan
    )


def require_functions(**functions: Callable[..., Any] | None) -> None:
    """Refuse what callers gave as functions by the names of the arguments; None is no fault."""
    for place, given in functions.items():
        read_at(place, allow_none(read_function), given)


def require_truths(**truths: bool) -> None:
    """Refuse what callers gave as true or false by the names of the arguments."""
    for place, given in truths.items():
        read_at(place, read_truth, given)


def require_seed(seed: int) -> int:
    """Return what a caller gave as a seed.

    Raises
    ------
    InputError
        If it is not a whole number, or out of range.
    """
    return require_number("seed", seed, 0, LARGEST_SEED, "is no seed")


def require_number(place: Where, value: int, least: int, most: int, fault: str = "") -> int:
    """Return what a caller gave as a whole number from ``least`` to ``most``.

    Raises
    ------
    InputError
        If it is none.
    """
    if not is_whole(value) or not least <= value <= most:
        remedy = f"give a whole number from {least} to {most}"
        raise InputError.at(place, f"{quote(value)} {fault or 'is out of range'} ({remedy})")
    return int(value)


def require_index(place: Where, index: int, count: int) -> int:
    """Return what a caller gave as the number of a robot, or of another one of ``count``."""
    if not isinstance(index, Integral) or not 0 <= index < count:
        known = f"give 0 to {count - 1}" if count else "there are none"
        raise InputError.at(place, f"{quote(index)} is none of {count} ({known})")
    return int(index)
