"""The judge: says of any plan whether it keeps the rules and, where not, who, where and when.

It reads the scenario in ticks and the tracks, nothing else: no planner, no search, no native core.
"""

from rightofway.check.judge import check
from rightofway.check.report import Fault, FaultKind, Report

__all__ = ["Fault", "FaultKind", "Report", "check"]
