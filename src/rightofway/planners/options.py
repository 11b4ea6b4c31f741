"""The options of planners: a frozen dataclass for each, from which all else is derived.

An option is a field. Its annotation has its type, its kind unless that is usual for the type, and a
sentence on its effect. Tables of the documentation, the help of the command line and the checks of
values are derived from it.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from fractions import Fraction
from functools import cache
from typing import Annotated, Any, Literal, Self, get_args, get_origin, get_type_hints

from rightofway.errors import InputError, find_nearest
from rightofway.kinds.numbers import parse_digits
from rightofway.kinds.table import COUNT, NOT_NEGATIVE, Kind, make_number, make_whole, make_words

__all__ = [
    "AutoOptions",
    "CbsOptions",
    "LacamOptions",
    "LnsOptions",
    "LocalSearchOptions",
    "Option",
    "PlannerOptions",
    "PrioritizedOptions",
    "PriorityOptions",
    "PrioritySearchOptions",
    "RandomPriorityOptions",
    "TwoLevelOptions",
]
"""The names that `rightofway.planners` exports."""

Value = str | int | Fraction
"""The value of an option."""

USUAL_KINDS: dict[Any, Kind[Any]] = {int: make_whole(0), Fraction: NOT_NEGATIVE}
"""The kinds of numbers whose options name none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """An option of a planner.

    Attributes
    ----------
    name
        As in ``--option name=value``.
    default
        The value where none is given.
    summary
        A sentence on its effect.
    kind
        The kind of its values.
    """

    name: str
    default: Value
    summary: str
    kind: Kind[Any]

    @property
    def choices(self) -> tuple[str, ...]:
        """The words that it may be, the default first; empty for a number."""
        return tuple(sorted(self.kind.words, key=lambda word: word != self.default))

    def read(self, given: object) -> Value:
        """Return the value for a value or its text.

        An exact number is kept as it is written, a float as the shortest decimal that stands for
        it: ``1.05`` is 21/20.

        Raises
        ------
        InputError
            If it is of another kind.
        """
        value: Value = self.kind.read_at(("options", self.name), parse_digits(given))
        return value


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerOptions:
    """The options of a planner; this one has none, and others derive from it.

    Raises
    ------
    InputError
        For an option or a value that the planner does not know.

    Examples
    --------
    A count, an exact number and a choice, for a planner of your own:

    >>> @dataclass(frozen=True, slots=True, kw_only=True)
    ... class MyOptions(PlannerOptions):
    ...     rounds: Annotated[int, make_whole(1), "How many rounds."] = 5
    ...     share: Annotated[Fraction, make_number(0, 1), "Part of the robots."] = Fraction(1, 2)
    ...     order: Annotated[Literal["file", "random"], "Which robot is planned first."] = "file"
    >>> MyOptions(rounds="7", share=0.1)
    MyOptions(rounds=7, share=Fraction(1, 10), order='file')
    """

    def __new__(cls, **given: object) -> Self:
        """Refuse options that the planner does not know."""
        known = [field.name for field in fields(cls)]
        for name in given:
            if name not in known:
                raise InputError.at(("options", name), describe_unknown(name, cls.__name__, known))
        return object.__new__(cls)

    def __post_init__(self) -> None:
        for option in self.described():
            object.__setattr__(self, option.name, option.read(getattr(self, option.name)))

    @classmethod
    def described(cls) -> tuple[Option, ...]:
        """Return every option with its default, its kind and its effect."""
        return _list_options(cls)  # type: ignore[arg-type]  # a class is hashable

    def as_dict(self) -> dict[str, Value]:
        """Return every option by name."""
        return asdict(self)


@cache
def _list_options(owner: type[PlannerOptions]) -> tuple[Option, ...]:
    hints, options = get_type_hints(owner, include_extras=True), []
    for field in fields(owner):
        annotation, *notes = get_args(hints[field.name])
        words = get_args(annotation) if get_origin(annotation) is Literal else ()
        usual = make_words(*words) if words else USUAL_KINDS[annotation]
        kind = next((note for note in notes if isinstance(note, Kind)), usual)
        summary = next(note for note in notes if isinstance(note, str))
        default: Any = field.default
        options.append(Option(name=field.name, default=default, summary=summary, kind=kind))
    return tuple(options)


def describe_unknown(name: str, owner: str, known: list[str]) -> str:
    """Return a sentence on a name that is not known, with the nearest one that is."""
    near = find_nearest(name.lower(), known)
    hint = f"did you mean {near!r}? " if near else ""
    return f"{name!r} is unknown to {owner} ({hint}known: {', '.join(known) or 'none'})"


Swaps = Annotated[
    Literal["resolve", "leave"],
    "Keep robots that meet head-on apart; or leave their swaps, as published, on shortest routes.",
]
Routes = Annotated[
    Literal["clear", "shortest"],
    "Avoid other robots where the detour is short; or take shortest routes.",
]
Iterations = Annotated[
    int,
    "Number of neighbourhoods to replan; 0: until time is up or nothing improves any more.",
]


ObjectiveOption = Annotated[
    Literal["flowtime", "makespan", "both"],
    "Minimize the flowtime, by weights and with surcharges; or the latest completion time, then the"
    " flowtime; or both, the latest completion time as much as all others together.",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class AutoOptions(PlannerOptions):
    """Options of ``auto``."""

    objective: ObjectiveOption = "flowtime"
    swaps: Swaps = "resolve"
    iterations: Iterations = 0
    nodes: Annotated[
        int,
        "Number of nodes of conflict-based search and of steps of prices, for proofs; 0: until time"
        " is up.",
    ] = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class TwoLevelOptions(PlannerOptions):
    """Options of ``two-level``."""

    objective: ObjectiveOption = "flowtime"
    swaps: Swaps = "resolve"
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class LacamOptions(PlannerOptions):
    """Options of ``lacam``."""

    paths: Annotated[
        Literal["spread", "shortest"],
        "Distribute the paths over the map first; or keep each robot on its shortest path.",
    ] = "spread"


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalSearchOptions(PlannerOptions):
    """Options of ``local-search``."""

    objective: ObjectiveOption = "flowtime"
    routes: Routes = "clear"
    rounds: Annotated[int, "Number of restarts, each with some robots favoured."] = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class PriorityOptions(PlannerOptions):
    """Options of ``fixed-priority``."""

    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomPriorityOptions(PlannerOptions):
    """Options of ``random-priority``."""

    objective: ObjectiveOption = "flowtime"
    restarts: Annotated[int, COUNT, "Number of random orders to try."] = 20
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class PrioritySearchOptions(PlannerOptions):
    """Options of ``priority-search``."""

    objective: ObjectiveOption = "flowtime"
    rounds: Annotated[int, COUNT, "Number of orders to try in each climb."] = 10
    restarts: Annotated[int, COUNT, "Number of climbs, each from another order."] = 2
    routes: Routes = "clear"


@dataclass(frozen=True, slots=True, kw_only=True)
class PrioritizedOptions(PlannerOptions):
    """Options of ``prioritized``."""

    order: Annotated[
        Literal["shortest", "longest", "slowest", "file", "random"],
        "Which robot is planned first: by its trip, by its speed, by the file, or at random.",
    ] = "shortest"


@dataclass(frozen=True, slots=True, kw_only=True)
class LnsOptions(PlannerOptions):
    """Options of ``lns``."""

    objective: ObjectiveOption = "flowtime"
    iterations: Iterations = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class CbsOptions(PlannerOptions):
    """Options of ``cbs``."""

    objective: ObjectiveOption = "flowtime"
    suboptimality: Annotated[
        Fraction,
        make_number(1),
        "Stop at a plan whose cost is proven to be at most this factor above the least cost.",
    ] = Fraction(1)
    nodes: Annotated[int, "Number of nodes to expand; 0: until time is up."] = 0
    cardinal: Annotated[
        Literal["first", "any"],
        "Resolve conflicts first that cost both robots something; or the earliest conflict.",
    ] = "first"
    bypass: Annotated[
        Literal["yes", "no"],
        "Replace tracks by others of equal cost with fewer conflicts; or split every node.",
    ] = "yes"
    clear: Annotated[
        Literal["yes", "no"],
        "Look for tracks with the fewest conflicts for each node; or do not.",
    ] = "yes"
    targets: Annotated[
        Literal["yes", "no"],
        "Resolve conflicts with robots that have reached their ends for all later ticks at once.",
    ] = "yes"
    disjoint: Annotated[
        Literal["yes", "no"],
        "Split a conflict so that one robot is there, or is kept away; or keep one or the other"
        " away. For points without headway.",
    ] = "yes"
    pairs: Annotated[
        Literal["no", "yes"],
        "Split nodes by the completion times of two robots that lose to each other; or do not.",
    ] = "no"
    pair_nodes: Annotated[
        int,
        "Nodes for each pair of robots, whose losses by each other raise bounds; 0: none.",
    ] = 20
    joint_states: Annotated[
        int,
        "Joint states for all pairs that need more nodes, again for each fifty nodes; and for each"
        " fifty nodes for a fleet of at most four robots; 0: none.",
    ] = 10_000
