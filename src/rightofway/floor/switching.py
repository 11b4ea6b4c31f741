"""Switching rights of way while the plan runs, where that helps and nobody can deadlock.

Whenever a robot is later than last expected, the floor looks ahead: what has happened is fixed, who
is overdue is expected to be so for as long again, and everything else takes the time of the plan.
Rights of way between visits that have not begun are flipped, each for a whole segment, as long as
that lowers the expected flowtime. The precedence graph refuses whatever would close a circle.

References
----------
Berndt, van Duijkeren, Palmieri & Keviczky, *A feedback scheme to reorder a multi-agent execution
schedule by persistently optimizing a switchable action dependency graph*, 2020. They solve each
look ahead as an integer program, over a horizon; here it is a descent over all that is left.

Notes
-----
Nobody knows how long a delay will last, neither here nor on a real floor: only what has happened
by the instant of a decision decides.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Route, Tick
from rightofway.planners.local_search import Search
from rightofway.planners.task import Task, planning_headway
from rightofway.precedence import (
    NEVER,
    DelayedPlan,
    Execution,
    PrecedenceGraph,
    Setbacks,
    order_of,
)

__all__ = ["switched"]

HORIZON = 2
"""Who breaks down is given up at this multiple of the plan's makespan, or of what came last."""

LOOKS = 400
"""A robot is news when it is late by this part of the makespan, and by a usual visit at least."""

Times = NDArray[np.int64]


def switched(
    floor: DelayedPlan, setbacks: Setbacks, *, until: Tick = NEVER
) -> tuple[DelayedPlan, int]:
    """Run a plan once, and switch rights of way on the way.

    Parameters
    ----------
    floor
        The plan, with its order of visits.
    setbacks
        What befalls the run; used to let things happen, never to look ahead.
    until
        When the last right of way may be switched [ticks].

    Returns
    -------
    floor, switches
        The plan with the order in which visits really took place, and how often it was changed.
    """
    patience = max(int(np.median(floor.dwell + floor.drive)), _last(floor.planned) // LOOKS, 1)
    expected, now, switches = floor.planned, -1, 0
    happens = floor.execute(setbacks)
    while (news := _next_news(happens.enter, expected + patience, now)) is not None:
        now = news
        if now > min(until, HORIZON * max(_last(floor.planned), _last(happens.enter))):
            break
        outlook = _Outlook(floor, happens, now, expected)
        expected = outlook.times()
        outlook.flip()
        before = order_of(floor.vertex, outlook.times())
        if not np.array_equal(before, floor.before) and outlook.allows(before):
            expected = outlook.times()
            floor = floor.reordered(before)
            happens = floor.execute(setbacks)
            switches += 1
    return floor, switches


def _next_news(enter: Times, overdue: Times, now: int) -> int | None:
    """Return the next instant at which a robot turns out to be later than expected."""
    late = overdue[(enter > overdue) & (overdue > now)]
    return int(late.min()) if late.size else None


def _last(enter: Times) -> int:
    return int(enter[enter < NEVER].max())


class _Outlook:
    """What can be expected at an instant, and what can still be changed."""

    def __init__(self, floor: DelayedPlan, happens: Execution, now: int, expected: Times) -> None:
        self.floor, self.now = floor, now
        self.begun = happens.start <= now
        self.over = happens.enter <= now
        self.enter = happens.enter
        scenario = floor.scenario
        self.graph = PrecedenceGraph(
            [self._route(robot) for robot in range(len(floor.routes))],
            headway=planning_headway(scenario),
            books_ahead=scenario.rules.books_ahead,
        )
        first = floor.first_visit.tolist()
        self.graph.keep_order([expected[i:j].tolist() for i, j in pairwise(first)])

    def _route(self, robot: int) -> Route:
        """Return a route with what has happened, and what the visit under way may still take."""
        route, first = self.floor.routes[robot], int(self.floor.first_visit[robot])
        dwell = list(route.dwell)
        for index in range(len(route)):
            visit = first + index
            if not self.over[visit] or index == len(route) - 1:
                break
            dwell[index] = Tick(self._lasts(visit, route.least(index)) - route.drive[index + 1])
        return replace(route, dwell=tuple(dwell))

    def _lasts(self, visit: int, least: int) -> int:
        began = int(self.enter[visit])
        if self.over[visit + 1]:
            return int(self.enter[visit + 1]) - began
        overdue = self.now - began - least
        return least if overdue < 0 else least + 2 * overdue + 1

    def times(self) -> Times:
        """Return when visits are expected to begin."""
        return np.concatenate([track.enter for track in self.graph.tracks()])

    def flip(self) -> None:
        """Flip rights of way that have not been used, as long as that lowers the flowtime."""
        task = Task(scenario=self.floor.scenario)
        Search(task, self.graph, lambda visit: not self.begun[visit]).descend()

    def allows(self, before: NDArray[np.int32]) -> bool:
        """Tell whether nobody who has begun would have to wait for somebody who has not."""
        waits_for = before[self.begun]
        return bool(self.begun[waits_for[waits_for >= 0]].all())
