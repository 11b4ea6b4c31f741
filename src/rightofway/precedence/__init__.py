"""Rights of way between visits, and the earliest timetable that keeps them."""

from rightofway.precedence.graph import Meeting, PrecedenceGraph, graph_of
from rightofway.precedence.segments import Segment, head_on_segment

__all__ = ["Meeting", "PrecedenceGraph", "Segment", "graph_of", "head_on_segment"]
