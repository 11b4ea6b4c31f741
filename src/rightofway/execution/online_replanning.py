"""Planning anew what is left while robots are on the move.

What has begun is kept: who stays finishes what it does there, who drives arrives, and what is
booked stays booked. From there on everybody gets a new route, and a new order at every vertex. The
rest is a scenario of its own, in which each robot starts where it is, or arrives next, and is first
busy for as long as is expected. To go on by right of way is one plan of it; large neighbourhood
search starts from that one.

Notes
-----
Deterministic: a number of neighbourhoods ends the search, no clock.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.execution.commitment import Commitment, commitment_of
from rightofway.execution.forecast import Forecast
from rightofway.execution.splice import joined
from rightofway.model import Plan, PlannerRun, Robot, Scenario, Stop, Tick, Track, VertexId
from rightofway.planners.lacam import timetable_in_order
from rightofway.precedence import ActionDependencyGraph
from rightofway.solve import improve

__all__ = ["replan_online"]

PLANNER = "lns"

NEIGHBOURHOODS = 20
"""How many neighbourhoods are tried, per robot; five times as many win hardly more."""


def replan_online(outlook: Forecast, seed: int) -> ActionDependencyGraph | None:
    """Plan what is left anew.

    Parameters
    ----------
    outlook
        What is expected of going on by right of way.
    seed
        For the planner.

    Returns
    -------
    DelayedPlan or None
        What has begun and what is to come, told to everybody now. None where that would deadlock,
        which can only be where the planner sends a robot away that is still busy: it stays.
    """
    floor = outlook.floor
    begun = [commitment_of(outlook, robot) for robot in range(len(floor.routes))]
    going_on = Plan(
        scenario=(rest := _rest(floor.scenario, floor, begun)),
        tracks=tuple(_going_on(outlook, rest, begun)),
        run=PlannerRun(name="by right of way"),
    )
    options = {"iterations": NEIGHBOURHOODS * len(begun)}
    anew = joined(outlook, begun, improve(going_on, PLANNER, None, seed, options=options))
    return None if anew.deadlocked() else anew


def _rest(
    scenario: Scenario, floor: ActionDependencyGraph, begun: Sequence[Commitment]
) -> Scenario:
    """Return the problem of the rest; turning is part of the work, since it may have begun."""
    robots = [
        _going_one_way(robot, route.vertices[one.visit], one, scenario)
        for robot, route, one in zip(scenario.robots, floor.routes, begun, strict=True)
    ]
    return replace(scenario, robots=tuple(robots), clock=scenario.problem.clock)


def _going_one_way(robot: Robot, home: VertexId, begun: Commitment, scenario: Scenario) -> Robot:
    time = scenario.problem.clock.time
    stops = [Stop(at=home, work=time(begun.busy))]
    if begun.drives_to is not None:
        stops.append(Stop(at=begun.drives_to))
    for number, stage in enumerate(begun.left, 1):
        turn = stage.turn if number < len(begun.left) else 0
        stops.append(Stop(at=stage.vertex, work=time(Tick(stage.work + turn))))
    if not begun.left:
        stops.append(Stop(at=home))
    return replace(robot, home=home, stops=tuple(stops), turn=Fraction(0), ends="none", laps=1)


def _going_on(outlook: Forecast, rest: Scenario, begun: Sequence[Commitment]) -> list[Track]:
    """Return the plan of the rest in which everybody keeps its route and its right of way."""
    floor, times = outlook.floor, outlook.times()
    firsts = floor.first_visit.tolist()
    visited, arrivals = [], []
    for first, route, one in zip(firsts, floor.routes, begun, strict=False):
        visited.append(list(route.vertices[one.visit :]))
        arrivals.append(times[first + one.visit : first + len(route)].tolist())
    return timetable_in_order(rest, visited, arrivals)
