"""Watching a plan while it runs, and changing what has not begun where that is expected to help.

Whenever a robot is later than last expected, the floor looks ahead: rights of way are switched, and
where the whole fleet has fallen behind, what is left is planned anew. Only what has happened by the
instant decides.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rightofway.execution.forecast import Forecast, Times
from rightofway.execution.online_replanning import replan_online
from rightofway.execution.reorder import switched
from rightofway.execution.stop import first_breakdown, with_standstills
from rightofway.model import NEVER
from rightofway.precedence import ActionDependencyGraph, DelaySample

__all__ = ["SHARE", "ExecutionMonitor"]

HORIZON = 2
"""Who breaks down is given up at this multiple of the plan's makespan, or of what came last."""

LOOKS = 400
"""A robot is news when it is late by this part of the makespan, and by a usual visit at least."""

SHARE = 20
"""What is left is planned anew when the fleet is expected to be later by this part of the flowtime
of its plan than when that was last tried."""

MOST_PLANS = 10
"""How often that is tried with one plan."""

Draw = Callable[[ActionDependencyGraph], DelaySample]
"""What befalls a plan in this run."""


class ExecutionMonitor:
    """A run of a plan that is changed on the way.

    Parameters
    ----------
    floor, setbacks
        The plan, and what befalls it; used to let things happen, never to look ahead.
    switch
        Whether rights of way are switched.
    draw
        What is to befall a new plan, where what is left is planned anew; then the watch ends when a
        robot breaks down. The n-th visit of a robot is to meet the same as before.
    seed
        For the planner.

    Attributes
    ----------
    floor, setbacks
        The plan as it was in the end, and what befell it.
    switches, replans
        How often rights of way were changed, and how often what was left was planned anew.
    """

    def __init__(
        self,
        floor: ActionDependencyGraph,
        delay_sample: DelaySample,
        *,
        switch: bool = False,
        draw: Draw | None = None,
        seed: int = 0,
    ) -> None:
        self.floor, self.delay_sample = floor, delay_sample
        self.switch, self.draw, self.seed = switch, draw, seed
        self.switches = self.replans = self.tries = 0
        self.happens = floor.execute(delay_sample)
        self.expected = floor.planned
        self.patience = max(
            int(np.median(floor.dwell + floor.drive)), _last(floor.planned) // LOOKS, 1
        )
        ends = floor.first_visit[1:] - 1
        self.planned = self.last_tried = int((floor.planned + floor.dwell)[ends].sum())
        self.run()

    def run(self) -> None:
        """Let the plan run, and look ahead whenever there is news."""
        now = -1
        while (now := self.next_news(now)) <= self.horizon():
            outlook = self.outlook(now)
            self.expected = outlook.times()
            if self.switch:
                outlook = self.try_to_switch(outlook)
            if self.draw and self.has_fallen_behind(outlook):
                self.try_to_plan_anew(outlook, self.draw)

    def next_news(self, now: int) -> int:
        """Return the next instant at which a robot turns out to be later than expected."""
        overdue = self.expected + self.patience
        late = overdue[(self.happens.enter > overdue) & (overdue > now)]
        return int(late.min(initial=NEVER))

    def horizon(self) -> int:
        """Return when the watch ends [ticks]."""
        ends = HORIZON * max(_last(self.floor.planned), _last(self.happens.enter))
        return min(ends, first_breakdown(self.delay_sample, self.happens)) if self.draw else ends

    def outlook(self, now: int) -> Forecast:
        """Look ahead."""
        return Forecast(self.floor, self.delay_sample, self.happens, now)

    def try_to_switch(self, outlook: Forecast) -> Forecast:
        """Switch rights of way where that helps; return what is to be expected then."""
        floor = switched(outlook)
        if floor is None:
            return outlook
        self.switches += 1
        self.floor, self.expected = floor, outlook.times()
        self.happens = floor.execute(self.delay_sample)
        return self.outlook(outlook.now)

    def has_fallen_behind(self, outlook: Forecast) -> bool:
        """Tell whether it is time to plan anew."""
        later = outlook.graph.flowtime() - self.last_tried
        return self.tries < MOST_PLANS and later * SHARE >= self.planned

    def try_to_plan_anew(self, outlook: Forecast, draw: Draw) -> None:
        """Plan anew what is left, and go on with that where it is expected to be earlier."""
        self.tries += 1
        self.last_tried = int(outlook.graph.flowtime())
        floor = replan_online(outlook, self.seed)
        if floor is None:
            return
        robots = range(len(floor.routes))
        delay_sample = with_standstills(
            draw(floor), [self.delay_sample.of(robot) for robot in robots]
        )
        happens = floor.execute(delay_sample)
        anew = Forecast(floor, delay_sample, happens, outlook.now)
        if anew.is_possible and anew.graph.flowtime() < self.last_tried:
            self.replans += 1
            self.floor, self.delay_sample, self.happens = floor, delay_sample, happens
            self.expected, self.last_tried = anew.times(), int(anew.graph.flowtime())


def _last(enter: Times) -> int:
    return int(enter[enter < NEVER].max())
