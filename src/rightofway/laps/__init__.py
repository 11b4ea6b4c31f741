"""Work that repeats: rules on endless routes, and what comes again."""

from rightofway.laps.bottleneck import Bottleneck, Piece, bottleneck_of, in_words
from rightofway.laps.conflicts import Conflict
from rightofway.laps.endless import Endless, endless_routes
from rightofway.laps.levers import Lever, levers_of
from rightofway.laps.outcome import GroupRun, LapsRun
from rightofway.laps.pattern import Pattern
from rightofway.laps.plan import plan_of
from rightofway.laps.rules import RULES
from rightofway.laps.run import ROUTES, run_laps
from rightofway.laps.shown import shown

__all__ = [
    "ROUTES",
    "RULES",
    "Bottleneck",
    "Conflict",
    "Endless",
    "GroupRun",
    "LapsRun",
    "Lever",
    "Pattern",
    "Piece",
    "bottleneck_of",
    "endless_routes",
    "in_words",
    "levers_of",
    "plan_of",
    "run_laps",
    "shown",
]
