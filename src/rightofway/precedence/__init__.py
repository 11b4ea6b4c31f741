"""Rights of way between visits, and the earliest timetable that keeps them."""

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

__all__ = [
    "Arcs",
    "Circuit",
    "EventGraph",
    "Meeting",
    "PeriodicTimetable",
    "PrecedenceGraph",
    "Segment",
    "critical_circuit",
    "crossing",
    "event_graph",
    "graph_of",
    "shared_segment",
    "unrolled",
]
