"""LaCAM: the whole fleet at once, a search over where all robots are.

The timed search goes from instant to instant with each robot's own speed and work. Where it ends
without a plan, the untimed search brings all robots through their trips in some order of moves.
That order gives each robot a route, and each vertex an order of visits: rights of way, whose
earliest timetable is a plan for any speeds, work times and headways.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
Okumura, Machida, Défago & Tamura, *Priority inheritance with backtracking for iterative multi-agent
path finding*, Artificial Intelligence 310, 2022.

Notes
-----
Complete: the untimed search finds an order of moves or proves that none exists. Deterministic, as
long as nine tenths of the time limit are enough for the timed search. Not optimal.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Scenario, Track, route_through
from rightofway.planners.impossible import (
    blocking_set,
    refuse_blocked_parts,
    refuse_stranded,
    refuse_the_impossible,
)
from rightofway.planners.moves import plan_by_moves
from rightofway.planners.task import Draft, Task, planning_headway, planning_problem
from rightofway.precedence import graph_on
from rightofway.search import Distances, FleetSearch, plan_by_lacam, untimed_lacam
from rightofway.site import VertexId

SHARE_OF_TIME = 0.9
"""The part of the time for the timed search."""

MANY = 5000
"""The untimed search takes far longer than the timed one for more robots: it gets no time."""

LEAST_EFFORT, EFFORT_PER_PLACE = 2_000_000, 8
"""Choices of the timed search: the minimum, and the limit per robot and vertex above it."""


def lacam(task: Task) -> Draft:
    """Plan the whole fleet at once; options: `LacamOptions`."""
    return plan_fleet(task, spreads=task.options["paths"] == "spread")


def plan_fleet(task: Task, *, spreads: bool = True) -> Draft:
    """Plan the whole fleet at once; ``spreads``: robots prefer paths that were spread before."""
    scenario, robots = task.scenario, len(task.scenario.robots)
    if scenario.problem.is_open:
        found = plan_by_instants(task, spreads=spreads)
        if found is not None:
            return found
    if scenario.problem.resources is not None:
        task.report("no end by instants: planning the order of single moves")
        search = FleetSearch(planning_problem(scenario), seed=task.seed, alone=task.alone)
        return plan_by_moves(task, search)
    if not scenario.problem.is_open:
        _refuse_or_give_up(task)
    task.report("no end by instants: planning the order of moves without clocks")
    refuse_blocked_parts(scenario, seed=task.seed, deadline=task.deadline)
    left = task.deadline.seconds_left()
    try:
        steps = untimed_lacam(scenario.problem, seed=task.seed, time_limit=left)
    except NoPlanExists:
        task.report("no plan exists: looking for the robots that block each other")
        found_set = blocking_set(scenario, range(robots), seed=task.seed, deadline=task.deadline)
        raise NoPlanExists([found_set]) from None
    task.has_plan()
    return Draft(tracks=tuple(timetable_of(scenario, steps)), status="order of moves first")


def _refuse_or_give_up(task: Task) -> NoReturn:
    """Raise for points among closures and barred edges that find no plan one after another.

    Raises
    ------
    NoPlanExists
        If no order of moves exists: closures and barred edges leave no more moves.
    GaveUp
        Otherwise.
    """
    left = task.deadline.seconds_left()
    try:
        untimed_lacam(task.scenario.problem, seed=task.seed, time_limit=left)
    except NoPlanExists:
        everybody = range(len(task.scenario.robots))
        found = blocking_set(task.scenario, everybody, seed=task.seed, deadline=task.deadline)
        raise NoPlanExists([found]) from None
    message = "robots one after another find no plan that keeps clear of closures and barred edges"
    raise GaveUp(f"{message} (give a longer time limit, or other places)")


def plan_by_instants(
    task: Task, *, spreads: bool = True, effort: int | None = None
) -> Draft | None:
    """Plan the whole fleet by the timed search alone; None if it ends without a plan.

    Parameters
    ----------
    task
        The problem.
    spreads
        Whether robots prefer paths that were spread before.
    effort
        Choices of robots at most, where they are to be fewer than usual.
    """
    scenario, robots, share = task.scenario, len(task.scenario.robots), SHARE_OF_TIME
    most_effort = max(LEAST_EFFORT, EFFORT_PER_PLACE * robots * scenario.roadmap.n_vertices)
    refuse_stranded(scenario, ())
    try:
        tracks = plan_by_lacam(
            planning_problem(scenario),
            seed=task.seed,
            most_effort=most_effort if effort is None else min(effort, most_effort),
            time_limit=task.deadline.sooner(share if robots <= MANY else 1).seconds_left(),
            spreads=spreads,
        )
    except NoPlanExists:
        refuse_the_impossible(scenario, Distances(scenario.roadmap))
        raise
    if tracks is None:
        return None
    task.has_plan()
    return Draft(tracks=tuple(tracks), status="instant by instant")


def timetable_of(scenario: Scenario, steps: NDArray[np.int32]) -> list[Track]:
    """Return the earliest tracks that keep the routes and the order of steps of `untimed_lacam`."""
    return timetable_in_order(scenario, *order_of_steps(steps))


def order_of_steps(steps: NDArray[np.int32]) -> tuple[list[list[VertexId]], list[list[int]]]:
    """Return the vertices that each robot visits, and the step in which each visit begins."""
    arrivals = [[0, *(np.flatnonzero(np.diff(places)) + 1).tolist()] for places in steps.T]
    return [steps[when, robot].tolist() for robot, when in enumerate(arrivals)], arrivals


def timetable_in_order(
    scenario: Scenario, visited: Sequence[list[VertexId]], arrivals: Sequence[list[int]]
) -> list[Track]:
    """Return the earliest tracks along some routes that keep an order of arrivals.

    Parameters
    ----------
    scenario
        The problem.
    visited
        The vertices that each robot visits, in order.
    arrivals
        When each visit begins, by any clock; of two visits at one vertex the earlier stays first.
        No visit begins when another one at that vertex ends, unless bookings allow a rotation.
    """
    routes = [
        route_through(scenario.roadmap, itinerary, vertices)
        for itinerary, vertices in zip(scenario.problem.itineraries, visited, strict=True)
    ]
    graph = graph_on(scenario, routes, headway=planning_headway(scenario))
    graph.keep_order(arrivals)
    return graph.tracks()
