"""Right of way by priority: the rules that the paper argues against.

The robots have an order. Where two of them conflict, the robot of higher priority goes first and
the other waits before the segment that they share, whatever the delay. Only where that is
impossible does the first robot wait. Everything else is as in `two_level`: routes, segments, and
what happens where no waiting helps.

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
from collections.abc import Generator, Sequence
from dataclasses import replace
from functools import partial
from typing import Literal

from rightofway.errors import GaveUp
from rightofway.model import Tick, flowtime_of
from rightofway.planners.conflict_resolution import (
    PartialPlan,
    Resolution,
    Rule,
    plan_by_rule,
    rights_if_waits,
)
from rightofway.planners.routing import clear_routes, shortest_routes
from rightofway.planners.task import Draft, Task
from rightofway.precedence import Meeting
from rightofway.search import Distances

__all__ = ["by_priority", "fixed_priority", "priority_search", "random_priority"]

Order = Sequence[int]
"""The robots, that of highest priority first."""

Orders = Generator[Order, int, None]
"""Orders to try; the flowtime that each leads to [ticks] is sent back."""


def fixed_priority(task: Task) -> Draft:
    """Plan a fleet with the robots' numbers as priorities, the first robot's the highest.

    Parameters
    ----------
    task
        Options: `PriorityOptions`.

    Raises
    ------
    NoPlanExists
        If it is proven that no plan exists.
    GaveUp
        If time ran out before the first plan.
    """
    return _plan(task, order="listed")


def random_priority(task: Task) -> Draft:
    """Plan a fleet with random priorities, several times, and keep the best plan.

    Parameters
    ----------
    task
        Options: `RandomPriorityOptions`.

    Raises
    ------
    NoPlanExists, GaveUp
        As `fixed_priority`.
    """
    return _plan(task, order="random")


def priority_search(task: Task) -> Draft:
    """Plan a fleet with priorities that are improved by hill climbing, several times.

    Parameters
    ----------
    task
        Options: `PrioritySearchOptions`; the first climb starts from the order of the scenario.

    Raises
    ------
    NoPlanExists, GaveUp
        As `fixed_priority`.
    """
    return _plan(task, order="climbing")


def by_priority(order: Order) -> Rule:
    """Return the rule that the robot of higher priority goes first, wherever it can."""
    place = {robot: index for index, robot in enumerate(order)}

    def rule(plan: PartialPlan, meeting: Meeting) -> Resolution | None:
        i, j = meeting.robots
        lower = 0 if place[i] > place[j] else 1
        resolution = _if_waits(plan, meeting, lower, "priority")
        return resolution or _if_waits(plan, meeting, 1 - lower, "only")

    return rule


def _if_waits(
    plan: PartialPlan, meeting: Meeting, waits: int, level: Literal["priority", "only"]
) -> Resolution | None:
    """Let one of the two robots (0: i, 1: j) wait; None if impossible."""
    graph, segment = plan.graph, plan.segment_of(meeting)
    rights = rights_if_waits(graph, meeting, segment, waits)
    enters = rights[0][1]
    mark, planned = graph.checkpoint(), graph.enter(enters)
    if not graph.give_all(rights):
        return None
    delay = Tick(graph.enter(enters) - planned)
    graph.rollback(mark)
    decision = replace(plan.decide(meeting, segment, waits, delay), level=level)
    return Resolution(decisions=(decision,), rights=rights)


def _plan(task: Task, order: Literal["listed", "random", "climbing"]) -> Draft:
    """Try orders until there are no more or time is over, and return the best plan."""
    checkpoint = partial(task.deadline.check, "choosing routes")
    distances = Distances(task.scenario.roadmap, checkpoint=checkpoint)
    choose = clear_routes if task.options["routes"] == "clear" else shortest_routes
    routes = choose(task.scenario, distances)
    if order == "listed":
        return plan_by_rule(task, distances, routes, by_priority(range(len(routes))))
    orders = (_drawn if order == "random" else _climbing)(task, range(len(routes)))
    tried, best, least = 0, None, 0
    robots: Order | None = next(orders)
    try:
        while robots is not None:
            task.deadline.check("trying orders of the robots")
            draft = plan_by_rule(task, distances, routes, by_priority(robots))
            flowtime = flowtime_of(task.scenario, draft.tracks)
            tried += 1
            if best is None or flowtime < least:
                best, least = draft, flowtime
                task.report(f"order {tried}: flowtime {flowtime} ticks")
            robots = _next(orders, flowtime)
    except GaveUp:
        if best is None:
            raise
    assert best is not None, "at least one order is tried"
    count = "1 order" if tried == 1 else f"{tried} orders"
    return replace(best, status=f"{best.status}; best of {count}")


def _next(orders: Orders, flowtime: int) -> Order | None:
    try:
        return orders.send(flowtime)
    except StopIteration:
        return None


def _drawn(task: Task, listed: range) -> Orders:
    """Yield random orders."""
    draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
    for _ in range(task.options["restarts"]):
        yield draw.sample(listed, len(listed))


def _climbing(task: Task, listed: range) -> Orders:
    """Yield an order, then orders with two robots swapped, as long as that is not worse."""
    draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)
    for climb in range(task.options["restarts"]):
        order: Order = draw.sample(listed, len(listed)) if climb else listed
        cost = yield order
        for _ in range(task.options["rounds"] - 1):
            other = list(order)
            if len(other) > 1:
                one, another = draw.sample(listed, 2)
                other[one], other[another] = other[another], other[one]
            other_cost = yield other
            if other_cost <= cost:
                order, cost = other, other_cost
