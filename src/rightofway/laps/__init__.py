"""Work that repeats: rules on endless routes, recurrence, and timetables chosen to repeat well."""

from rightofway.laps.conflicts import Conflict
from rightofway.laps.endless import Endless, endless_routes
from rightofway.laps.outcome import GroupRun, LapsRun
from rightofway.laps.pattern import Pattern
from rightofway.laps.plan import plan_of
from rightofway.laps.rules import RULES
from rightofway.laps.run import ROUTES, run_laps
from rightofway.laps.shown import shown

__all__ = [
    "ROUTES",
    "RULES",
    "Conflict",
    "Endless",
    "GroupRun",
    "LapsRun",
    "Pattern",
    "endless_routes",
    "plan_of",
    "run_laps",
    "shown",
]
