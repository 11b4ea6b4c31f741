"""The options of planners: a frozen dataclass for each, from which all else is derived.

An option is a field. Its type says what it may be, its default comes first, and the sentence beside
the type says what it does. Tables of the documentation, the help of the command line and the checks
of values are made from that.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Annotated, Any, Literal, Self, get_args, get_origin, get_type_hints

from rightofway.errors import InputError, nearest


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """An option of a planner: one of several words, or a whole number.

    Attributes
    ----------
    name
        As in ``--option name=value``.
    default
        The value where none is given.
    summary
        What it does, in a sentence.
    choices
        The words, the default first; empty for a number.
    least
        The least number.
    """

    name: str
    default: str | int
    summary: str
    choices: tuple[str, ...] = ()
    least: int = 0

    @property
    def accepts(self) -> str:
        """The words, or an example of a number, as help texts show them."""
        return "|".join(self.choices) or str(self.default)

    def read(self, given: object) -> str | int:
        """Return the value for what was given, a number also for its text.

        Raises
        ------
        InputError
            If it is none of the words, no whole number, or too small.
        """
        text = str(given)
        if self.choices:
            if text in self.choices:
                return text
            remedy = f"is not a choice (give one of: {', '.join(self.choices)})"
        else:
            if text.isascii() and text.isdecimal() and int(text) >= self.least:
                return int(text)
            remedy = f"is not a whole number of {self.least} or more (for example {self.default})"
        raise InputError.at(f"option {self.name}", f"{text!r} {remedy}")


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
        hints, described = get_type_hints(cls, include_extras=True), []
        for field in fields(cls):
            default: Any = field.default
            kind, *notes = get_args(hints[field.name])
            summary = next(note for note in notes if isinstance(note, str))
            words = get_args(kind) if get_origin(kind) is Literal else ()
            described.append(
                Option(
                    name=field.name,
                    default=default,
                    summary=summary,
                    choices=tuple(sorted(words, key=lambda word: word != default)),
                    least=next((note.value for note in notes if isinstance(note, Least)), 0),
                )
            )
        return tuple(described)

    def as_dict(self) -> dict[str, str | int]:
        """Return every option by name, as files keep them."""
        return asdict(self)


def unknown(name: str, owner: str, known: list[str]) -> str:
    """Return a sentence on a name that is not known, with the nearest one that is."""
    near = nearest(name, known)
    hint = f"did you mean {near!r}? " if near else ""
    return f"{name!r} is unknown to {owner} ({hint}known: {', '.join(known) or 'none'})"


Swaps = Annotated[
    Literal["resolve", "leave"],
    "Resolve swaps, or leave them as the planner paper does.",
]
Routes = Annotated[
    Literal["clear", "shortest"],
    "Avoid other robots where the detour is short, or take shortest routes.",
]
Iterations = Annotated[
    int,
    "Most neighbourhoods to replan; 0: until time is up or gains end.",
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
        "Spread the preferred paths over the map, or give each robot its shortest path.",
    ] = "spread"


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalSearchOptions(PlannerOptions):
    """Options of ``local-search``."""

    routes: Routes = "clear"
    rounds: Annotated[
        int, "Rounds after the first descent; each gives more weight to some robots."
    ] = 100


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
        "First robot: the shortest or longest trip, the slowest, as in the file, random.",
    ] = "shortest"


@dataclass(frozen=True, slots=True, kw_only=True)
class LnsOptions(PlannerOptions):
    """Options of ``lns``."""

    iterations: Iterations = 0
