"""Ways to choose routes and right of way; each planner is one module and one registry line."""

from rightofway.deadline import Deadline
from rightofway.planners import options
from rightofway.planners.features import ANY_FLEET, Feature
from rightofway.planners.options import *  # noqa: F403
from rightofway.planners.registry import DEFAULT_PLANNER, IMPROVER, PlannerSpec, find, find_all
from rightofway.repair.plan_request import (
    Draft,
    Planner,
    PlanRequest,
)

__all__ = [
    "ANY_FLEET",
    "DEFAULT_PLANNER",
    "IMPROVER",
    "Deadline",
    "Draft",
    "Feature",
    "PlanRequest",
    "Planner",
    "PlannerSpec",
    "find",
    "find_all",
]
__all__ += options.__all__
