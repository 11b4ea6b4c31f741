"""Work that repeats: rules on endless routes, recurrence, and timetables chosen to repeat well."""

from rightofway.laps.bottleneck import Bottleneck, Piece, bottleneck_of, in_words
from rightofway.laps.choosing import GroupTimetable
from rightofway.laps.conflicts import Conflict
from rightofway.laps.endless import Endless, endless_routes
from rightofway.laps.levers import Lever, levers_of
from rightofway.laps.outcome import GroupRun, LapsRun
from rightofway.laps.pattern import Pattern
from rightofway.laps.plan import plan_of
from rightofway.laps.rules import RULES
from rightofway.laps.run import ROUTES, run_laps
from rightofway.laps.shown import shown
from rightofway.laps.starting import run_of
from rightofway.laps.timetable import best_timetable

__all__ = [
    "ROUTES",
    "RULES",
    "Bottleneck",
    "Conflict",
    "Endless",
    "GroupRun",
    "GroupTimetable",
    "LapsRun",
    "Lever",
    "Pattern",
    "Piece",
    "best_timetable",
    "bottleneck_of",
    "endless_routes",
    "in_words",
    "levers_of",
    "plan_of",
    "run_laps",
    "run_of",
    "shown",
]
