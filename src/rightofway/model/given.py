"""What callers give to the functions of the package, checked: scenarios, plans, seeds, robots."""

from __future__ import annotations

from numbers import Integral

from rightofway.errors import InputError, shown
from rightofway.model.plan import Plan
from rightofway.model.scenario import Scenario

LARGEST_SEED = 2**32 - 1
"""Planners draw from this many streams."""


def checked_scenario(scenario: Scenario, place: str = "scenario") -> Scenario:
    """Return what a caller gave as a scenario.

    Parameters
    ----------
    scenario
        Anything.
    place
        The name of the argument.

    Raises
    ------
    InputError
        If it is none.
    """
    if not isinstance(scenario, Scenario):
        remedy = "load a file with rightofway.load, or build a fleet with FleetBuilder"
        raise InputError.at(place, f"{shown(scenario)} is no scenario ({remedy})")
    return scenario


def checked_plan(plan: Plan, place: str = "plan") -> Plan:
    """Return what a caller gave as a plan; parameters and errors as for `checked_scenario`."""
    if not isinstance(plan, Plan):
        remedy = "load a file with rightofway.load_plan"
        raise InputError.at(place, f"{shown(plan)} is no plan ({remedy})")
    return plan


def checked_seed(seed: int) -> int:
    """Return what a caller gave as a seed.

    Raises
    ------
    InputError
        If it is not a whole number, or out of range.
    """
    return checked_number("seed", seed, 0, LARGEST_SEED, "is no seed")


def checked_number(place: str, value: int, least: int, most: int, what: str = "") -> int:
    """Return what a caller gave as a whole number from ``least`` to ``most``.

    Parameters
    ----------
    place
        The name of the argument.
    value
        Anything.
    least, most
        The bounds, both included.
    what
        What is wrong with another value.

    Raises
    ------
    InputError
        If it is none.
    """
    if not isinstance(value, Integral) or not least <= value <= most:
        remedy = f"give a whole number from {least} to {most}"
        raise InputError.at(place, f"{shown(value)} {what or 'is out of range'} ({remedy})")
    return int(value)


def checked_index(place: str, index: int, count: int) -> int:
    """Return what a caller gave as the number of a robot, or of another one of ``count``."""
    if not isinstance(index, Integral) or not 0 <= index < count:
        known = f"give 0 to {count - 1}" if count else "there are none"
        raise InputError.at(place, f"{shown(index)} is none of {count} ({known})")
    return int(index)
