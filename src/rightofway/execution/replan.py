"""Replanning the rest of a plan during execution, after delays and after breakdowns.

Commitments are kept: a robot that stays finishes there, a robot that drives arrives, bookings stay.
From there on every robot gets a new route, and every vertex a new order. The rest is a scenario of
its own: each robot starts where its commitment ends and is first busy until then. Broken robots are
closures: what they have booked stays booked for ever. Going on by right of way is one plan of the
rest. Where closures block it, LaCAM finds another one; a robot that cannot reach all its places any
more is *cut off*: it does what it can and ends wherever it is in no robot's way. Large
neighbourhood search improves that first plan.

Notes
-----
Deterministic for a seed: budgets are numbers of neighbourhoods and steps. The new order has no
cycle: commitments wait for nothing that has not begun, and the rest follows the order of a plan.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, islice

import numpy as np

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.commitment import Commitment, closures_of, commitment_of
from rightofway.execution.forecast import Forecast
from rightofway.model import (
    Plan,
    PlannerRun,
    Roadmap,
    Robot,
    Route,
    Scenario,
    Stage,
    Stop,
    Tick,
    Track,
    VertexId,
    route_of,
)
from rightofway.planners import Deadline
from rightofway.planners.lacam import timetable_in_order, timetable_of
from rightofway.precedence import ActionDependencyGraph
from rightofway.search import untimed_lacam
from rightofway.solve import improve

__all__ = ["Replanned", "replan"]

PLANNER = "lns"

NEIGHBOURHOODS = 20
"""Neighbourhoods tried per robot; five times as many gain hardly more."""

MOST_STEPS = 20_000
"""Steps of LaCAM until robots are taken to have no way for this choice of who is cut off."""

MOST_CHOICES = 200
"""Choices of who is cut off that are tried."""

Stages = tuple[Stage, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Replanned:
    """A new plan during execution.

    Attributes
    ----------
    adg
        What has begun, followed by the new plan of the rest.
    stages
        For each robot all stages that its route serves.
    cut_off
        Robots that are not brought to all their places.
    """

    adg: ActionDependencyGraph
    stages: tuple[Stages, ...]
    cut_off: frozenset[int]


def replan(
    forecast: Forecast, stages: Sequence[Stages], seed: int, deadline: Deadline
) -> Replanned | None:
    """Replan the rest, so that as many robots as possible complete, with a low flowtime.

    Parameters
    ----------
    forecast
        What is expected of going on by right of way; it names the broken robots.
    stages
        For each robot all stages that its route serves.
    seed
        For the planners.
    deadline
        When to stop.

    Returns
    -------
    Replanned or None
        None if no plan was found, or time ran out before.
    """
    scenario, cut_off = forecast.adg.scenario, frozenset[int]()
    commitments = [commitment_of(forecast, robot, own) for robot, own in enumerate(stages)]
    closed = closures_of(forecast)
    roadmap = scenario.roadmap.without(closed) if closed else scenario.roadmap
    rest = _rest(scenario, roadmap, commitments)
    tracks = _going_on(forecast, commitments, closed, rest)
    if tracks is None:
        found = _another_way(rest, forecast.broken, commitments, seed, deadline)
        if found is None:
            return None
        commitments, cut_off, tracks = found
        rest = _rest(scenario, roadmap, commitments)
    first = Plan(scenario=rest, tracks=tuple(tracks), run=PlannerRun(name="by right of way"))
    options = {"iterations": NEIGHBOURHOODS * len(stages)}
    better = improve(first, PLANNER, deadline.seconds_left(), seed, options=options)
    for plan in (better, first):
        adg = _spliced(forecast, commitments, plan)
        # The planner may send a busy robot away and back. It stays, so robots may wait in a cycle.
        if not adg.deadlocked():
            served = tuple((*one.begun, *one.left) for one in commitments)
            return Replanned(adg=adg, stages=served, cut_off=cut_off)
    return None


def _going_on(
    forecast: Forecast,
    commitments: Sequence[Commitment],
    closed: frozenset[VertexId],
    rest: Scenario,
) -> list[Track] | None:
    """Return the plan that keeps routes and rights of way; None if a closure blocks it."""
    adg, times = forecast.adg, forecast.times()
    visited, arrivals = [], []
    for robot, one in enumerate(commitments):
        first, end = int(adg.first_visit[robot]) + one.visit, int(adg.first_visit[robot + 1])
        if robot in forecast.broken:
            end = first + 1
        visited.append(adg.vertex[first:end].tolist())
        arrivals.append(times[first:end].tolist())
        if closed.intersection(visited[-1][1:]):
            return None
    return timetable_in_order(rest, visited, arrivals)


def _another_way(
    rest: Scenario,
    broken: frozenset[int],
    commitments: Sequence[Commitment],
    seed: int,
    deadline: Deadline,
) -> tuple[list[Commitment], frozenset[int], list[Track]] | None:
    """Return what robots do, as few as possible that are cut off, and tracks by LaCAM."""
    for cut_off, tried in islice(_choices(rest.roadmap, broken, commitments), MOST_CHOICES):
        if deadline.seconds_left() == 0:
            return None
        try:
            steps = untimed_lacam(
                _rest(rest, rest.roadmap, tried),
                seed=seed,
                time_limit=deadline.seconds_left(),
                most_steps=MOST_STEPS,
                ends_anywhere=cut_off,
            )
        except (NoPlanExists, GaveUp):
            continue
        ended = [
            replace(one, left=(*one.left[:-1], _end(steps[-1, robot]))) if robot in cut_off else one
            for robot, one in enumerate(tried)
        ]
        return ended, cut_off, timetable_of(_rest(rest, rest.roadmap, ended), steps)
    return None


def _choices(
    roadmap: Roadmap, broken: frozenset[int], commitments: Sequence[Commitment]
) -> Iterator[tuple[frozenset[int], list[Commitment]]]:
    """Yield who may be cut off, and what all robots do then: fewest first, with most stages first.

    The last stage of a robot that is cut off is where it would like to end.
    """
    reachable = [replace(one, left=_within_reach(roadmap, one)) for one in commitments]
    by_map = {
        robot for robot, one in enumerate(commitments) if len(reachable[robot].left) < len(one.left)
    }
    others = [robot for robot in range(len(commitments)) if robot not in broken | by_map]
    for count in range(len(others) + 1):
        for more in combinations(others, count):
            cut_off = frozenset(by_map.union(more))
            for most in (None, 0) if cut_off else (None,):
                yield (
                    cut_off,
                    [
                        _ending_anywhere(one, one.left[:most]) if robot in cut_off else one
                        for robot, one in enumerate(reachable)
                    ],
                )


def _within_reach(roadmap: Roadmap, commitment: Commitment) -> Stages:
    """Return the stages that a robot can still get to, one after the other."""
    at, kept = commitment.goes_on_from, []
    for stage in commitment.left:
        found, queue = {at}, [at]
        for vertex in queue:
            heads = roadmap.heads[roadmap.indptr[vertex] : roadmap.indptr[vertex + 1]].tolist()
            queue += [head for head in heads if head not in found]
            found.update(heads)
        if stage.vertex in found:
            kept.append(stage)
            at = stage.vertex
    return tuple(kept)


def _ending_anywhere(one: Commitment, left: Stages) -> Commitment:
    return replace(one, left=(*left, _end(left[-1].vertex if left else one.goes_on_from)))


def _end(vertex: int) -> Stage:
    return Stage(vertex=VertexId(int(vertex)), work=Tick(0), turn=Tick(0))


def _rest(scenario: Scenario, roadmap: Roadmap, commitments: Sequence[Commitment]) -> Scenario:
    """Return the problem of the rest; turning counts as work, since it may have begun."""
    time = scenario.problem.clock.time

    def one_way(robot: Robot, one: Commitment) -> Robot:
        stops = [Stop(at=one.vertex, work=time(one.busy))]
        if one.drives_to is not None:
            stops.append(Stop(at=one.drives_to))
        for number, stage in enumerate(one.left, 1):
            turn = stage.turn if number < len(one.left) else 0
            stops.append(Stop(at=stage.vertex, work=time(Tick(stage.work + turn))))
        if not one.left:
            stops.append(Stop(at=stops[-1].at))
        return replace(
            robot, home=one.vertex, stops=tuple(stops), turn=Fraction(0), ends="none", laps=1
        )

    robots = tuple(map(one_way, scenario.robots, commitments))
    return replace(scenario, roadmap=roadmap, robots=robots, clock=scenario.problem.clock)


def _spliced(
    forecast: Forecast, commitments: Sequence[Commitment], plan: Plan
) -> ActionDependencyGraph:
    """Return what has begun, followed by a plan of the rest."""
    adg, routes, enters, sinces = forecast.adg, [], [], []
    for robot, one in enumerate(commitments):
        first = int(adg.first_visit[robot])
        kept = slice(first, first + one.visit + 1)
        itinerary, track = plan.scenario.problem.itineraries[robot], plan.tracks[robot]
        new = route_of(plan.scenario.roadmap, itinerary, track)
        begins = new.serves[one.drives_to is not None]
        routes.append(_spliced_route(adg.routes[robot], new, one, begins))
        to_come = track.enter[begins + (one.drives_to is None) :]
        enter = np.minimum(forecast.execution.enter[kept], forecast.now)
        enters.append(np.append(enter, forecast.now + 1 + to_come))
        since = np.full(len(to_come), forecast.now)
        if len(to_come) and forecast.broken and forecast.has_set_off(robot):
            following = slice(one.visit + 1, one.visit + 2)
            if adg.routes[robot].vertices[following] != routes[-1].vertices[following]:
                since[:1] += routes[-1].drive[one.visit + 1]  # turns back: drives from now on
        sinces.append(np.append(adg.since[kept], since))
    return ActionDependencyGraph(
        adg.scenario,
        [
            Track(vertices=np.array(route.vertices, np.int32), enter=enter)
            for route, enter in zip(routes, enters, strict=True)
        ],
        adg.delay_model,
        routes=routes,
        since=np.concatenate(sinces),
    )


def _spliced_route(old: Route, new: Route, one: Commitment, begins: int) -> Route:
    """Join routes; visits of the new one before ``begins``, which ends the commitment, go."""
    here = one.visit
    vertices, drive = old.vertices[: here + 1], old.drive[: here + 1]
    dwell = (*old.dwell[:here], Tick(old.dwell[here] + new.dwell[begins] - one.busy))
    if one.drives_to is not None:
        vertices, drive = (*vertices, one.drives_to), old.drive[: here + 2]
        dwell = (*old.dwell[: here + 1], new.dwell[begins])
    shift = len(vertices) - 1 - begins
    to_come = new.serves[len(new.serves) - len(one.left) :]
    serves = [*old.serves[: len(one.begun)], *(visit + shift for visit in to_come)]
    serves[-1] = len(new) - 1 + shift  # robots that are done may move aside, and come back to end
    return Route(
        vertices=(*vertices, *new.vertices[begins + 1 :]),
        dwell=(*dwell, *new.dwell[begins + 1 :]),
        drive=(*drive, *new.drive[begins + 1 :]),
        serves=tuple(serves),
    )
