"""Suites of cases, each run in a process of its own; their results, and reports on them.

Time and memory of a case are measured in its own process, here or on a cluster. Only reports need
matplotlib, only clusters distributed; they are imported there.
"""

from rightofway.bench.cluster import run_on_cluster
from rightofway.bench.fleet_sizes import FleetSize, FleetSizes, compare_fleet_sizes
from rightofway.bench.process import describe_machine, run_here
from rightofway.bench.report import write_report
from rightofway.bench.results import COLUMNS, Results, Row
from rightofway.bench.shifts import SHIFT
from rightofway.bench.suite import Case, read_suite
from rightofway.bench.summary import Group, Quartiles, group_by_planner

__all__ = [
    "COLUMNS",
    "SHIFT",
    "Case",
    "FleetSize",
    "FleetSizes",
    "Group",
    "Quartiles",
    "Results",
    "Row",
    "compare_fleet_sizes",
    "describe_machine",
    "group_by_planner",
    "read_suite",
    "run_here",
    "run_on_cluster",
    "write_report",
]
