"""The judge: says of any plan whether it keeps the rules and, where not, who, where and when.

It reads the scenario in ticks and the tracks, nothing else: no planner, no search, no native core.
"""

from rightofway.check.faults import Fault, FaultKind, Report
from rightofway.check.judge import check

__all__ = ["Fault", "FaultKind", "Report", "check"]
