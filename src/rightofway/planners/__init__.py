"""Ways to choose routes and right of way; each planner is one module and one registry line."""

from rightofway.deadline import Deadline
from rightofway.planners.features import ANY_FLEET, Feature
from rightofway.planners.options import (
    AutoOptions,
    CbsOptions,
    LacamOptions,
    LnsOptions,
    LocalSearchOptions,
    Option,
    PlannerOptions,
    PrioritizedOptions,
    PriorityOptions,
    PrioritySearchOptions,
    RandomPriorityOptions,
    TwoLevelOptions,
)
from rightofway.planners.registry import DEFAULT_PLANNER, IMPROVER, PlannerSpec, find, find_all
from rightofway.repair.task import (
    Draft,
    Planner,
    Task,
)

__all__ = [
    "ANY_FLEET",
    "DEFAULT_PLANNER",
    "IMPROVER",
    "AutoOptions",
    "CbsOptions",
    "Deadline",
    "Draft",
    "Feature",
    "LacamOptions",
    "LnsOptions",
    "LocalSearchOptions",
    "Option",
    "Planner",
    "PlannerOptions",
    "PlannerSpec",
    "PrioritizedOptions",
    "PriorityOptions",
    "PrioritySearchOptions",
    "RandomPriorityOptions",
    "Task",
    "TwoLevelOptions",
    "find",
    "find_all",
]
