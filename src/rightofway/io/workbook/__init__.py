"""Scenarios in a workbook: a map to draw cell by cell, a table of robots, a list of rules."""

from rightofway.io.workbook.reader import load_workbook_scenario
from rightofway.io.workbook.writer import format_workbook, write_template

__all__ = ["format_workbook", "load_workbook_scenario", "write_template"]
