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
from rightofway.precedence.endless import EndlessRun, Look, Standstill
from rightofway.precedence.event_graph import (
    Arcs,
    Circuit,
    EventGraph,
    critical_circuit,
    event_graph,
)
from rightofway.precedence.graph import Meeting, PrecedenceGraph, graph_of
from rightofway.precedence.periodic import PeriodicTimetable, unrolled
from rightofway.precedence.segments import Segment, crossing, shared_segment
from rightofway.precedence.sensitivity import (
    Sensitivity,
    cycle_time_without,
    sensitivity,
    tight_arcs,
)

__all__ = [
    "NEVER",
    "Arcs",
    "Circuit",
    "DelayedPlan",
    "EndlessRun",
    "EventGraph",
    "Execution",
    "Hazards",
    "Look",
    "Meeting",
    "PeriodicTimetable",
    "PrecedenceGraph",
    "Runs",
    "Segment",
    "Sensitivity",
    "Setbacks",
    "Standstill",
    "critical_circuit",
    "crossing",
    "cycle_time_without",
    "event_graph",
    "graph_of",
    "order_of",
    "sensitivity",
    "shared_segment",
    "tight_arcs",
    "unrolled",
]
