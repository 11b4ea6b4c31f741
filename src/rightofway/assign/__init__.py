"""Homes of robots that have none, and tours: which robot does which jobs, in which order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.assign.alternatives import JobCost, list_job_costs
    from rightofway.assign.bounds import WorkBound
    from rightofway.assign.homes import HOMELESS, deal_homes
    from rightofway.assign.tours import AssignmentCost, AssignmentSearch
    from rightofway.assign.travel import Travel, measure_travel

_MODULES = {
    "bounds": ("WorkBound",),
    "alternatives": (
        "JobCost",
        "list_job_costs",
    ),
    "homes": (
        "HOMELESS",
        "deal_homes",
    ),
    "tours": (
        "AssignmentCost",
        "AssignmentSearch",
    ),
    "travel": (
        "Travel",
        "measure_travel",
    ),
}

__all__ = [
    "HOMELESS",
    "AssignmentCost",
    "AssignmentSearch",
    "JobCost",
    "Travel",
    "WorkBound",
    "deal_homes",
    "list_job_costs",
    "measure_travel",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
