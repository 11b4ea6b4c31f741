"""The rules of right of way for repeated laps: the one list that all others read."""

from __future__ import annotations

RULES = {
    "first-come": "the robot that would enter the shared segment first",
    "fixed-order": "the robot that the scenario lists first",
    "least-loss": "the robot that would lose the larger part of its lap by waiting",
    "two-level": "the robot that the paper's two-level method lets go first",
}
"""For each rule of `run_laps`, which of two robots that meet goes first."""

NATIVE_RULES = ("first-come", "fixed-order", "least-loss")
"""Rules that consider two robots only, in the order of the native simulator."""

TIMETABLE = "timetable"
"""The rule of a result of `best_timetable`: every right of way is chosen in advance."""
