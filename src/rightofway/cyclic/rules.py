"""The lap rules: the single list for library, command line and documentation."""

from __future__ import annotations

RULES = {
    "first-come": "the robot that would enter the shared segment first",
    "fixed-order": "the robot that the scenario lists first",
    "least-loss": "the robot that would lose the larger part of its lap by waiting",
    "two-level": "the robot that the paper's two-level method lets go first",
}
"""For each rule of `run_laps`, the robot of two that goes first at a meeting."""

NATIVE_RULES = ("first-come", "fixed-order", "least-loss")
"""Rules that consider two robots only, in the order of the native simulator's enum."""

TIMETABLE = "timetable"
"""The rule in results of `find_best_timetable`: all rights of way are chosen in advance."""
