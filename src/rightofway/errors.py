"""Everything this package raises on purpose.

::

    RightOfWayError
    ├── InputError      the scenario, plan or option is wrong; lists every fault found
    ├── NoPlanExists    proven: no plan can exist, with the reason
    ├── GaveUp          no plan was found; one may exist
    └── InvalidPlan     a planner handed back a plan that the judge refuses (a defect of ours)

A message says where, what (with the value) and what to do.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = [
    "GaveUp",
    "InputError",
    "InputFault",
    "InvalidPlan",
    "NoPlanExists",
    "RightOfWayError",
    "kernel_limits",
]


@dataclass(frozen=True, slots=True)
class InputFault:
    """One thing wrong with an input.

    Attributes
    ----------
    place
        Where it stands, as a path into the document: ``robots[3].speed``. Empty for the whole.
    message
        What is wrong, with the value, and what to do about it in brackets.
    """

    place: str
    message: str

    def __str__(self) -> str:
        return f"{self.place}: {self.message}" if self.place else self.message

    def within(self, outer: str) -> InputFault:
        """Return the same fault seen from outside ``outer``: ``a`` holding ``b`` is ``a.b``."""
        if not self.place:
            return InputFault(outer, self.message)
        joint = "" if self.place.startswith("[") else "."
        return InputFault(f"{outer}{joint}{self.place}", self.message)


class RightOfWayError(Exception):
    """The root of everything this package raises on purpose."""


class InputError(RightOfWayError, ValueError):
    """Something given by the user is wrong.

    Parameters
    ----------
    faults
        All independent faults that were found, in the order of the document.
    source
        The file or argument they stand in, shown before each place.
    """

    def __init__(self, faults: Iterable[InputFault], source: str = "") -> None:
        self.faults = tuple(faults)
        self.source = source
        super().__init__(self.faults, source)

    @classmethod
    def at(cls, place: str, message: str, source: str = "") -> InputError:
        """Make an error of a single fault."""
        return cls([InputFault(place, message)], source)

    def __str__(self) -> str:
        prefix = f"{self.source}: " if self.source else ""
        return "\n".join(f"{prefix}{fault}" for fault in self.faults)


@contextmanager
def kernel_limits() -> Iterator[None]:
    """Raise as `InputError` what a native kernel refuses because its integers cannot hold it."""
    try:
        yield
    except OverflowError as limit:
        place, _, message = str(limit).partition(": ")
        raise InputError.at(place, message) from limit


class NoPlanExists(RightOfWayError):
    """It is proven that the scenario has no plan; the message says why."""


class GaveUp(RightOfWayError):
    """No plan was found within the planner's means or the time limit; one may exist."""


class InvalidPlan(RightOfWayError):
    """A planner returned a plan that breaks a rule; please report it."""
