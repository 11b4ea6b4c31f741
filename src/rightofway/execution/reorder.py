"""Switching rights of way while the plan runs, where that helps and nobody can deadlock.

Rights of way between visits that have not begun are flipped, each for a whole segment, as long as
that lowers the expected flowtime. The precedence graph refuses whatever would close a circle.

References
----------
Berndt, van Duijkeren, Palmieri & Keviczky, *A feedback scheme to reorder a multi-agent execution
schedule by persistently optimizing a switchable action dependency graph*, 2020. They solve each
look ahead as an integer program, over a horizon; here it is a descent over all that is left.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.forecast import Forecast
from rightofway.planners.local_search import LocalSearch
from rightofway.planners.task import Task
from rightofway.precedence import ActionDependencyGraph, order_of

__all__ = ["switched"]


def switched(outlook: Forecast) -> ActionDependencyGraph | None:
    """Flip rights of way that have not been used, as long as that lowers the expected flowtime.

    Returns
    -------
    DelayedPlan or None
        The plan in another order, told to everybody now; the graph of the outlook then has it too.
        None if no other one helps.
    """
    floor, task = outlook.floor, Task(scenario=outlook.floor.scenario)
    mark = outlook.graph.checkpoint()
    LocalSearch(task, outlook.graph, lambda visit: not outlook.begun[visit]).descend()
    before = order_of(floor.vertex, outlook.times())
    if np.array_equal(before, floor.before) or not _allows(outlook, before):
        outlook.graph.rollback(mark)
        return None
    return floor.reordered(before, np.where(outlook.begun, floor.since, outlook.now))


def _allows(outlook: Forecast, before: NDArray[np.int32]) -> bool:
    """Tell whether nobody who has begun would have to wait for somebody who has not."""
    waits_for = before[outlook.begun]
    return bool(outlook.begun[waits_for[waits_for >= 0]].all())
