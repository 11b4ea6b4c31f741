"""One right of way of a plan, flipped: the other robot goes first, and all else follows.

The routes stay where that is possible; the timetable follows without any search. Else both robots
are planned again around all others, the one that waited before the other one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from rightofway.check import check
from rightofway.deadline import Deadline
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.model import Plan, Tick, Track, compute_completions
from rightofway.precedence import PrecedenceGraph, build_graph_of_plan
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.plan_request import PlanRequest

SEARCHES = 100
"""Searches for both robots and those that are in their way."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flipped:
    """The result of a flipped right of way.

    Attributes
    ----------
    tracks
        One for each robot.
    keeps_routes
        Whether all robots drive on their routes, only at other times.
    """

    tracks: tuple[Track, ...]
    keeps_routes: bool


def flip_right_of_way(
    plan: Plan, waits: int, goes_first: int, tick: Tick, *, time_limit: float | None = None
) -> Flipped:
    """Return the timetable of a plan in which a robot that waits goes first instead.

    Returns
    -------
    Flipped
        The earliest timetable on the same routes, with conflicts that follow from the flip resolved
        one after the other by their costs. Where that is impossible, both robots planned again
        around the others, if the robot that waited completes sooner than in the plan.

    Raises
    ------
    InputError
        For a plan with jobs: the timetable does not know their times.
    GaveUp
        If the plan has faults, no right of way of the two is there, or neither was found.
    """
    scenario = plan.scenario
    if scenario.problem.has_times:
        remedy = "plan again, or improve the plan"
        raise InputError.at("", f"rights of way of a plan with jobs are not reversed ({remedy})")
    judged = check(plan)
    if not judged.ok:
        raise GaveUp(Fact("plan with faults", faults=judged.total))
    request = PlanRequest(scenario=scenario, deadline=Deadline.after(time_limit))
    graph = build_graph_of_plan(scenario.problem, plan.tracks)
    rights = [
        (first, second)
        for first, second in graph.list_rights_of(waits)
        if graph.place(second)[0] == waits and graph.place(first)[0] == goes_first
    ]
    if not rights:
        raise GaveUp(Fact("never waits for", scenario, waits=waits, goes_first=goes_first))
    first, second = min(rights, key=lambda right: (abs(graph.enter(right[1]) - tick), right))
    search = LocalSearch(request, graph)
    if search.reverse(first, second) and search.resolve():
        return Flipped(tracks=tuple(graph.build_tracks()), keeps_routes=True)
    tracks = _plan_on_other_routes(request, plan, waits, goes_first)
    if tracks is None:
        why = _explain_order(graph, first, second)
        fact = Fact("cannot go before", scenario, waits=waits, goes_first=goes_first, why=why)
        raise GaveUp(fact)
    return Flipped(tracks=tracks, keeps_routes=False)


def _explain_order(graph: PrecedenceGraph, first: int, second: int) -> Fact:
    """Return why a visit cannot come before another one."""
    (other, index), (robot, end) = graph.place(first), graph.place(second)
    if index == 0:
        return Fact("starts in its way", robot=other)
    if end == len(graph.routes[robot]) - 1:
        return Fact("ends in the way", robot=robot, other=other)
    return Fact("would block each other")


def _plan_on_other_routes(
    request: PlanRequest, plan: Plan, waits: int, goes_first: int
) -> tuple[Track, ...] | None:
    """Return a plan in which one robot is planned before another; None if it is not home sooner."""
    search = make_fleet_search(request)
    old_tracks = [
        None if robot in {waits, goes_first} else track for robot, track in enumerate(plan.tracks)
    ]
    search.start(old_tracks)
    limit = request.deadline.measure_seconds_left()
    if not search.repair([waits, goes_first], searches=SEARCHES, time_limit=limit):
        return None
    tracks = search.list_tracks()
    before, after = (
        compute_completions(plan.scenario, fleet)[waits] for fleet in (plan.tracks, tracks)
    )
    is_good = after < before and check(replace(plan, tracks=tracks)).ok
    return tracks if is_good else None
