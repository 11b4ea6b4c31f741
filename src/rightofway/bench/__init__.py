"""Suites of cases, each planned in a process of its own; their results, and reports on them.

What a case costs is measured in its own process, here or on a cluster; matplotlib, pyarrow and
distributed are needed for reports, Parquet files and clusters only, and imported there.
"""

from rightofway.bench.cases import Case, cases_of
from rightofway.bench.cluster import run_on_cluster
from rightofway.bench.extras import need
from rightofway.bench.groups import Group, Quantiles, by_planner
from rightofway.bench.local import run_here
from rightofway.bench.machine import machine
from rightofway.bench.report import write_report
from rightofway.bench.rows import COLUMNS, Column, Results, Row
from rightofway.bench.suite import Suite, read_suite

__all__ = [
    "COLUMNS",
    "Case",
    "Column",
    "Group",
    "Quantiles",
    "Results",
    "Row",
    "Suite",
    "by_planner",
    "cases_of",
    "machine",
    "need",
    "read_suite",
    "run_here",
    "run_on_cluster",
    "write_report",
]
