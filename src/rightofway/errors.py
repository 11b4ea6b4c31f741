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

import difflib
import re
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from rightofway.phrases import Phrase, joined

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

__all__ = [
    "Blockage",
    "GaveUp",
    "InputError",
    "InputFault",
    "InvalidPlan",
    "NoPlanExists",
    "RightOfWayError",
    "is_printable",
    "kernel_limits",
    "listed",
    "nearest",
    "printable",
    "shown",
]

MAX_REASONS = 50
"""Reasons why no plan exists that a message lists."""

FEW = 4
"""Items of a list that a message shows."""

MANY = 500
"""Known words that are searched for the one that was meant."""

STEP = re.compile(r"\[(\d+)\]|([^.\[]+)")
"""A list index or a key of a place in a document."""

LONGEST = 60
"""Characters of a value that a message shows."""


@dataclass(frozen=True, slots=True)
class InputFault:
    """One thing wrong with an input.

    Attributes
    ----------
    place
        Where it stands, as a path into the document: ``robots[3].speed``. Empty for the whole.
    message
        What is wrong, with the value, and what to do about it in brackets.
    line
        The line of the file, from 1, where that is known.
    named
        The place with the names of its list items: ``robots[3] (R4): speed``, where that is known.
    about
        The place as a list of faults has it: ``R4: speed``, where that is known.
    """

    place: str
    message: str
    line: int | None = None
    named: str = ""
    about: str = ""

    def __post_init__(self) -> None:
        if not self.message.isprintable():
            object.__setattr__(self, "message", printable(self.message))

    def __str__(self) -> str:
        return self.after("")

    @property
    def path(self) -> tuple[str | int, ...]:
        """The keys and list indices that lead to it: ``("robots", 3, "speed")``."""
        steps = STEP.findall(self.place)
        return tuple(int(index) if index else key for index, key in steps)

    def after(self, source: str) -> str:
        """Return the fault with the name of its file: ``fleet.yaml:31: robots[3]: …``."""
        line = (
            "" if self.line is None else f"{source}:{self.line}" if source else f"line {self.line}"
        )
        parts = (line or source, self.named or self.place, self.message)
        return printable(": ".join(part for part in parts if part))

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
        return "\n".join(fault.after(self.source) for fault in self.faults)


@contextmanager
def kernel_limits() -> Iterator[None]:
    """Raise as `InputError` what a native kernel refuses because its integers cannot hold it."""
    try:
        yield
    except OverflowError as limit:
        place, _, message = str(limit).partition(": ")
        raise InputError.at(place, message) from limit


@dataclass(frozen=True, slots=True)
class Blockage:
    """A proven reason why a scenario has no plan.

    Attributes
    ----------
    reason
        Which robots are blocked, where and why.
    robots
        Names of the robots that it concerns.
    vertices
        Names of the vertices that it concerns.
    remedy
        What to do; empty where nothing is known to help.
    """

    reason: str
    robots: tuple[str, ...]
    vertices: tuple[str, ...]
    remedy: str = ""

    def __str__(self) -> str:
        return f"{self.reason} ({self.remedy})" if self.remedy else self.reason


class NoPlanExists(RightOfWayError):
    """It is proven that the scenario has no plan; the message says why.

    Parameters
    ----------
    reasons
        A sentence, or every blockage that was found.
    """

    def __init__(self, reasons: str | Iterable[Blockage]) -> None:
        found = [Blockage(reasons, (), ())] if isinstance(reasons, str) else reasons
        self.blockages = tuple(found)
        super().__init__(self.blockages)

    def __str__(self) -> str:
        listed = [str(blockage) for blockage in self.blockages[:MAX_REASONS]]
        more = len(self.blockages) - len(listed)
        return "\n".join([*listed, *([f"and {more} more"] if more else [])])

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of all robots concerned, each once."""
        return tuple(dict.fromkeys(name for one in self.blockages for name in one.robots))

    @property
    def vertices(self) -> tuple[str, ...]:
        """Names of all vertices concerned, each once."""
        return tuple(dict.fromkeys(name for one in self.blockages for name in one.vertices))

    def as_dict(self) -> dict[str, object]:
        """Return the blockages as plain data for JSON."""
        return {
            "reasons": [
                {"reason": str(one), "robots": list(one.robots), "vertices": list(one.vertices)}
                for one in self.blockages
            ],
            "robots": list(self.robots),
            "vertices": list(self.vertices),
        }


class GaveUp(RightOfWayError):
    """No plan was found within the planner's means or the time limit; one may exist.

    Attributes
    ----------
    lower_bound
        No plan has a smaller flowtime [ticks]; None where none is proven.
    """

    lower_bound: int | None = None


class InvalidPlan(RightOfWayError):
    """A planner returned a plan that breaks a rule; please report it."""


def shown(value: object) -> str:
    """Return a value as a message shows it: printable, on one line, and not longer than needed."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return f"a mapping of {len(value)}"
    if isinstance(value, list | tuple):
        return _list_shown(value)
    if isinstance(value, int) and value.bit_length() > LONGEST * 3:
        return f"a number of {value.bit_length()} bits"
    if isinstance(value, str):
        value = value[: 2 * LONGEST]  # its repr would be as long as it is
    written = str(value) if isinstance(value, int | Decimal | Fraction) else repr(value)
    return written if len(written) <= LONGEST else f"{written[: LONGEST - 1]}…"


def _list_shown(items: list[object] | tuple[object, ...]) -> str:
    is_long = len(items) > FEW or any(isinstance(item, list | tuple) for item in items)
    return f"a list of {len(items)}" if is_long else f"[{', '.join(map(shown, items))}]"


def listed(names: Sequence[str]) -> str:
    """Return names as a sentence has them: ``R1, R2 and R3``, long lists cut."""
    most = 2 * FEW
    if len(names) <= most:
        return joined(names) if names else ""
    return joined([*names[: most - 1], Phrase("{number} more", number=str(len(names) - most + 1))])


def printable(text: str) -> str:
    r"""Return text with escapes for what a terminal would obey, and for what is no character.

    Examples
    --------
    >>> print(printable("a\x1b[2Jb\u202ec\ud800"))
    a\x1b[2Jb\u202ec\ud800
    """
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else repr(each)[1:-1] for each in text)


def is_printable(text: str) -> bool:
    """Return whether a name may stand in tables and messages: not empty, no control codes."""
    return bool(text) and text.isprintable()


def nearest(word: object, known: Collection[str]) -> str | None:
    """Return the known word that was probably meant; None where the search would take long."""
    text = str(word)
    if len(text) > LONGEST or len(known) > MANY:
        return None
    return next(iter(difflib.get_close_matches(text, known, n=1)), None)
