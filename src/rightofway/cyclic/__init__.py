"""Repeated laps: simulated under a lap rule, or scheduled by a timetable chosen in advance."""

from rightofway.cyclic.bottleneck import (
    Bottleneck,
    Piece,
    bottleneck_along,
    bottleneck_of,
    pieces_of_plan,
)
from rightofway.cyclic.parameter_curves import CurvePiece, ParameterCurve, parameter_curves
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import BaselineComparison, CyclicResult, GroupResult, LapWait
from rightofway.cyclic.route import ROUTES, CyclicRoute, GroupContext, cyclic_routes
from rightofway.cyclic.rules import RULES, TIMETABLE
from rightofway.cyclic.run import run_laps
from rightofway.cyclic.sensitivity import ParameterEffect, parameter_effects
from rightofway.cyclic.timetable_search import best_timetable
from rightofway.cyclic.to_plan import excerpt, plan_of_laps, visits_along

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
    "bottleneck_along",
    "bottleneck_of",
    "cyclic_routes",
    "excerpt",
    "parameter_curves",
    "parameter_effects",
    "pieces_of_plan",
    "plan_of_laps",
    "run_laps",
    "visits_along",
]
