"""From jobs to a plan: who does which job, then routes; each learns from the other.

jobs → tours → routes → rights of way → timetable → plan → judge
  ↑                                                          │
  └──────── delays of the legs, jobs at other places ────────┘
"""

from __future__ import annotations

from rightofway.plan_work.cost import WorkCost, measure_work
from rightofway.plan_work.rounds import plan_work

__all__ = ["WorkCost", "measure_work", "plan_work"]
