"""Repeated laps: simulated under a lap rule, or scheduled by a timetable chosen in advance."""

from rightofway.cyclic.bottleneck import (
    Bottleneck,
    Piece,
    find_bottleneck,
    list_pieces_of_plan,
    trace_bottleneck,
)
from rightofway.cyclic.parameter_curves import CurvePiece, ParameterCurve, compute_parameter_curves
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import BaselineComparison, CyclicResult, GroupResult, LapWait
from rightofway.cyclic.route import ROUTES, CyclicRoute, GroupContext, make_cyclic_routes
from rightofway.cyclic.rules import RULES, TIMETABLE
from rightofway.cyclic.run import run_laps
from rightofway.cyclic.sensitivity import ParameterEffect, compute_parameter_effects
from rightofway.cyclic.timetable_search import find_best_timetable
from rightofway.cyclic.to_plan import list_visits_along, make_excerpt, plan_of_laps

__all__ = [
    "ROUTES",
    "RULES",
    "TIMETABLE",
    "BaselineComparison",
    "Bottleneck",
    "CurvePiece",
    "CyclicResult",
    "CyclicRoute",
    "GroupContext",
    "GroupResult",
    "LapWait",
    "ParameterCurve",
    "ParameterEffect",
    "Pattern",
    "Piece",
    "compute_parameter_curves",
    "compute_parameter_effects",
    "find_best_timetable",
    "find_bottleneck",
    "list_pieces_of_plan",
    "list_visits_along",
    "make_cyclic_routes",
    "make_excerpt",
    "plan_of_laps",
    "run_laps",
    "trace_bottleneck",
]
