"""A plan for the whole fleet at once: an order of moves first, then the times that follow from it.

A search without clocks brings all robots through their trips in some order of moves. That order
says where each robot goes and who visits a vertex before whom; these are routes and rights of way,
and the earliest timetable that keeps them is a plan, for any speeds, work times and headways.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import NoPlanExists
from rightofway.model import Route, Scenario, Track, VertexId, route_through
from rightofway.planners.routing import refuse_shared_ends, refuse_the_impossible
from rightofway.planners.task import Task, planning_headway
from rightofway.precedence import PrecedenceGraph
from rightofway.search import Distances, plan_by_lacam, untimed_lacam

__all__ = ["plan_jointly", "timetable_in_order"]

SHARE_OF_TIME = 0.9
"""How much of its time the search with clocks may take, if it does not give up before."""

MANY = 5000
"""For more robots the search without clocks would take far longer, so nothing is left for it."""

LEAST_EFFORT = 2_000_000
EFFORT_PER_PLACE = 8
"""How patient the search with clocks is: choices per robot and vertex, but at least so many."""


def plan_jointly(task: Task, *, spreads: bool = True) -> tuple[list[Track], str]:
    """Plan all robots together: with clocks, and where that comes to no end, an order of moves.

    Parameters
    ----------
    task
        The problem.
    spreads
        Whether robots prefer paths that were spread before the search.

    Returns
    -------
    tracks, status
        One track for each robot, and how they were found.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.

    Notes
    -----
    Complete: the search without clocks finds an order of moves or proves that there is none.
    Deterministic, as long as nine tenths of the time limit are enough for the search with clocks.
    """
    tracks = _by_events(task, spreads=spreads)
    if tracks is not None:
        task.has_plan()
        return tracks, "instant by instant"
    task.report("no end by instants: planning the order of moves without clocks")
    left = task.deadline.seconds_left()
    steps = untimed_lacam(task.scenario, seed=task.seed, time_limit=left)
    tracks = timetable_of(task.scenario, steps)
    task.has_plan()
    return tracks, "order of moves first"


def _by_events(task: Task, *, spreads: bool) -> list[Track] | None:
    refuse_shared_ends(task.scenario)
    try:
        return plan_by_lacam(
            task.scenario,
            headway=planning_headway(task.scenario),
            seed=task.seed,
            most_effort=_patience(task.scenario),
            time_limit=_limit(task),
            spreads=spreads,
        )
    except NoPlanExists:
        refuse_the_impossible(task.scenario, Distances(task.scenario.roadmap))
        raise


def _limit(task: Task) -> float | None:
    share = SHARE_OF_TIME if len(task.scenario.robots) <= MANY else 1
    return task.deadline.sooner(share).seconds_left()


def _patience(scenario: Scenario) -> int:
    places = len(scenario.robots) * scenario.roadmap.n_vertices
    return max(LEAST_EFFORT, EFFORT_PER_PLACE * places)


def timetable_of(scenario: Scenario, steps: NDArray[np.int32]) -> list[Track]:
    """Return the earliest tracks along the routes of some steps that keep their order.

    Parameters
    ----------
    scenario
        The problem.
    steps
        The vertex of every robot after each step, shape (T, R), as from `untimed_lacam`.
    """
    arrivals = [_arrivals(steps[:, robot]) for robot in range(steps.shape[1])]
    visited = [steps[arrival, robot].tolist() for robot, arrival in enumerate(arrivals)]
    return timetable_in_order(scenario, visited, arrivals)


def timetable_in_order(
    scenario: Scenario, visited: Sequence[list[VertexId]], arrivals: Sequence[list[int]]
) -> list[Track]:
    """Return the earliest tracks along some routes that keep an order of arrivals.

    Parameters
    ----------
    scenario
        The problem.
    visited
        Where each robot goes, visit by visit.
    arrivals
        When it comes there by any clock; of two visits at one vertex the earlier stays first. No
        visit begins when another one at that vertex ends, unless bookings allow a rotation.
    """
    graph = PrecedenceGraph(
        [_route(scenario, robot, vertices) for robot, vertices in enumerate(visited)],
        headway=planning_headway(scenario),
        books_ahead=scenario.rules.books_ahead,
    )
    graph.keep_order(arrivals)
    return graph.tracks()


def _arrivals(places: NDArray[np.int32]) -> list[int]:
    """Return the steps at which a robot enters a vertex, the start included."""
    return [0, *(np.flatnonzero(np.diff(places)) + 1).tolist()]


def _route(scenario: Scenario, robot: int, vertices: list[VertexId]) -> Route:
    return route_through(scenario.roadmap, scenario.problem.itineraries[robot], vertices)
