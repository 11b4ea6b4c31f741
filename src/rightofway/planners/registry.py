"""Which planners there are, and what each can be told; ours and those of other packages."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any, cast

from rightofway.errors import InputError
from rightofway.planners.task import Planner

__all__ = ["DEFAULT", "IMPROVER", "Choice", "Count", "Option", "PlannerSpec", "find", "registered"]


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several words that a planner can be told.

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
    """A whole number that a planner can be told.

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
class PlannerSpec:
    """A planner by name; its module is imported when it is first needed.

    Attributes
    ----------
    name
        As in ``--planner``: the published name in lower case.
    target
        ``module:function``; the function is a `Planner`.
    summary
        What it does, in a sentence.
    options
        What it can be told.
    improves
        Whether it can start from a plan and make it better.
    """

    name: str
    target: str
    summary: str
    options: tuple[Option, ...] = ()
    improves: bool = False

    def load(self) -> Planner:
        """Import the planner."""
        module, function = self.target.split(":")
        return cast("Planner", getattr(import_module(module), function))

    def settle(self, given: Mapping[str, Any]) -> dict[str, str | int]:
        """Return a value for every option: the given ones, and defaults for the rest.

        Raises
        ------
        InputError
            For an option or a value that the planner does not know.
        """
        known = {option.name: option for option in self.options}
        for name in given:
            if name not in known:
                raise InputError.at(f"option {name}", _unknown(name, self.name, list(known)))
        return {
            option.name: option.read(given.get(option.name, option.default))
            for option in self.options
        }


ROUTES = Choice(
    "routes",
    ("clear", "shortest"),
    "Keep clear of others where that is no long way round, or take shortest routes.",
)

SWAPS = Choice(
    "swaps",
    ("resolve", "leave"),
    "Keep robots that meet head-on apart, or do as published (on shortest routes).",
)

ITERATIONS = Count(
    "iterations",
    0,
    0,
    "How often some robots are planned anew at most; 0: as time and gains allow.",
)

PLANNERS = (
    PlannerSpec(
        "auto",
        "rightofway.planners.auto:auto",
        "The default: an answer at once, then a better one until time is up.",
        (SWAPS, ITERATIONS),
    ),
    PlannerSpec(
        "two-level",
        "rightofway.planners.two_level:two_level",
        "The paper's method: right of way by collisions left, then by work achieved sooner.",
        (SWAPS, ROUTES),
    ),
    PlannerSpec(
        "lacam",
        "rightofway.planners.lacam:lacam",
        "All robots together, instant by instant: a plan at once, also where there is no room.",
        (
            Choice(
                "paths",
                ("spread", "shortest"),
                "Spread the preferred paths first, or leave every robot its shortest way.",
            ),
        ),
    ),
    PlannerSpec(
        "local-search",
        "rightofway.planners.local_search:local_search",
        "Two-level, then flips of rights of way on critical paths until nothing improves.",
        (ROUTES, Count("rounds", 100, 0, "How often to favour some robots and go on from there.")),
        improves=True,
    ),
    PlannerSpec(
        "fixed-priority",
        "rightofway.planners.priorities:fixed_priority",
        "Right of way by the robots' numbers: the first in the scenario goes first.",
        (ROUTES,),
    ),
    PlannerSpec(
        "random-priority",
        "rightofway.planners.priorities:random_priority",
        "Right of way by random orders of the robots; the best of several plans.",
        (Count("restarts", 20, 1, "How many orders to try."), ROUTES),
    ),
    PlannerSpec(
        "priority-search",
        "rightofway.planners.priorities:priority_search",
        "Right of way by an order of the robots that hill climbing improves.",
        (
            Count("rounds", 10, 1, "How many orders to try in a climb."),
            Count("restarts", 2, 1, "How many climbs, each from another order."),
            ROUTES,
        ),
    ),
    PlannerSpec(
        "prioritized",
        "rightofway.planners.prioritized:prioritized",
        "One robot after another, each round those before it; who is in the way gives way.",
        (
            Choice(
                "order",
                ("shortest", "longest", "slowest", "file", "random"),
                "Who is planned first: shortest or longest trip, slowest robot, as in the file.",
            ),
        ),
    ),
    PlannerSpec(
        "lns",
        "rightofway.planners.lns:lns",
        "Better and better plans until time is up: a few robots at a time are planned anew.",
        (ITERATIONS,),
        improves=True,
    ),
)

DEFAULT = "auto"
"""What plans where no planner is named."""

IMPROVER = "lns"
"""What makes a plan better where no planner is named."""


def registered() -> dict[str, PlannerSpec]:
    """Return every planner by name: ours, then those of other packages."""
    specs = {spec.name: spec for spec in PLANNERS}
    for point in entry_points(group="rightofway.planners"):
        specs.setdefault(point.name, cast("PlannerSpec", point.load()))
    return specs


def find(name: str) -> PlannerSpec:
    """Return the planner of that name.

    Raises
    ------
    InputError
        If there is none; names the nearest.
    """
    specs = registered()
    if name not in specs:
        raise InputError.at("planner", _unknown(name, "rightofway", list(specs)))
    return specs[name]


def _unknown(name: str, owner: str, known: list[str]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    hint = f"did you mean {near[0]!r}? " if near else ""
    return f"{name!r} is unknown to {owner} ({hint}known: {', '.join(known) or 'none'})"
