"""Switching rights of way during execution, where that helps and no robots can deadlock.

Rights of way between visits that have not begun are flipped, each for a whole segment, as long as
that lowers the expected flowtime. The precedence graph refuses every flip that closes a cycle.

References
----------
Berndt, van Duijkeren, Palmieri & Keviczky, *A feedback scheme to reorder a multi-agent execution
schedule by persistently optimizing a switchable action dependency graph*, 2020. They solve an
integer program over a horizon at each look ahead; this is a descent over the whole rest.
"""

from __future__ import annotations

import numpy as np

from rightofway.execution.forecast import Forecast
from rightofway.planners.local_search import LocalSearch
from rightofway.planners.task import Task
from rightofway.precedence import ActionDependencyGraph, order_of

__all__ = ["reordered"]


def reordered(forecast: Forecast) -> ActionDependencyGraph | None:
    """Flip rights of way that have not been used, as long as that lowers the expected flowtime.

    Parameters
    ----------
    forecast
        The expectation; its graph gets the new order, or stays if there is none.

    Returns
    -------
    ActionDependencyGraph or None
        The plan in the new order, valid from now on. None if no other order helps.
    """
    adg, booked = forecast.adg, forecast.booked
    mark = forecast.graph.checkpoint()
    search = LocalSearch(
        Task(scenario=adg.scenario), forecast.graph, lambda visit: not booked[visit]
    )
    search.descend()
    before = order_of(adg.vertex, forecast.times())
    # A visit that has begun must not wait for one that has not.
    waits_for = before[booked]
    is_allowed = booked[waits_for[waits_for >= 0]].all()
    if np.array_equal(before, adg.before) or not is_allowed:
        forecast.graph.rollback(mark)
        return None
    return adg.reordered(before, np.where(booked, adg.since, forecast.now))
