"""Rights of way between visits, and the earliest timetable that keeps them."""

from rightofway.precedence.adg import (
    ActionDependencyGraph,
    DelayModel,
    DelaySample,
    Execution,
    RunBatch,
    Stoppage,
    order_of,
)
from rightofway.precedence.graph import (
    Meeting,
    PrecedenceGraph,
    graph_of,
    graph_on,
)
from rightofway.precedence.period_curve import Growth, PeriodPiece, period_curve
from rightofway.precedence.release_graph import Arrival, Part, ReleaseGraph
from rightofway.precedence.segments import Segment, crossing, find_shared_segment
from rightofway.precedence.sensitivity import (
    Sensitivity,
    find_critical_circuit_without,
    find_tight_arcs,
    sensitivity,
)
from rightofway.precedence.timed_event_graph import (
    Arcs,
    Circuit,
    CyclicSchedule,
    TimedEventGraph,
    unrolled,
)

__all__ = [
    "ActionDependencyGraph",
    "Arcs",
    "Arrival",
    "Circuit",
    "CyclicSchedule",
    "DelayModel",
    "DelaySample",
    "Execution",
    "Growth",
    "Meeting",
    "Part",
    "PeriodPiece",
    "PrecedenceGraph",
    "ReleaseGraph",
    "RunBatch",
    "Segment",
    "Sensitivity",
    "Stoppage",
    "TimedEventGraph",
    "crossing",
    "find_critical_circuit_without",
    "find_shared_segment",
    "find_tight_arcs",
    "graph_of",
    "graph_on",
    "order_of",
    "period_curve",
    "sensitivity",
    "unrolled",
]
