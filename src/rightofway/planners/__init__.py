"""Ways to choose routes and right of way; each planner is one module and one registry line."""

from rightofway.planners.registry import (
    DEFAULT,
    IMPROVER,
    Choice,
    Count,
    Option,
    PlannerSpec,
    find,
    registered,
)
from rightofway.planners.task import Deadline, Draft, Planner, Task, planning_headway

__all__ = [
    "DEFAULT",
    "IMPROVER",
    "Choice",
    "Count",
    "Deadline",
    "Draft",
    "Option",
    "Planner",
    "PlannerSpec",
    "Task",
    "find",
    "planning_headway",
    "registered",
]
