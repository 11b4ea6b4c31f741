"""What planners can be told: a frozen dataclass for each, from which all else is derived.

An option is a field. Its type says what it may be, its default comes first, and the sentence beside
the type says what it does. Tables of the documentation, the help of the command line and the checks
of values are made from that.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Annotated, Any, Literal, Self, get_args, get_origin, get_type_hints

from rightofway.errors import InputError, nearest

__all__ = [
    "AutoOptions",
    "Choice",
    "Count",
    "LacamOptions",
    "Least",
    "LnsOptions",
    "LocalSearchOptions",
    "Option",
    "PlannerOptions",
    "PrioritizedOptions",
    "PriorityOptions",
    "PrioritySearchOptions",
    "RandomPriorityOptions",
    "TwoLevelOptions",
    "unknown",
]


@dataclass(frozen=True, slots=True)
class Choice:
    """An option that is one of several words.

    Attributes
    ----------
    name
        As in ``--option name=value``.
    choices
        The values it may have, the default first.
    summary
        What it does, in a sentence.
    """

    name: str
    choices: tuple[str, ...]
    summary: str

    @property
    def default(self) -> str:
        """The value where none is given."""
        return self.choices[0]

    @property
    def accepts(self) -> str:
        """What may be given, for people."""
        return "|".join(self.choices)

    def read(self, given: object) -> str:
        """Return the value for what was given.

        Raises
        ------
        InputError
            If it is not a choice.
        """
        if str(given) not in self.choices:
            message = f"{str(given)!r} is not a choice (give one of: {', '.join(self.choices)})"
            raise InputError.at(f"option {self.name}", message)
        return str(given)


@dataclass(frozen=True, slots=True)
class Count:
    """An option that is a whole number.

    Attributes
    ----------
    name
        As in ``--option name=value``.
    default
        The value where none is given.
    least
        The least it may be.
    summary
        What it does, in a sentence.
    """

    name: str
    default: int
    least: int
    summary: str

    @property
    def accepts(self) -> str:
        """What may be given, for people."""
        return str(self.default)

    def read(self, given: object) -> int:
        """Return the value for what was given.

        Raises
        ------
        InputError
            If it is no whole number, or too small.
        """
        text = str(given)
        if not (text.isascii() and text.isdecimal() and int(text) >= self.least):
            message = f"{text!r} is not a whole number of {self.least} or more"
            raise InputError.at(f"option {self.name}", f"{message} (for example {self.default})")
        return int(text)


Option = Choice | Count
"""Something a planner can be told."""


@dataclass(frozen=True, slots=True)
class Least:
    """The least value of a count."""

    value: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerOptions:
    """The options of a planner; this one has none, and others derive from it.

    Raises
    ------
    InputError
        For an option or a value that the planner does not know.

    Examples
    --------
    A count and a choice, for a planner of your own:

    >>> @dataclass(frozen=True, slots=True, kw_only=True)
    ... class MyOptions(PlannerOptions):
    ...     rounds: Annotated[int, Least(1), "How many rounds."] = 5
    ...     order: Annotated[Literal["file", "random"], "Which robot is planned first."] = "file"
    >>> MyOptions(rounds="7")
    MyOptions(rounds=7, order='file')
    """

    def __new__(cls, **given: object) -> Self:
        """Refuse options that the planner does not know."""
        known = [field.name for field in fields(cls)]
        for name in given:
            if name not in known:
                raise InputError.at(f"option {name}", unknown(name, cls.__name__, known))
        return object.__new__(cls)

    def __post_init__(self) -> None:
        for option in self.described():
            object.__setattr__(self, option.name, option.read(getattr(self, option.name)))

    @classmethod
    def described(cls) -> tuple[Option, ...]:
        """Return every option with its default, what it may be, and what it does."""
        hints = get_type_hints(cls, include_extras=True)
        return tuple(_option(field.name, field.default, hints[field.name]) for field in fields(cls))

    def as_dict(self) -> dict[str, str | int]:
        """Return every option by name, as files keep them."""
        return asdict(self)


def _option(name: str, default: Any, hint: Any) -> Option:
    kind, *notes = get_args(hint)
    summary = next(note for note in notes if isinstance(note, str))
    if get_origin(kind) is Literal:
        words = (default, *(word for word in get_args(kind) if word != default))
        return Choice(name, words, summary)
    least = next((note.value for note in notes if isinstance(note, Least)), 0)
    return Count(name, default, least, summary)


def unknown(name: str, owner: str, known: list[str]) -> str:
    """Return a sentence on a name that is not known, with the nearest one that is."""
    near = nearest(name, known)
    hint = f"did you mean {near!r}? " if near else ""
    return f"{name!r} is unknown to {owner} ({hint}known: {', '.join(known) or 'none'})"


def settled(
    options: type[PlannerOptions], given: PlannerOptions | Mapping[str, Any], planner: str
) -> dict[str, str | int]:
    """Return a value for every option of a planner: the given ones, and defaults for the rest.

    Raises
    ------
    InputError
        For options of another planner, and for a name or a value that the planner does not know.
    """
    if isinstance(given, options):
        return given.as_dict()
    if not isinstance(given, Mapping):
        wanted = f"{options.__name__}, or names with values"
        raise InputError.at("options", f"{given!r} are no options of {planner} (give {wanted})")
    known = [option.name for option in options.described()]
    for name in given:
        if name not in known:
            raise InputError.at(f"option {name}", unknown(str(name), planner, known))
    return options(**given).as_dict()


Swaps = Annotated[
    Literal["resolve", "leave"],
    "Keep robots that meet head-on apart, or do as published (on shortest routes).",
]
Routes = Annotated[
    Literal["clear", "shortest"],
    "Keep clear of others where that is no long way round, or take shortest routes.",
]
Iterations = Annotated[
    int,
    "How many neighbourhoods are replanned at most; 0: as time and gains allow.",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class AutoOptions(PlannerOptions):
    """Options of ``auto``."""

    swaps: Swaps = "resolve"
    iterations: Iterations = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class TwoLevelOptions(PlannerOptions):
    """Options of ``two-level``."""

    swaps: Swaps = "resolve"
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class LacamOptions(PlannerOptions):
    """Options of ``lacam``."""

    paths: Annotated[
        Literal["spread", "shortest"],
        "Spread the preferred paths first, or leave every robot its shortest way.",
    ] = "spread"


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalSearchOptions(PlannerOptions):
    """Options of ``local-search``."""

    routes: Routes = "clear"
    rounds: Annotated[int, "How often to favour some robots and go on from there."] = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class PriorityOptions(PlannerOptions):
    """Options of ``fixed-priority``."""

    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomPriorityOptions(PlannerOptions):
    """Options of ``random-priority``."""

    restarts: Annotated[int, Least(1), "How many orders to try."] = 20
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class PrioritySearchOptions(PlannerOptions):
    """Options of ``priority-search``."""

    rounds: Annotated[int, Least(1), "How many orders to try in a climb."] = 10
    restarts: Annotated[int, Least(1), "How many climbs, each from another order."] = 2
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class PrioritizedOptions(PlannerOptions):
    """Options of ``prioritized``."""

    order: Annotated[
        Literal["shortest", "longest", "slowest", "file", "random"],
        "Which robot is planned first: shortest or longest trip, slowest, as in the file.",
    ] = "shortest"


@dataclass(frozen=True, slots=True, kw_only=True)
class LnsOptions(PlannerOptions):
    """Options of ``lns``."""

    iterations: Iterations = 0
