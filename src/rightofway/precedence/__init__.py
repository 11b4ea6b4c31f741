"""Rights of way between visits, and the earliest timetable that keeps them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rightofway.provision import import_later

if TYPE_CHECKING:
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
        build_graph,
        build_graph_of_plan,
        build_timetable,
    )
    from rightofway.precedence.period_curve import Growth, PeriodPiece, compute_period_curve
    from rightofway.precedence.release_graph import Arrival, Part, ReleaseGraph, list_waits
    from rightofway.precedence.rotations import find_rotation
    from rightofway.precedence.segments import Segment, find_shared_segment, make_crossing
    from rightofway.precedence.sensitivity import (
        Sensitivity,
        compute_sensitivity,
        find_critical_circuit_without,
        find_tight_arcs,
    )
    from rightofway.precedence.timed_event_graph import (
        Arcs,
        Circuit,
        CyclicSchedule,
        TimedEventGraph,
        unroll_schedule,
    )

_MODULES = {
    "adg": (
        "ActionDependencyGraph",
        "DelayModel",
        "DelaySample",
        "Execution",
        "RunBatch",
        "Stoppage",
        "order_of",
    ),
    "graph": (
        "Meeting",
        "PrecedenceGraph",
        "build_graph",
        "build_graph_of_plan",
        "build_timetable",
    ),
    "period_curve": (
        "Growth",
        "PeriodPiece",
        "compute_period_curve",
    ),
    "rotations": ("find_rotation",),
    "release_graph": (
        "Arrival",
        "Part",
        "ReleaseGraph",
        "list_waits",
    ),
    "segments": (
        "Segment",
        "find_shared_segment",
        "make_crossing",
    ),
    "sensitivity": (
        "Sensitivity",
        "compute_sensitivity",
        "find_critical_circuit_without",
        "find_tight_arcs",
    ),
    "timed_event_graph": (
        "Arcs",
        "Circuit",
        "CyclicSchedule",
        "TimedEventGraph",
        "unroll_schedule",
    ),
}

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
    "build_graph",
    "build_graph_of_plan",
    "build_timetable",
    "compute_period_curve",
    "compute_sensitivity",
    "find_critical_circuit_without",
    "find_rotation",
    "find_shared_segment",
    "find_tight_arcs",
    "list_waits",
    "make_crossing",
    "order_of",
    "unroll_schedule",
]

if not TYPE_CHECKING:  # a checker would take any misspelt name for an object
    __getattr__ = import_later(__name__, _MODULES)
