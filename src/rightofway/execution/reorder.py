"""Reordering during execution: switch rights of way to lower the expected flowtime.

Rights of way between visits that have not begun are switched, each for a whole segment, while a
switch lowers the expected flowtime. The precedence graph refuses switches that close a cycle.

References
----------
Berndt, van Duijkeren, Palmieri & Keviczky, *A feedback scheme to reorder a multi-agent execution
schedule by persistently optimizing a switchable action dependency graph*, 2020. The paper solves
an integer program over a receding horizon; this module descends over all remaining visits.
"""

from __future__ import annotations

import numpy as np

from rightofway.execution.forecast import Forecast
from rightofway.planners.local_search import LocalSearch
from rightofway.planners.task import Task
from rightofway.precedence import ActionDependencyGraph, order_of

__all__ = ["reordered"]


def reordered(forecast: Forecast) -> ActionDependencyGraph | None:
    """Switch unused rights of way while this lowers the expected flowtime.

    Parameters
    ----------
    forecast
        The forecast; its graph gets the new order, or is unchanged if the result is None.

    Returns
    -------
    ActionDependencyGraph or None
        The plan in the new order, valid from ``now`` on. None if no new order is better.
    """
    adg, booked = forecast.adg, forecast.booked
    mark = forecast.graph.checkpoint()
    search = LocalSearch(
        Task(scenario=adg.scenario), forecast.graph, lambda visit: not booked[visit]
    )
    search.descend()
    before = order_of(adg.vertex, forecast.times())
    # A visit that has begun must not wait for a visit that has not begun.
    waits_for = before[booked]
    is_allowed = booked[waits_for[waits_for >= 0]].all()
    if np.array_equal(before, adg.before) or not is_allowed:
        forecast.graph.rollback(mark)
        return None
    return adg.reordered(before, np.where(booked, adg.since, forecast.now))
