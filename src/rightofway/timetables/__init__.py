"""Timetables that repeat, chosen well: laps per period, ways and rights of way on a circle."""

from rightofway.timetables.fleet import best_timetable
from rightofway.timetables.group import GroupTimetable
from rightofway.timetables.starting import run_of

__all__ = ["GroupTimetable", "best_timetable", "run_of"]
