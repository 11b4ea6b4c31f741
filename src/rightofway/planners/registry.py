"""Which planners there are: those of this package and those of others."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any, cast

from rightofway.errors import InputError, describe_error
from rightofway.extras import load_plugins
from rightofway.planners import options
from rightofway.planners.features import ANY_FLEET, Feature
from rightofway.planners.options import Option, PlannerOptions, Value
from rightofway.repair.plan_request import Planner

GROUP = "rightofway.planners"
"""Entry points of this group are further planners."""


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
        Its method, in a sentence.
    options_type
        Its options.
    features
        Its abilities: whether it starts from a plan, and which scenarios it knows.
    """

    name: str
    target: str
    summary: str
    options_type: type[PlannerOptions] = PlannerOptions
    features: frozenset[Feature] = frozenset()

    @property
    def options(self) -> tuple[Option, ...]:
        """Every option with its default, its values, and its effect."""
        return self.options_type.described()

    def load(self) -> Planner:
        """Import the planner.

        Raises
        ------
        InputError
            If it is a planner of another package and its module fails.
        """
        module, function = self.target.split(":")
        try:
            return cast("Planner", getattr(import_module(module), function))
        except (Exception, SystemExit) as error:
            if module.startswith("rightofway."):
                raise
            message = f"{self.name} cannot be imported: {describe_error(error)}"
            remedy = f"update or uninstall the package of {module}"
            raise InputError.at("planner", f"{message} ({remedy})") from error

    def settle(self, given: PlannerOptions | Mapping[str, Any]) -> dict[str, Value]:
        """Return a value for every option: the given ones, and defaults for the rest.

        Raises
        ------
        InputError
            For options of another planner, and for a name or a value that this one does not know.
        """
        if isinstance(given, self.options_type):
            return given.as_dict()
        if not isinstance(given, Mapping):
            remedy = f"give {self.options_type.__name__}, or names with values"
            message = f"{given!r} are no options of {self.name} ({remedy})"
            raise InputError.at("options", message)
        known = [option.name for option in self.options]
        for name in given:
            if name not in known:
                message = options.describe_unknown(str(name), self.name, known)
                raise InputError.at(("options", name), message)
        return self.options_type(**given).as_dict()


PLANNERS = (
    PlannerSpec(
        "auto",
        "rightofway.planners.auto:auto",
        "The default: a first plan early, then better plans until time is up.",
        options.AutoOptions,
        features=ANY_FLEET | {Feature.IMPROVES, Feature.JOBS},
    ),
    PlannerSpec(
        "two-level",
        "rightofway.planners.two_level:two_level",
        "The paper's method, swaps resolved: by collisions left, then by completion times.",
        options.TwoLevelOptions,
        features=ANY_FLEET,
    ),
    PlannerSpec(
        "paper",
        "rightofway.planners.two_level:paper",
        "The paper's method as published: swaps remain, and the exit code is 1 if there are any.",
        features=frozenset({Feature.LEAVES_SWAPS, Feature.BARRED_EDGES}),
    ),
    PlannerSpec(
        "lacam",
        "rightofway.planners.lacam:lacam",
        "Moves all robots together, step by step: a plan at once, also where there is hardly room.",
        options.LacamOptions,
        features=frozenset({Feature.SIZES, Feature.TURN_RATES}),
    ),
    PlannerSpec(
        "local-search",
        "rightofway.planners.local_search:local_search",
        "Two-level, then changes of rights of way on critical paths until no change improves.",
        options.LocalSearchOptions,
        features=ANY_FLEET | {Feature.IMPROVES},
    ),
    PlannerSpec(
        "fixed-priority",
        "rightofway.planners.priorities:fixed_priority",
        "Right of way in the order of the scenario: the first robot goes first.",
        options.PriorityOptions,
        features=ANY_FLEET,
    ),
    PlannerSpec(
        "random-priority",
        "rightofway.planners.priorities:random_priority",
        "Right of way by random orders of the robots; the best plan is kept.",
        options.RandomPriorityOptions,
        features=ANY_FLEET,
    ),
    PlannerSpec(
        "priority-search",
        "rightofway.planners.priorities:priority_search",
        "Right of way by an order of the robots that hill climbing improves.",
        options.PrioritySearchOptions,
        features=ANY_FLEET,
    ),
    PlannerSpec(
        "prioritized",
        "rightofway.planners.prioritized:prioritized",
        "One robot after another, around the earlier ones; a robot in the way is replanned.",
        options.PrioritizedOptions,
        features=ANY_FLEET | {Feature.JOBS},
    ),
    PlannerSpec(
        "lns",
        "rightofway.planners.lns:lns",
        "Large neighbourhood search: replans a few robots at a time until time is up.",
        options.LnsOptions,
        features=ANY_FLEET | {Feature.IMPROVES, Feature.JOBS},
    ),
    PlannerSpec(
        "cbs",
        "rightofway.planners.cbs:cbs",
        "Conflict-based search: the optimal plan of a small fleet, or one within a proven factor.",
        options.CbsOptions,
        features=ANY_FLEET,
    ),
)

DEFAULT_PLANNER = "auto"
"""The default planner."""

IMPROVER = "lns"
"""The default planner of `improve`."""


def find_all() -> dict[str, PlannerSpec]:
    """Return every planner by name: ours, then those of other packages.

    Notes
    -----
    Installed packages are searched once for each ``sys.path``.
    """
    specs = {spec.name: spec for spec in PLANNERS}
    for name, spec in _list_of_other_packages(tuple(sys.path)).items():
        specs.setdefault(name, spec)
    return specs


@cache
def _list_of_other_packages(_path: tuple[str, ...]) -> dict[str, PlannerSpec]:
    """Return the planners of packages that are installed on this ``sys.path``."""
    return load_plugins(GROUP, PlannerSpec)


def name_able(feature: Feature) -> str:
    """Return the names of all planners that have a feature, joined by "or"."""
    able = [name for name, spec in find_all().items() if feature in spec.features]
    return " or ".join(able) or "a planner of another package"


def find(name: str) -> PlannerSpec:
    """Return the planner of that name.

    Parameters
    ----------
    name
        The name of a planner.

    Raises
    ------
    InputError
        If no planner has that name; with the nearest name.
    """
    is_text = isinstance(name, str)
    ours = next((spec for spec in PLANNERS if is_text and spec.name == name), None)
    if ours is not None:
        return ours
    specs = find_all()
    if not is_text or name not in specs:
        message = options.describe_unknown(str(name), "rightofway", list(specs))
        raise InputError.at("planner", message)
    return specs[name]
