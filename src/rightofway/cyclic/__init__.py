"""Repeated laps: simulated under a lap rule, or scheduled by a timetable chosen in advance."""

from rightofway.cyclic.bottleneck import (
    Bottleneck,
    Piece,
    bottleneck_of,
    list_pieces_of_plan,
    trace_bottleneck,
)
from rightofway.cyclic.parameter_curves import CurvePiece, ParameterCurve, parameter_curves
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import BaselineComparison, CyclicResult, GroupResult, LapWait
from rightofway.cyclic.route import ROUTES, CyclicRoute, GroupContext, cyclic_routes
from rightofway.cyclic.rules import RULES, TIMETABLE
from rightofway.cyclic.run import run_laps
from rightofway.cyclic.sensitivity import ParameterEffect, parameter_effects
from rightofway.cyclic.timetable_search import best_timetable
from rightofway.cyclic.to_plan import excerpt, list_visits_along, plan_of_laps

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
    "best_timetable",
    "bottleneck_of",
    "cyclic_routes",
    "excerpt",
    "list_pieces_of_plan",
    "list_visits_along",
    "parameter_curves",
    "parameter_effects",
    "plan_of_laps",
    "run_laps",
    "trace_bottleneck",
]
