"""Rights of way between visits, and the earliest timetable that keeps them."""

from rightofway.precedence.graph import Meeting, PrecedenceGraph, graph_of
from rightofway.precedence.periodic import PeriodicTimetable
from rightofway.precedence.segments import Segment, crossing, shared_segment

__all__ = [
    "Meeting",
    "PeriodicTimetable",
    "PrecedenceGraph",
    "Segment",
    "crossing",
    "graph_of",
    "shared_segment",
]
