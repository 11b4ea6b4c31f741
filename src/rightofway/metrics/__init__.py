"""Costs of a plan and their lower bounds, losses of robots, weaknesses of a site."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.metrics.alone import compute_alone_completions
from rightofway.metrics.jobs import JobTimes, list_job_times
from rightofway.metrics.lost_time import compute_lost_time, join_waits
from rightofway.metrics.measure import Metrics, measure
from rightofway.metrics.outcome import derive_outcome
from rightofway.metrics.tours import TourCourse, trace_tours
from rightofway.metrics.waits import waits
from rightofway.provision import import_later

if TYPE_CHECKING:
    from rightofway.metrics.changes import Change, find_changes, find_job_changes
    from rightofway.metrics.collisions import (
        Collision,
        Swap,
        find_collisions,
        find_swaps,
        free_running,
    )
    from rightofway.metrics.comparison import MAX_COMPARED, Comparison, compare
    from rightofway.metrics.events import Event, list_events, make_event_columns
    from rightofway.metrics.forced_losses import find_forced_losses, find_forced_makespan
    from rightofway.metrics.inspection import inspect
    from rightofway.metrics.named_collisions import (
        NamedCollision,
        NamedCollisions,
        name_collisions,
    )
    from rightofway.metrics.near_misses import NearMiss, find_near_misses
    from rightofway.metrics.site import Finding, Inspection, Site

_MODULES = {
    "changes": (
        "Change",
        "find_changes",
        "find_job_changes",
    ),
    "collisions": (
        "Collision",
        "Swap",
        "find_collisions",
        "find_swaps",
        "free_running",
    ),
    "comparison": (
        "MAX_COMPARED",
        "Comparison",
        "compare",
    ),
    "events": (
        "Event",
        "list_events",
        "make_event_columns",
    ),
    "forced_losses": ("find_forced_losses", "find_forced_makespan"),
    "inspection": ("inspect",),
    "named_collisions": (
        "NamedCollision",
        "NamedCollisions",
        "name_collisions",
    ),
    "near_misses": ("NearMiss", "find_near_misses"),
    "site": (
        "Finding",
        "Inspection",
        "Site",
    ),
}

__all__ = [
    "MAX_COMPARED",
    "Change",
    "Collision",
    "Comparison",
    "Event",
    "Finding",
    "Inspection",
    "JobTimes",
    "Metrics",
    "NamedCollision",
    "NamedCollisions",
    "NearMiss",
    "Site",
    "Swap",
    "TourCourse",
    "compare",
    "compute_alone_completions",
    "compute_lost_time",
    "derive_outcome",
    "find_changes",
    "find_collisions",
    "find_forced_losses",
    "find_forced_makespan",
    "find_job_changes",
    "find_near_misses",
    "find_swaps",
    "free_running",
    "inspect",
    "join_waits",
    "list_events",
    "list_job_times",
    "make_event_columns",
    "measure",
    "name_collisions",
    "trace_tours",
    "waits",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
