"""Repeated laps: simulated under a lap rule, or scheduled by a timetable chosen in advance."""

from rightofway.cyclic.bottleneck import Bottleneck, Piece, bottleneck_of, in_words
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import Comparison, CyclicResult, GroupResult, LapWait
from rightofway.cyclic.route import ROUTES, CyclicRoute, GroupContext, cyclic_routes
from rightofway.cyclic.rules import RULES, TIMETABLE
from rightofway.cyclic.run import run_laps
from rightofway.cyclic.sensitivity import ParameterEffect, parameter_effects
from rightofway.cyclic.timetable_search import best_timetable
from rightofway.cyclic.to_plan import excerpt, plan_of

__all__ = [
    "ROUTES",
    "RULES",
    "TIMETABLE",
    "Bottleneck",
    "Comparison",
    "CyclicResult",
    "CyclicRoute",
    "GroupContext",
    "GroupResult",
    "LapWait",
    "ParameterEffect",
    "Pattern",
    "Piece",
    "best_timetable",
    "bottleneck_of",
    "cyclic_routes",
    "excerpt",
    "in_words",
    "parameter_effects",
    "plan_of",
    "run_laps",
]
