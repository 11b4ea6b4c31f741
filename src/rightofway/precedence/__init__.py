"""Rights of way between visits, and the earliest timetable that keeps them."""

from rightofway.precedence.delayed import (
    NEVER,
    DelayedPlan,
    Execution,
    Hazards,
    Runs,
    Setbacks,
    order_of,
)
from rightofway.precedence.graph import Meeting, PrecedenceGraph, graph_of
from rightofway.precedence.periodic import PeriodicTimetable
from rightofway.precedence.segments import Segment, crossing, shared_segment

__all__ = [
    "NEVER",
    "DelayedPlan",
    "Execution",
    "Hazards",
    "Meeting",
    "PeriodicTimetable",
    "PrecedenceGraph",
    "Runs",
    "Segment",
    "Setbacks",
    "crossing",
    "graph_of",
    "order_of",
    "shared_segment",
]
