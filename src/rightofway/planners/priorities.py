"""Right of way by priority: the ways of giving way that the paper argues against.

The robots have an order. Where two of them meet, the one of higher priority goes first and the
other waits before the segment that they share; what that costs, and whom, plays no part. Only where
it is impossible does the other one wait. Everything else is as in `two_level`: routes, segments,
and what happens where no waiting helps.

The three planners differ in where the orders come from. ``fixed-priority`` takes the robots as the
scenario lists them. ``random-priority`` draws orders and keeps the best plan. ``priority-search``
climbs: it swaps two robots' places in an order and keeps what is not worse.

References
----------
Erdmann and Lozano-Pérez, *On multiple moving objects*, Algorithmica 2, 1987 (priorities).

Bennewitz, Burgard and Thrun, *Optimizing schedules for prioritized path planning of multi-robot
systems*, ICRA 2001; *Finding and optimizing solvable priority schemes for decoupled path planning
techniques for teams of mobile robots*, Robotics and Autonomous Systems 41, 2002 (the climb).

Notes
-----
Complete, as everything made of `giving_way` is: given time they find a plan or prove that there is
none. Not optimal. The order decides rights of way on fixed routes here, where in the references
robots are planned one after another. The climb begins with the order of the scenario, so it is
never worse than ``fixed-priority``, and it goes on from orders that are just as good.

Deterministic for a seed, as long as the time limit does not end the search; then the best plan so
far is handed out.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

from rightofway.errors import GaveUp
from rightofway.model import Scenario, Tick
from rightofway.planners.conflict_resolution import (
    Fleet,
    Rule,
    Settlement,
    plan_by_rule,
    rights_if_waits,
)
from rightofway.planners.routing import clear_routes, shortest_routes
from rightofway.planners.task import Draft, Task
from rightofway.precedence import Meeting
from rightofway.search import Distances

__all__ = ["by_priority", "fixed_priority", "priority_search", "random_priority"]

Order = Sequence[int]
"""The robots, the one of highest priority first."""


def fixed_priority(task: Task) -> Draft:
    """Plan a fleet with the robots' numbers as priorities, the first robot's the highest.

    Parameters
    ----------
    task
        Options: ``routes`` is ``clear`` or ``shortest``.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.
    """
    search = _Search(task)
    return search.plan(search.as_listed)


def random_priority(task: Task) -> Draft:
    """Plan a fleet with random priorities, several times, and keep the best plan.

    Parameters
    ----------
    task
        Options: ``restarts`` is how many orders are drawn; ``routes`` as for `fixed_priority`.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out before the first plan.
    """
    return _best_of(task, _draw)


def priority_search(task: Task) -> Draft:
    """Plan a fleet with priorities that are improved by hill climbing, several times.

    Parameters
    ----------
    task
        Options: ``restarts`` is how many climbs there are, the first from the robots as the
        scenario lists them; ``rounds`` is how many orders each of them tries; ``routes`` as for
        `fixed_priority`.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out before the first plan.
    """
    return _best_of(task, _climb)


def by_priority(order: Order) -> Rule:
    """Return the rule that the one of higher priority goes first, wherever it can."""
    place = {robot: index for index, robot in enumerate(order)}

    def rule(fleet: Fleet, meeting: Meeting) -> Settlement | None:
        i, j = meeting.robots
        lower = 0 if place[i] > place[j] else 1
        yields = _if_waits(fleet, meeting, lower, "priority")
        return yields or _if_waits(fleet, meeting, 1 - lower, "only")

    return rule


def _if_waits(
    fleet: Fleet, meeting: Meeting, waits: int, level: Literal["priority", "only"]
) -> Settlement | None:
    """Let one of the two (0: i, 1: j) wait; None if impossible."""
    graph, segment = fleet.graph, fleet.segment_of(meeting)
    rights = rights_if_waits(graph, meeting, segment, waits)
    enters = rights[0][1]
    mark, planned = graph.checkpoint(), graph.enter(enters)
    if not graph.give_all(rights):
        return None
    delay = Tick(graph.enter(enters) - planned)
    graph.rollback(mark)
    decision = replace(fleet.decide(meeting, segment, waits, delay), level=level)
    return Settlement(decisions=(decision,), rights=rights)


class _Search:
    """Orders of the robots, and what they lead to.

    Attributes
    ----------
    as_listed
        The order of the scenario.
    attempts
        How many orders were tried.
    best
        The least flowtime [ticks] and the plan that has it, the first of several.
    """

    def __init__(self, task: Task) -> None:
        scenario = task.scenario
        choose = clear_routes if task.options["routes"] == "clear" else shortest_routes
        self.task = task
        self.distances = Distances(scenario.roadmap)
        self.routes = choose(scenario, self.distances)
        self.as_listed = range(len(self.routes))
        self.attempts = 0
        self.best: tuple[int, Draft] | None = None
        self._draw = random.Random(task.seed)  # noqa: S311 (no secret depends on it)

    def plan(self, order: Order) -> Draft:
        """Return the plan that an order leads to."""
        return plan_by_rule(self.task, self.distances, self.routes, by_priority(order))

    def attempt(self, order: Order) -> int:
        """Return the flowtime that an order leads to [ticks]; keep the plan if it is the best."""
        self.task.deadline.check("trying orders of the robots")
        draft = self.plan(order)
        flowtime = _flowtime(self.task.scenario, draft)
        self.attempts += 1
        if self.best is None or flowtime < self.best[0]:
            self.best = flowtime, draft
            self.task.report(f"order {self.attempts}: flowtime {flowtime} ticks")
        return flowtime

    def any_order(self) -> Order:
        """Draw an order at random."""
        return self._draw.sample(self.as_listed, len(self.as_listed))

    def with_two_swapped(self, order: Order) -> Order:
        """Return an order in which two robots, drawn at random, have changed places."""
        swapped = list(order)
        if len(swapped) > 1:
            one, other = self._draw.sample(self.as_listed, 2)
            swapped[one], swapped[other] = swapped[other], swapped[one]
        return swapped


def _best_of(task: Task, explore: Callable[[_Search], None]) -> Draft:
    """Try orders until there are no more or time is over, and return the best plan."""
    search = _Search(task)
    try:
        explore(search)
    except GaveUp:
        if search.best is None:
            raise
    assert search.best is not None, "at least one order is tried"
    _, draft = search.best
    orders = "1 order" if search.attempts == 1 else f"{search.attempts} orders"
    return replace(draft, status=f"{draft.status}; best of {orders}")


def _draw(search: _Search) -> None:
    """Try random orders."""
    for _ in range(search.task.options["restarts"]):
        search.attempt(search.any_order())


def _climb(search: _Search) -> None:
    """Swap two robots' places as long as that is not worse; then from another order again."""
    for climb in range(search.task.options["restarts"]):
        order = search.any_order() if climb else search.as_listed
        cost = search.attempt(order)
        for _ in range(search.task.options["rounds"] - 1):
            other = search.with_two_swapped(order)
            others_cost = search.attempt(other)
            if others_cost <= cost:
                order, cost = other, others_cost


def _flowtime(scenario: Scenario, draft: Draft) -> int:
    """Return the sum of completion times [ticks]."""
    return sum(
        int(track.enter[-1]) + itinerary.stages[-1].work
        for itinerary, track in zip(scenario.problem.itineraries, draft.tracks, strict=True)
    )
