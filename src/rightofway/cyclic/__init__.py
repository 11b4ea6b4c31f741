"""Work that repeats: rules on endless routes, and what comes again."""

from rightofway.cyclic.best import best_timetable
from rightofway.cyclic.bottleneck import Bottleneck, Piece, bottleneck_of, in_words
from rightofway.cyclic.pattern import Pattern
from rightofway.cyclic.result import CyclicResult, GroupRun
from rightofway.cyclic.route import CyclicRoute, cyclic_routes
from rightofway.cyclic.rules import RULES
from rightofway.cyclic.run import ROUTES, run_laps
from rightofway.cyclic.schedule_search import GroupTimetable
from rightofway.cyclic.sensitivity import ParameterEffect, parameter_effects
from rightofway.cyclic.shown import shown
from rightofway.cyclic.startup import run_of
from rightofway.cyclic.to_plan import plan_of
from rightofway.cyclic.waits import Conflict

__all__ = [
    "ROUTES",
    "RULES",
    "Bottleneck",
    "Conflict",
    "CyclicResult",
    "CyclicRoute",
    "GroupRun",
    "GroupTimetable",
    "ParameterEffect",
    "Pattern",
    "Piece",
    "best_timetable",
    "bottleneck_of",
    "cyclic_routes",
    "in_words",
    "parameter_effects",
    "plan_of",
    "run_laps",
    "run_of",
    "shown",
]
