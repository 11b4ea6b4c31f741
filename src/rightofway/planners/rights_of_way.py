"""Plans by rights of way on fixed routes, decided by a rule.

Where no waiting keeps two robots apart, one of them is deferred: it is rerouted when all others
have their times. Where that fails, or takes more than its share of the time, the whole fleet is
planned by `lacam`, or by `prioritized` where robots have a size. So a planner made of this is
complete whatever its rule: given time it finds a plan or proves that none exists.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.model import Reroute, Route, Status
from rightofway.model.kept_facts import RerouteReason
from rightofway.planners.lacam import plan_fleet
from rightofway.planners.prioritized import plan_in_turn
from rightofway.precedence import build_graph_of_plan
from rightofway.repair.conflict_resolution import PartialPlan, Rule
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.repair.rerouting import reroute
from rightofway.search import Distances

SHARE = 0.8
"""The part of the time for rights of way; the rest is for planning the whole fleet."""


def plan_by_rule(
    request: PlanRequest, distances: Distances, routes: Sequence[Route], rule: Rule
) -> Draft:
    """Plan a fleet by rights of way, and where time is short for that by `lacam`."""
    try:
        hurried = replace(request, deadline=request.deadline.shorten(SHARE))
        return plan_on_routes(hurried, distances, PartialPlan(hurried, routes), rule)
    except GaveUp:
        because = RerouteReason("short time")
        return _plan_together(request, because)


def plan_on_routes(
    request: PlanRequest, distances: Distances, plan: PartialPlan, rule: Rule
) -> Draft:
    """Resolve all conflicts, then reroute the robots that were deferred."""
    plan.resolve_all(rule)
    tracks = {r: t for r, t in enumerate(plan.graph.build_tracks()) if r not in plan.deferred}
    made_way = reroute(request, distances, tracks, list(plan.deferred))
    if made_way is None:
        because = RerouteReason("no way in turn")
        return _plan_together(request, because)
    ordered = [track for _, track in sorted(tracks.items())]
    status, names = Status("waits only"), [robot.name for robot in request.scenario.robots]
    if made_way:  # shift the visits of robots that waited for a robot on its former route
        ordered = build_graph_of_plan(request.scenario.problem, ordered).build_tracks()
    rerouted = [
        robot
        for robot in sorted(made_way)
        if tuple(ordered[robot].vertices.tolist()) != plan.routes[robot].vertices
    ]
    if rerouted:
        status = Status("re-routed", robots=[names[robot] for robot in rerouted])
    return Draft(
        tracks=tuple(ordered),
        status=status,
        decisions=tuple(
            decision for decision in plan.decisions if not made_way.keys() & set(decision.robots)
        ),
        reroutes=tuple(
            Reroute(robot=robot, because=plan.deferred.get(robot) or _for(names, made_way[robot]))
            for robot in rerouted
        ),
        keeps_swaps=not plan.sees_swaps,
    )


def _for(names: Sequence[str], robot: int | None) -> RerouteReason:
    if robot is None:
        return RerouteReason("makes way")
    return RerouteReason("makes way for", robot=names[robot])


def _plan_together(request: PlanRequest, because: RerouteReason) -> Draft:
    robots, problem = range(len(request.scenario.robots)), request.scenario.problem
    draft = None
    if not problem.resources.are_points or not problem.is_open:
        draft = plan_in_turn(request, make_fleet_search(request), "shortest")
    return replace(
        draft or plan_fleet(request),
        status=Status("re-routed together"),
        reroutes=tuple(Reroute(robot=robot, because=because) for robot in robots),
    )
