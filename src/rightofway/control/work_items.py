"""Names of the work along a route: single stops, stops of jobs, begins and ends of charges.

A robot does each item in a visit by one action. A route and a journal name it by text: ``job3`` is
a single stop, ``J1/0`` the first stop of the job J1, ``charge2`` begins a charge, and ``charge2
end`` ends it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Literal

from rightofway.facts import Fact

__all__ = [
    "ChargeStep",
    "describe_item",
    "find_charge_step",
    "find_next_number",
    "find_stop",
    "name_charge",
    "name_item",
    "name_stop",
]

ChargeStep = Literal["begin", "end"]

NUMBERED = re.compile(r"(?:job|charge)([0-9]+)( end)?")
"""Items with a number of their robot; a name of a stop of a job has a slash."""


def name_stop(job: str, stop: int) -> str:
    """Return the item of a stop of a job; stops are numbered from 0."""
    return f"{job}/{stop}"


def name_charge(number: int, step: ChargeStep) -> str:
    """Return the item that begins or ends a charge."""
    return f"charge{number}" if step == "begin" else f"charge{number} end"


def find_stop(item: str) -> tuple[str, int] | None:
    """Return the job of an item and its stop; None for a single stop or a charge."""
    job, slash, stop = item.rpartition("/")
    return (job, int(stop)) if slash else None


def find_charge_step(item: str) -> ChargeStep | None:
    """Return the step of a charge; None for work."""
    numbered = NUMBERED.fullmatch(item)
    if numbered is None or item.startswith("job"):
        return None
    return "begin" if numbered[2] is None else "end"


def find_next_number(items: Iterable[str]) -> int:
    """Return the least number above those of all single stops and charges."""
    numbers = (numbered for item in items if (numbered := NUMBERED.fullmatch(item)))
    return max((int(numbered[1]) for numbered in numbers), default=-1) + 1


def describe_item(item: str) -> Fact | str:
    """Return an item for people: ``stop 2 of J1``, with stops numbered from 1."""
    step, stop = find_charge_step(item), find_stop(item)
    if step is not None:
        return Fact("charge begins" if step == "begin" else "charge ends")
    return item if stop is None else Fact("stop of job", job=stop[0], number=stop[1] + 1)


def name_item(robot: str, item: str) -> str:
    """Return the name by which people ask for an item: the stop of a job, or ``R1/job2``."""
    return f"{robot}/{item}" if find_stop(item) is None else item
