"""Replanning during execution, after delays and breakdowns.

Commitments are kept: a stay is finished, a drive arrives, bookings remain. After its commitment,
every robot gets a new route, and every vertex a new order. The *rest* is a scenario: each robot
starts at the end of its commitment and is busy until the commitment is done. Bookings of broken
robots become closures: vertices closed for ever, and whatever robots with a size cannot book beside
them. The first plan of the rest continues by right of way. If closures block it, LaCAM finds the
first plan, and for robots with a size planning one after another, or an order of moves; a robot
that cannot reach all its places is *cut off*: it serves reachable stages and ends at a vertex where
it blocks no robot. Large neighbourhood search (LNS) improves the first plan.

Closures of the scenario bind the rest, as far as they are not over. While a robot is caught in one,
or will be before its commitment is done, no plan of the rest keeps the rules, and none is made.

A robot with a size that drives keeps its tail and its edge booked until it has arrived: in the
order of visits, its visit of the tail comes before all visits of the new plan.

Deterministic for a seed: budgets are numbers of neighbourhoods and steps. The new order has no
cycle: commitments wait only for visits that have begun, and the rest has the order of a plan.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.forecast import Forecast
from rightofway.model import (
    Plan,
    PlannerRun,
    Route,
    Scenario,
    Stage,
    Tick,
    Track,
    compute_turns_along,
    make_route,
)
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, build_timetable
from rightofway.resume.commitment import Commitment, Stages, list_closures_after, make_rest
from rightofway.resume.held import Held, list_held
from rightofway.resume.other_ways import find_other_ways
from rightofway.site import VertexId
from rightofway.solve import improve

NEIGHBOURHOODS = 20
"""Neighbourhoods per robot; five times as many hardly lower the flowtime further."""


def find_commitment(forecast: Forecast, robot: int, stages: Sequence[Stage]) -> Commitment:
    """Return what a robot, whose route serves all these stages, has begun at a forecast's instant.

    A broken one keeps its bookings and has nothing left.
    """
    adg, route = forecast.adg, forecast.adg.routes[robot]
    first, end = adg.first_visit[robot : robot + 2].tolist()
    index = int(np.count_nonzero(forecast.booked[first:end])) - 1
    if robot in forecast.broken:
        vertex = route.vertices[index]
        return Commitment(visit=index, vertex=vertex, busy=Tick(0), begun=tuple(stages))
    is_driving = forecast.is_driving(robot)
    if is_driving and forecast.may_turn_back:
        # Towards a free vertex, the robot continues as if it had a booking; else it may turn back.
        before, closures = adg.comes_after(first + index + 1), adg.scenario.problem.closures
        closed = closures.list_at_vertex(robot, route.vertices[index + 1]) if closures else []
        is_closed = any(end > forecast.now for _, end in closed)
        is_driving = False
        index += not is_closed and all(forecast.entered[other + 1] for other in before)
    while route.vertices[index] >= adg.scenario.roadmap.n_drawn:
        index += 1  # the drive along a chain is finished
    ends = forecast.graph.enter(first + index) + forecast.graph.routes[robot].dwell[index]
    begun = sum(at <= index for at in route.serves)
    return Commitment(
        visit=index,
        vertex=route.vertices[index],
        busy=Tick(max(ends - forecast.now, 0)),
        drives_to=route.vertices[index + 1] if is_driving else None,
        begun=tuple(stages[:begun]),
        left=tuple(stages[begun:]),
    )


def find_held_by_broken(forecast: Forecast) -> Held:
    """Return what broken robots book for ever: for robots with a size, the edge driven on, too."""
    adg, booked, paths = forecast.adg, forecast.booked, dict[int, list[int]]()
    for robot in forecast.broken:
        current, end = forecast.get_visit(robot), int(adg.first_visit[robot + 1])
        paths[robot] = adg.vertex[current:end][booked[current:end]].tolist()
    return list_held(adg.scenario, paths)


@dataclass(frozen=True, slots=True, kw_only=True)
class Replanned:
    """A new plan during execution."""

    adg: ActionDependencyGraph  # what has begun, followed by the new plan of the rest
    stages: tuple[Stages, ...]  # all that the route of each robot serves
    cut_off: frozenset[int]  # robots that are not brought to all their places


def replan(
    forecast: Forecast, stages: Sequence[Stages], seed: int, deadline: Deadline
) -> tuple[Replanned, ...]:
    """Replan the rest: first cut off few robots, then lower the flowtime.

    ``stages`` are all that the route of each robot serves. The result is empty if no plan was
    found, or time ran out before; else the plan with the lowest flowtime of the rest, and the plan
    that it improves. The rest does not know the edges of drives that have begun: where such an edge
    keeps robots off, the second plan may be the better one. A forecast knows.
    """
    scenario, cut_off = forecast.adg.scenario, frozenset[int]()
    commitments = [find_commitment(forecast, robot, own) for robot, own in enumerate(stages)]
    closed = find_held_by_broken(forecast)
    roadmap = scenario.roadmap
    if closed.vertices:
        roadmap = roadmap.exclude(closed.vertices, closed.edges)
    closures = list_closures_after(scenario, roadmap, forecast.now)
    if closures is None:
        return ()
    rest = make_rest(replace(scenario, closures=closures), roadmap, commitments)
    tracks = _keep_old_order(forecast, commitments, closed, rest)
    if tracks is None:
        other_ways = find_other_ways(rest, forecast.broken, commitments, seed, deadline)
        if other_ways is None:
            return ()
        commitments, cut_off, tracks = other_ways
        rest = make_rest(rest, roadmap, commitments)
    first = Plan(scenario=rest, tracks=tuple(tracks), run=PlannerRun(name="by right of way"))
    if closures and not check(first).ok:  # a robot is caught, or will be
        return ()
    options = {"iterations": NEIGHBOURHOODS * len(stages)}
    plans = [first]
    try:
        left = deadline.measure_seconds_left()
        plans.insert(0, improve(first, time_limit=left, seed=seed, options=options))
    except (NoPlanExists, GaveUp):
        pass  # the first plan is kept
    replanned = []
    for plan in plans:
        # A plan may move a busy robot away and back. Splicing keeps it there, which may deadlock.
        try:
            adg = _splice(forecast, commitments, plan)
        except ValueError:
            continue
        if not adg.list_deadlocked():
            served = tuple((*commitment.begun, *commitment.left) for commitment in commitments)
            replanned.append(Replanned(adg=adg, stages=served, cut_off=cut_off))
    return tuple(replanned)


def _keep_old_order(
    forecast: Forecast,
    commitments: Sequence[Commitment],
    closed: Held,
    rest: Scenario,
) -> list[Track] | None:
    """Return the plan with the old routes and rights of way; None if a closure blocks it."""
    adg, times = forecast.adg, forecast.compute_times()
    old_tracks = []
    for robot, commitment in enumerate(commitments):
        first, end = int(adg.first_visit[robot]) + commitment.visit, int(adg.first_visit[robot + 1])
        if robot in forecast.broken:
            end = first + 1
        visited = adg.vertex[first:end].tolist()
        drives = pairwise(visited)
        if not closed.vertices.isdisjoint(visited[1:]) or not closed.edges.isdisjoint(drives):
            return None
        old_tracks.append(Track.of(visited, times[first:end].tolist()))
    return build_timetable(rest.problem, old_tracks)


def _turn_aside(
    scenario: Scenario, robot: int, commitment: Commitment, old: Route, ahead: Sequence[VertexId]
) -> int:
    """Return how long a robot turns at the end of its commitment to the vertex ahead, if any.

    Where it drives on as planned, the turn is a part of what the robot is busy with.
    """
    came, planned = (
        old.vertices[max(commitment.visit - 1, 0) : commitment.visit],
        old.vertices[commitment.visit + 1 :],
    )
    if commitment.drives_to is not None:
        came, planned = (commitment.vertex,), ()
    if not came or not ahead or ahead == planned[:1]:
        return 0
    path = np.array([*came, commitment.free_from, *ahead], np.int32)
    return int(compute_turns_along(scenario.roadmap, scenario.problem.itineraries[robot], path)[1])


def _number_arrivals(enter: NDArray[np.int64], arrives: int) -> NDArray[np.int64]:
    """Return when committed visits begin; those that have not begun, in their order from a tick."""
    is_ahead = enter > arrives
    return np.where(is_ahead, arrives + np.maximum(np.cumsum(is_ahead) - 1, 0), enter)


def _splice(
    forecast: Forecast, commitments: Sequence[Commitment], plan: Plan
) -> ActionDependencyGraph:
    """Return the commitments followed by a plan of the rest."""
    adg, now = forecast.adg, forecast.now
    # The arrival of a robot with a size comes after all that has ended until now, and before all
    # that is new. For points both begin at the vertex, and the order there is known.
    arrives = now if adg.scenario.problem.resources.are_points else now + 1
    firsts = adg.first_visit.tolist()
    begins_of_kept = [
        _number_arrivals(forecast.progress.enter[first : first + commitment.visit + 1], arrives)
        for first, commitment in zip(firsts[:-1], commitments, strict=True)
    ]
    latest = max(int(enter[-1]) for enter in begins_of_kept)
    routes, tracks, sinces = [], [], []
    for robot, (commitment, old) in enumerate(zip(commitments, adg.routes, strict=True)):
        itinerary, track = plan.scenario.problem.itineraries[robot], plan.tracks[robot]
        new = make_route(plan.scenario.roadmap, itinerary, track)
        is_driving = commitment.drives_to is not None
        # The new route's visit at the end of the commitment is the last visit of the old route.
        begins, n_begun = new.serves[is_driving], commitment.visit + 1 + is_driving
        before = 0 if is_driving else old.dwell[commitment.visit] - commitment.busy
        # The new route does not know where the robot has come from.
        known = compute_turns_along(plan.scenario.roadmap, itinerary, track.vertices)[begins]
        aside = _turn_aside(
            adg.scenario, robot, commitment, old, new.vertices[begins + 1 : begins + 2]
        )
        shift = n_begun - 1 - begins
        to_come = new.serves[len(new.serves) - len(commitment.left) :]
        serves = [*old.serves[: len(commitment.begun)], *(visit + shift for visit in to_come)]
        serves[-1] = len(new) - 1 + shift  # a completed robot may give way and return
        route = Route(
            vertices=(*old.vertices[:n_begun], *new.vertices[begins + 1 :]),
            dwell=(
                *old.dwell[: n_begun - 1],
                Tick(before + new.dwell[begins] - int(known) + aside),
                *new.dwell[begins + 1 :],
            ),
            drive=(*old.drive[:n_begun], *new.drive[begins + 1 :]),
            serves=tuple(serves),
        )
        booked = slice(first := int(adg.first_visit[robot]), first + commitment.visit + 1)
        enter = max(arrives, latest) + 1 + track.enter[begins + 1 - is_driving :]
        since = np.full(len(enter), now)
        next_visit = slice(commitment.visit + 1, commitment.visit + 2)
        turns_back = old.vertices[next_visit] != route.vertices[next_visit]
        if len(enter) and forecast.may_turn_back and forecast.has_set_off(robot) and turns_back:
            since[0] += route.drive[commitment.visit + 1]
        enter = np.append(begins_of_kept[robot], enter)
        tracks.append(Track(vertices=np.array(route.vertices, np.int32), enter=enter))
        routes.append(route)
        sinces.append(np.append(adg.since[booked], since))
    return ActionDependencyGraph(
        adg.scenario, tracks, adg.delay_model, routes=routes, since=np.concatenate(sinces)
    )
