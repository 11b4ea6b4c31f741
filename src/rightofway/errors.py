"""Everything this package raises on purpose.

::

    RightOfWayError
    ├── InputError      the scenario, plan or option is wrong; lists every fault found
    ├── NoPlanExists    proven: no plan can exist, with the reason
    ├── GaveUp          no plan was found; one may exist
    └── InvalidPlan     a planner handed back a plan that the judge refuses (a defect of ours)

A message gives the place, the fault with its value, and the remedy.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from itertools import takewhile
from typing import TYPE_CHECKING, Any, Self

from rightofway.facts import Fact

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence

__all__ = [
    "Blockage",
    "GaveUp",
    "InputError",
    "InputFault",
    "InvalidPlan",
    "KernelLimit",
    "Location",
    "NoPlanExists",
    "RightOfWayError",
    "Steps",
    "Where",
    "as_location",
    "describe_defect",
    "describe_error",
    "escape_text",
    "find_nearest",
    "format_path",
    "is_printable",
    "join_names",
    "locate_faults",
    "name_file",
    "quote",
]

MAX_REASONS = 50
"""Reasons why no plan exists that a message lists."""

FEW = 4
"""Items of a list that a message shows."""

MANY = 500
"""Known words that are searched for the one that was meant."""

LONGEST = 60
"""Characters of a value that a message shows."""


Steps = tuple[str | int, ...]
"""Keys and list indices that lead to a value: ``("robots", 3, "speed")``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Location:
    """A position in an input, part by part; it can be formatted as text but not parsed.

    Attributes
    ----------
    path
        Keys and list indices that lead to it; the first one may be a label, as ``--step`` is.
    file
        The file or argument; empty for data in no file.
    line
        The line of the file, from 1, where that is known.
    cell
        The cell of a workbook, like ``robots!C4``; ``path`` then leads on from there.
    names
        For each step of the path the name of the item that it leads to; empty for one without.
    inner
        The place in another file, where the document names that file here.
    """

    path: Steps = ()
    file: str = ""
    line: int | None = None
    cell: str = ""
    names: tuple[str, ...] = ()
    inner: Location | None = None

    def __str__(self) -> str:
        line = "" if self.line is None else f"line {self.line}"
        start = f"{self.file}:{self.line}" if self.file and line else self.file or line
        parts = (start, self.cell, self.named, str(self.inner or ""))
        return ": ".join(part for part in parts if part)

    @property
    def place(self) -> str:
        """The cell and the path as text: ``robots[3].speed``."""
        return ": ".join(part for part in (self.cell, format_path(self.path)) if part)

    @property
    def named(self) -> str:
        """The path as text, with the names of list items: ``robots[3] (R4): speed``."""
        return format_path(self.path, self.names)

    @property
    def about(self) -> str:
        """The place as a list of faults has it, a robot by its name: ``R4: speed``."""
        for index, name in enumerate(self.names):
            if name and self.path[0] == "robots":
                rest = format_path(self.path[index + 1 :], self.names[index + 1 :])
                return f"{name}: {rest}" if rest else name
        return self.named or self.place

    def nest(self, outer: Where) -> Location:
        """Return the same place seen from outside: one in another file is the inner one there."""
        whole = as_location(outer)
        if whole.inner:
            return replace(whole, inner=self.nest(whole.inner))
        if self.file:
            return self if whole == Location() else replace(whole, inner=self)
        return replace(
            self,
            path=whole.path + self.path,
            line=whole.line if self.line is None else self.line,
            cell=self.cell or whole.cell,
            file=whole.file,
        )


Where = str | int | Steps | Location
"""A position as an argument: a key, an index, several of them, or a location."""


def as_location(where: Where) -> Location:
    """Return a position as a location; the empty text is the whole input."""
    if isinstance(where, Location):
        return where
    if isinstance(where, tuple):
        return Location(path=where)
    return Location() if where == "" else Location(path=(where,))


def format_path(path: Steps, names: Sequence[str] = ()) -> str:
    """Return keys and list indices as text: ``robots[3].stops[0].work``.

    Parameters
    ----------
    path
        Keys and list indices.
    names
        For each step the name of the item that it leads to, which is shown behind the step.
    """
    text = joint = ""
    for index, step in enumerate(path):
        if not isinstance(step, str):
            text += f"{joint.removeprefix('.')}[{step}]"
            joint = "."
        elif joint == "." and not step.isidentifier():
            text += f"[{quote(step)}]"
        else:
            text += f"{joint}{step}"
            joint = "." if step.isidentifier() else ": "
        if index < len(names) and names[index]:
            text += f" ({names[index]})"
            joint = ": "
    return text


@dataclass(frozen=True, slots=True, init=False)
class InputFault:
    """One fault of an input.

    Parameters
    ----------
    where
        Its place: a key, keys and indices, or a `Location`.
    words
        The fault, with the value, and the remedy in brackets. ``{other}`` stands for
        the other place.
    other
        Another place that it has to do with, where there is one.
    """

    location: Location
    words: str
    other: Location | None

    def __init__(self, where: Where, words: str, other: Where | None = None) -> None:
        object.__setattr__(self, "location", as_location(where))
        object.__setattr__(self, "words", escape_text(words))
        object.__setattr__(self, "other", None if other is None else as_location(other))

    def __str__(self) -> str:
        text = ": ".join(part for part in (str(self.location), self.message) if part)
        return escape_text(text)

    @property
    def message(self) -> str:
        """The fault, with the value, and the remedy in brackets."""
        if self.other is None:
            return self.words
        other, path = self.other, self.location.path
        while other.inner:
            other = other.inner
        pairs = zip(path, other.path, strict=False)
        shared = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
        line = "" if other.line is None else f"line {other.line}"
        near = other.cell or line or format_path(other.path[max(shared - 1, 0) :])
        return self.words.replace("{other}", near)

    @property
    def path(self) -> Steps:
        """The keys and list indices that lead to it."""
        return self.location.path

    @property
    def place(self) -> str:
        """The path as text: ``robots[3].speed``; empty for the whole input."""
        return self.location.place

    @property
    def line(self) -> int | None:
        """The line of the file, from 1, where that is known."""
        return self.location.line

    @property
    def file(self) -> str:
        """The file or argument of the fault; empty for data in no file."""
        return self.location.file

    def map_locations(self, move: Callable[[Location], Location]) -> InputFault:
        """Return the same fault, its places as a function has them."""
        other = None if self.other is None else move(self.other)
        return InputFault(move(self.location), self.words, other)

    def nest(self, outer: Where) -> InputFault:
        """Return the same fault seen from outside ``outer``: ``a`` holding ``b`` is ``a.b``."""
        if self.file:
            return self.place_at(self.location.nest(outer))
        return self.map_locations(lambda place: place.nest(outer))

    def relocate(self, starts: Mapping[Steps, Where]) -> InputFault:
        """Return the same fault, the longest known start of its path as it is known there."""

        def move(place: Location) -> Location:
            for length in range(len(place.path), -1, -1):
                if place.path[:length] in starts:
                    rest = replace(place, path=place.path[length:], names=())
                    return rest.nest(starts[place.path[:length]])
            return place

        return self.map_locations(move)

    def place_at(self, location: Location) -> InputFault:
        """Return the same fault at another place."""
        return InputFault(location, self.words, self.other)

    def name_file(self, file: str) -> InputFault:
        """Return the same fault in a file or argument of this name."""
        return self.place_at(replace(self.location, file=file))


class RightOfWayError(Exception):
    """The base class of all exceptions that this package raises on purpose."""

    def explain(self) -> Fact:
        """Return the reason as a fact; messages on inputs are text."""
        return Fact("other", text=str(self))


class InputError(RightOfWayError, ValueError):
    """An input of the user is wrong.

    Parameters
    ----------
    faults
        All independent faults that were found, in the order of the document.
    source
        The file or argument of the faults that name none.
    """

    def __init__(self, faults: Iterable[InputFault], source: str = "") -> None:
        self.faults = tuple(
            fault.name_file(source) if source and not fault.file else fault for fault in faults
        )
        super().__init__(self.faults)

    @classmethod
    def at(cls, where: Where, message: str, source: str = "") -> Self:
        """Make an error of a single fault."""
        return cls([InputFault(where, message)], source)

    @property
    def source(self) -> str:
        """The file or argument of the faults; empty where none is known."""
        return next((fault.file for fault in self.faults if fault.file), "")

    def __str__(self) -> str:
        return "\n".join(map(str, self.faults))


@contextmanager
def locate_faults(where: Where) -> Iterator[None]:
    """Report every fault raised inside as a fault at a place.

    Parameters
    ----------
    where
        The place; where a fault stands in another file, the place that names that file.
    """
    try:
        yield
    except InputError as error:
        raise InputError(fault.nest(where) for fault in error.faults) from None


@contextmanager
def name_file(source: str) -> Iterator[None]:
    """Add the name of a file or argument to the faults raised inside.

    Parameters
    ----------
    source
        Its name; faults with a file keep it.
    """
    try:
        yield
    except InputError as error:
        raise InputError(error.faults, source) from None


class KernelLimit(InputError, OverflowError):
    """A number of the input, or one derived from it, exceeds the integers of the native core."""


@dataclass(frozen=True, slots=True)
class Blockage:
    """A proven reason why a scenario has no plan.

    Attributes
    ----------
    reason
        The fact that blocks robots; or an English sentence, from planners of other packages.
    robots
        The robots that it concerns, by index.
    vertices
        The vertices that it concerns, by index.
    remedy
        The change that helps; empty where none is known.
    """

    reason: Fact | str
    robots: tuple[int, ...] = ()
    vertices: tuple[int, ...] = ()
    remedy: Fact | str = ""

    def bind(self, scenario: Any) -> Blockage:
        """Return the blockage of a scenario."""
        reason = self.reason
        return replace(self, reason=reason.bind(scenario)) if isinstance(reason, Fact) else self

    def explain(self) -> Fact:
        """Return the reason and its remedy as one fact."""
        reason = self.reason
        if not isinstance(reason, Fact):
            reason = Fact("other", text=reason)
        if not self.remedy:
            return reason
        return Fact("fact and remedy", reason.about, fact=reason, remedy=self.remedy)

    def __str__(self) -> str:
        return f"{self.reason} ({self.remedy})" if self.remedy else str(self.reason)


class NoPlanExists(RightOfWayError):
    """It is proven that the scenario has no plan; the message has the reason.

    Parameters
    ----------
    reasons
        A fact, an English sentence, or every blockage that was found.
    scenario
        The scenario of their robots and vertices; None where they have none.
    """

    def __init__(self, reasons: Fact | str | Iterable[Blockage], scenario: Any = None) -> None:
        if isinstance(reasons, Fact | str):
            reasons = [Blockage(reasons)]
        self.blockages = tuple(blockage.bind(scenario) for blockage in reasons)
        self.scenario = scenario
        super().__init__(self.blockages, scenario)

    def __str__(self) -> str:
        listed = [str(blockage) for blockage in self.blockages[:MAX_REASONS]]
        more = len(self.blockages) - len(listed)
        return "\n".join([*listed, *([str(Fact("more reasons", number=more))] if more else [])])

    def explain(self) -> Fact:
        """Return the first blockages, and the number of the others."""
        reasons = [blockage.explain() for blockage in self.blockages[:FEW]]
        if more := len(self.blockages) - len(reasons):
            reasons.append(Fact("more reasons", number=more))
        whole = reasons.pop()
        for reason in reversed(reasons):
            whole = Fact("two reasons", self.scenario, one=reason, other=whole)
        return whole

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of all robots concerned, each once."""
        robots = (robot for blockage in self.blockages for robot in blockage.robots)
        return self._name_robots(robots)

    @property
    def vertices(self) -> tuple[str, ...]:
        """Names of all vertices concerned, each once."""
        return self._name_vertices(
            place for blocked in self.blockages for place in blocked.vertices
        )

    def _name_robots(self, robots: Iterable[int]) -> tuple[str, ...]:
        return tuple(self.scenario.robots[robot].name for robot in dict.fromkeys(robots))

    def _name_vertices(self, vertices: Iterable[int]) -> tuple[str, ...]:
        return tuple(self.scenario.roadmap.name(vertex) for vertex in dict.fromkeys(vertices))

    def as_dict(self) -> dict[str, Any]:
        """Return the blockages as plain data for JSON."""
        return {
            "reasons": [
                {
                    "kind": blockage.reason.kind if isinstance(blockage.reason, Fact) else "other",
                    "reason": str(blockage),
                    "robots": list(self._name_robots(blockage.robots)),
                    "vertices": list(self._name_vertices(blockage.vertices)),
                }
                for blockage in self.blockages
            ],
            "robots": list(self.robots),
            "vertices": list(self.vertices),
        }


class GaveUp(RightOfWayError):
    """No plan was found within the limits of the planner or the time limit; one may exist.

    Parameters
    ----------
    reason
        The fact that ended the search; or an English sentence, from planners of other packages.

    Attributes
    ----------
    reason
        As given.
    lower_bound
        No plan has a smaller flowtime [ticks]; None where none is proven.
    """

    lower_bound: int | None = None

    def __init__(self, reason: Fact | str) -> None:
        super().__init__(reason)
        self.reason = reason

    def explain(self) -> Fact:
        """Return the reason."""
        return self.reason if isinstance(self.reason, Fact) else super().explain()


class InvalidPlan(RightOfWayError):
    """A planner returned a plan that breaks a rule; please report it."""


def quote(value: object) -> str:
    """Return a value formatted for a message: printable, short, and on one line."""
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
    return f"a list of {len(items)}" if is_long else f"[{', '.join(map(quote, items))}]"


def join_names(names: Sequence[str]) -> str:
    """Return names joined as in an English sentence: ``R1, R2 and R3``; long lists are cut."""
    most = 2 * FEW
    if len(names) > most:
        names = [*names[: most - 1], f"{len(names) - most + 1} more"]
    *others, last = names or [""]
    return f"{', '.join(others)} and {last}" if others else last


def escape_text(text: str) -> str:
    r"""Return text with escapes for control characters and for lone surrogates.

    Examples
    --------
    >>> print(escape_text("a\x1b[2Jb\u202ec\ud800"))
    a\x1b[2Jb\u202ec\ud800
    """
    if text.isprintable():
        return text
    return "".join(
        character if character.isprintable() else repr(character)[1:-1] for character in text
    )


def is_printable(text: str) -> bool:
    """Return whether a name is fit for tables and messages: not empty, no control codes."""
    return bool(text) and text.isprintable()


def describe_error(error: BaseException) -> str:
    """Return the kind and the text of an exception in one line.

    Parameters
    ----------
    error
        The exception.
    """
    return " ".join([f"{type(error).__name__}:", *str(error).split()])


def describe_defect(error: BaseException) -> str:
    """Return on one line an exception that this package does not raise on purpose."""
    return escape_text(f"unexpected {describe_error(error)[:MANY]} (please report it)")


def find_nearest(word: object, known: Collection[str]) -> str | None:
    """Return the most similar known word; None if the search would take long."""
    text = str(word)
    if len(text) > LONGEST or len(known) > MANY:
        return None
    import difflib

    return next(iter(difflib.get_close_matches(text, known, n=1)), None)
