"""Right of way by priority: the rules that the paper argues against.

The robots have an order. Where two of them conflict, the robot of higher priority goes first and
the other waits before the segment that they share, whatever the delay. Only where that is
impossible does the first robot wait. Everything else is as in `two_level`: routes, segments, and
the course where no waiting helps.

The three planners differ in the orders that they try. ``fixed-priority`` tries that of the
scenario. ``random-priority`` draws orders and keeps the best plan. ``priority-search`` climbs: it
swaps two robots' places in an order and keeps the order if the plan is not worse.

References
----------
Erdmann and Lozano-Pérez, *On multiple moving objects*, Algorithmica 2, 1987 (priorities).

Bennewitz, Burgard and Thrun, *Optimizing schedules for prioritized path planning of multi-robot
systems*, ICRA 2001; *Finding and optimizing solvable priority schemes for decoupled path planning
techniques for teams of mobile robots*, Robotics and Autonomous Systems 41, 2002 (the climb).

Notes
-----
Complete, as everything made of `conflict_resolution` is. Not optimal. The order decides rights of
way on fixed routes here, where in the references robots are planned one after another. The climb
begins with the order of the scenario, so it is never worse than ``fixed-priority``, and it goes on
from orders that are equally good.

Deterministic for a seed, as long as the time limit does not end the search; the plan is then the
best one so far.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Status, Tick
from rightofway.planners.rights_of_way import plan_by_rule
from rightofway.precedence import Meeting
from rightofway.repair.conflict_resolution import (
    PartialPlan,
    Resolution,
    Rule,
    list_rights_if_waits,
)
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.repair.routing import choose_routes

TRYING = Fact("trying orders of robots")

Worth = tuple[Tick, Tick]
"""The value of a plan, and its cost, as `PlanRequest.measure_worth` returns them [ticks]."""

Order = Sequence[int]
"""The robots, that of highest priority first."""


def fixed_priority(request: PlanRequest) -> Draft:
    """Plan with the robots' numbers as priorities, the first robot's the highest."""
    distances, routes = choose_routes(request)
    return plan_by_rule(request, distances, routes, plan_by_priority(range(len(routes))))


def random_priority(request: PlanRequest) -> Draft:
    """Plan with random priorities, several times, and keep the best plan."""

    def search(plan: Callable[[Order], Worth], listed: range, draw: random.Random) -> None:
        for _ in range(request.options["restarts"]):
            plan(draw.sample(listed, len(listed)))

    return _find_best_of(request, search)


def priority_search(request: PlanRequest) -> Draft:
    """Plan with priorities that are improved by hill climbing, several times.

    A climb swaps two robots in the order as long as that is not worse; the first climb starts from
    the order of the scenario.
    """

    def search(plan: Callable[[Order], Worth], listed: range, draw: random.Random) -> None:
        for climb in range(request.options["restarts"]):
            order: Order = draw.sample(listed, len(listed)) if climb else listed
            worth = plan(order)
            for _ in range(request.options["rounds"] - 1):
                other = list(order)
                if len(other) > 1:
                    first, another = draw.sample(listed, 2)
                    other[first], other[another] = other[another], other[first]
                other_worth = plan(other)
                if other_worth <= worth:
                    order, worth = other, other_worth

    return _find_best_of(request, search)


def plan_by_priority(order: Order) -> Rule:
    """Return the rule that the robot of higher priority goes first, wherever it can."""
    place = {robot: index for index, robot in enumerate(order)}

    def rule(plan: PartialPlan, meeting: Meeting) -> Resolution | None:
        i, j = meeting.robots
        lower = 0 if place[i] > place[j] else 1
        resolution = _try_wait(plan, meeting, lower, "priority")
        return resolution or _try_wait(plan, meeting, 1 - lower, "only")

    return rule


def _try_wait(
    plan: PartialPlan, meeting: Meeting, waits: int, level: Literal["priority", "only"]
) -> Resolution | None:
    """Let one of the two robots (0: i, 1: j) wait; None if impossible."""
    graph, segment = plan.graph, plan.find_segment(meeting)
    rights = list_rights_if_waits(graph, meeting, segment, waits)
    enters = rights[0][1]
    mark, planned = graph.checkpoint(), graph.enter(enters)
    if not graph.give_all(rights):
        return None
    delay = Tick(graph.enter(enters) - planned)
    graph.rollback(mark)
    decision = replace(plan.decide(meeting, segment, waits, delay), level=level)
    return Resolution(decisions=(decision,), rights=rights)


def _find_best_of(
    request: PlanRequest, search: Callable[[Callable[[Order], Worth], range, random.Random], None]
) -> Draft:
    """Let a search try orders until it ends or time is over, and return the best plan.

    The search gets the function that plans by an order and returns how good the plan is, the robots
    in the order of the scenario, and a source of random numbers.
    """
    distances, routes = choose_routes(request)
    tried, best, least = 0, None, (Tick(0), Tick(0))

    def plan(order: Order) -> Worth:
        nonlocal tried, best, least
        request.deadline.check(TRYING)
        draft = plan_by_rule(request, distances, routes, plan_by_priority(order))
        reached = request.measure_worth(draft.tracks)
        tried += 1
        if best is None or reached < least:
            best, least = draft, reached
            request.better(lambda: draft.tracks)
            values = {"order": tried, "objective": request.objective.value}
            request.report(Fact("value of order", request.scenario, **values, value=reached[0]))
        return reached

    try:
        search(plan, range(len(routes)), random.Random(request.seed))  # noqa: S311 (no secret)
    except GaveUp:
        if best is None:
            raise
    assert best is not None, "at least one order is tried"
    return replace(best, status=Status("best of orders", number=tried, status=best.status))
