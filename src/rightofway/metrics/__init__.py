"""What a plan costs and must cost at least, what robots lose and where, what hurts on a site."""

from rightofway.metrics.alone import alone_completions
from rightofway.metrics.changes import Change, changes
from rightofway.metrics.collisions import (
    Collision,
    NamedCollision,
    NearMiss,
    Swap,
    collisions,
    free_running,
    name_collisions,
    near_misses,
    swaps,
)
from rightofway.metrics.comparison import MAX_COMPARED, Comparison, compare
from rightofway.metrics.events import Event, event_columns, events
from rightofway.metrics.forced_losses import ForcedLoss, find_forced_losses
from rightofway.metrics.inspection import inspect
from rightofway.metrics.lost_time import join_waits, lost_time
from rightofway.metrics.measure import Metrics, measure
from rightofway.metrics.outcome import outcome_of
from rightofway.metrics.site import HEADINGS, Finding, Inspection, Site, sentences
from rightofway.metrics.waits import waits

__all__ = [
    "HEADINGS",
    "MAX_COMPARED",
    "Change",
    "Collision",
    "Comparison",
    "Event",
    "Finding",
    "ForcedLoss",
    "Inspection",
    "Metrics",
    "NamedCollision",
    "NearMiss",
    "Site",
    "Swap",
    "alone_completions",
    "changes",
    "collisions",
    "compare",
    "event_columns",
    "events",
    "find_forced_losses",
    "free_running",
    "inspect",
    "join_waits",
    "lost_time",
    "measure",
    "name_collisions",
    "near_misses",
    "outcome_of",
    "sentences",
    "swaps",
    "waits",
]
