"""A plan for the whole fleet at once: an order of moves first, then the times that follow from it.

A search without clocks brings all robots through their trips in some order of moves. That order
says where each robot goes and who visits a vertex before whom; these are routes and rights of way,
and the earliest timetable that keeps them is a plan, for any speeds, work times and headways.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Route, Scenario, Track, VertexId, route_through
from rightofway.planners.task import Task, planning_headway
from rightofway.precedence import PrecedenceGraph
from rightofway.search import Distances, joint_steps

__all__ = ["plan_jointly", "timetable_in_order"]


def plan_jointly(task: Task, distances: Distances) -> list[Track]:
    """Plan all robots together.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.
    """
    left = task.deadline.seconds_left()
    steps = joint_steps(task.scenario, distances, seed=task.seed, time_limit=left)
    return timetable_of(task.scenario, steps)


def timetable_of(scenario: Scenario, steps: NDArray[np.int32]) -> list[Track]:
    """Return the earliest tracks along the routes of some steps that keep their order.

    Parameters
    ----------
    scenario
        The problem.
    steps
        The vertex of every robot after each step, shape (T, R), as from `joint_steps`.
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
    return route_through(scenario.roadmap, scenario.timing.itineraries[robot], vertices)
