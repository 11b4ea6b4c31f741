"""Ways to choose routes and right of way; each planner is one module and one registry line."""

from rightofway.model.deadline import Deadline
from rightofway.planners.options import (
    AutoOptions,
    LacamOptions,
    Least,
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
from rightofway.planners.registry import DEFAULT, IMPROVER, PlannerSpec, find, registered
from rightofway.planners.task import (
    Draft,
    Planner,
    Task,
    planning_headway,
    planning_problem,
)

__all__ = [
    "DEFAULT",
    "IMPROVER",
    "AutoOptions",
    "Deadline",
    "Draft",
    "LacamOptions",
    "Least",
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
    "planning_headway",
    "planning_problem",
    "registered",
]
