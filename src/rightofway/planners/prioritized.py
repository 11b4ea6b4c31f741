"""One robot after another, each round those before it; who stands in the way is planned again.

References
----------
Erdmann & Lozano-Perez, *On multiple moving objects*, Algorithmica 1987.

Silver, *Cooperative pathfinding*, AIIDE 2005.

Andreychuk & Yakovlev, *Two techniques that enhance the performance of multi-robot prioritized path
planning*, AAMAS 2018.
"""

from __future__ import annotations

import random

import numpy as np

from rightofway.model import Scenario, Track
from rightofway.planners.joint import plan_jointly
from rightofway.planners.routing import refuse_shared_ends, refuse_unreachable
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.search import Distances, FleetSearch

__all__ = ["ORDERS", "first_plan", "fleet_search", "prioritized"]

SHARE = 0.4
"""The part of the time that planning in turn gets; the rest is for planning all together."""

SEARCHES_PER_ROBOT = 20
"""How often robots may be planned, per robot of the fleet."""

ORDERS = ("shortest", "longest", "slowest", "file", "random")
"""Who is planned first: by the least completion alone, by speed, as in the file, or as drawn."""


def prioritized(task: Task) -> Draft:
    """Plan one robot after another.

    Parameters
    ----------
    task
        Options: ``order`` is one of `ORDERS`.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.
    """
    tracks, status = first_plan(task, fleet_search(task), task.options["order"])
    return Draft(tracks=tracks, status=status)


def fleet_search(task: Task) -> FleetSearch:
    """Return the search for a fleet whose robots can all do their trips alone.

    Raises
    ------
    NoPlanExists
        If a robot cannot get to a place, or two would have to stay at one for ever.
    """
    scenario = task.scenario
    refuse_shared_ends(scenario)
    search = FleetSearch(scenario, headway=planning_headway(scenario), seed=task.seed)
    for robot in np.flatnonzero(search.alone() < 0).tolist():
        name, itinerary = scenario.robots[robot].name, scenario.timing.itineraries[robot]
        refuse_unreachable(name, itinerary, Distances(scenario.roadmap))
    return search


def first_plan(task: Task, search: FleetSearch, order: str) -> tuple[tuple[Track, ...], str]:
    """Plan robots in turn, or all together where that does not work out; say which.

    Raises
    ------
    NoPlanExists
        If it is proven that there is no plan.
    GaveUp
        If time ran out.
    """
    n_robots = len(task.scenario.robots)
    is_planned = search.prioritize(
        _in_order(task.scenario, search, order, task.seed),
        searches=SEARCHES_PER_ROBOT * n_robots,
        time_limit=task.deadline.sooner(SHARE).seconds_left(),
    )
    if is_planned:
        return search.tracks(), "one after another"
    task.deadline.check("planning robots one after another")
    return (
        tuple(plan_jointly(task, Distances(task.scenario.roadmap))),
        "all together, because robots one after another found no way",
    )


def _in_order(scenario: Scenario, search: FleetSearch, order: str, seed: int) -> list[int]:
    robots = list(range(len(scenario.robots)))
    if order == "random":
        random.Random(seed).shuffle(robots)  # noqa: S311 (no secret depends on it)
    elif order == "slowest":
        robots.sort(key=lambda robot: scenario.robots[robot].speed)
    elif order != "file":
        alone = search.alone()
        robots.sort(key=lambda robot: alone[robot], reverse=order == "longest")
    return robots
