"""Monitoring an execution, and changing what has not begun where that is expected to help.

Whenever a robot is later than last expected, the monitor makes a forecast: rights of way are
switched, and where the whole fleet has fallen behind, the rest is replanned. It is replanned as
well whenever a robot breaks down. Only what has happened by the instant decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.forecast import Forecast, Times
from rightofway.execution.reorder import reordered
from rightofway.execution.replan import replan
from rightofway.model import NEVER, Tick
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, RunBatch, stoppage_arrays

__all__ = ["SHARE", "ExecutionMonitor", "ExecutionPolicy"]

HORIZON = 2
"""Robots that stand still are waited for until this multiple of the makespan, planned or real."""

LOOKS = 400
"""A robot is late by this part of the makespan, and by the duration of a median visit at least."""

SHARE = 20
"""The rest is replanned when the expected flowtime has grown by this part of the planned one since
that was last tried."""

MOST_PLANS = 10
"""How often that is tried with one plan."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecutionPolicy:
    """What may be changed during execution.

    Attributes
    ----------
    switch
        Whether rights of way are switched where that is expected to help.
    replan
        Whether the rest is replanned: where the fleet has fallen behind and that is expected to
        help, and where a robot breaks down.
    """

    switch: bool = False
    replan: bool = False

    def __bool__(self) -> bool:
        return self.switch or self.replan


class ExecutionMonitor:
    """One run of a plan, changed during execution.

    Parameters
    ----------
    adg
        The plan.
    policy
        What may be changed.
    seed, run
        Delays are those of this run, as for `ActionDependencyGraph.delay_sample`; the n-th visit of
        a robot meets the same delay in every plan. The seed is the planner's, too.
    deadline
        When to stop replanning.

    Attributes
    ----------
    adg, delay_sample, execution
        The plan as it is in the end, its delays, and the times that follow.
    switches, replans
        How often rights of way were switched, and how often the rest was replanned.
    broken, lost
        Robots that have broken down, and those of them that had not completed before.
    cut_off
        Robots that a replanning did not bring to all their places.
    """

    def __init__(
        self,
        adg: ActionDependencyGraph,
        policy: ExecutionPolicy,
        seed: int,
        run: int,
        deadline: Deadline | None = None,
    ) -> None:
        self.adg, self.policy, self.seed, self.run_number = adg, policy, seed, run
        self.deadline = deadline or Deadline()
        self.delay_sample = adg.delay_sample(seed, run)
        self.execution = adg.execute(self.delay_sample)
        self.stages = tuple(one.stages for one in adg.scenario.problem.itineraries)
        self.switches = self.replans = self.tries = 0
        self.broken: frozenset[int] = frozenset()
        self.lost: frozenset[int] = frozenset()
        self.cut_off: frozenset[int] = frozenset()
        self.expected = adg.planned
        self.patience = max(int(np.median(adg.dwell + adg.drive)), _last(adg.planned) // LOOKS, 1)
        ends = adg.first_visit[1:] - 1
        self.planned = self.last_tried = int((adg.planned + adg.dwell)[ends].sum())
        self._run()

    @property
    def completion(self) -> NDArray[np.int64]:
        """When each robot completed, `NEVER` if it was not all done [ticks]; int64[R]."""
        completion = self.execution.completion.copy()
        completion[sorted(self.lost | self.cut_off)] = NEVER
        return completion

    def changes(self) -> tuple[int, int, int, bool]:
        """Return switches, replans, robots cut off, and whether robots deadlock."""
        cut_off = len(self.cut_off - self.lost)
        return self.switches, self.replans, cut_off, bool(self.adg.deadlocked())

    def batch(self, kept: RunBatch) -> RunBatch:
        """Return this run as a batch of one.

        Parameters
        ----------
        kept
            The same run of the plan as it was at first. Where the rest was replanned, the sources
            of lateness are not known and left out.
        """
        if not self.replans:
            return self.adg.runs(self.seed, self.run_number, 1)
        is_broken = self.execution.is_broken.copy()
        is_broken[sorted(self.lost)] = 1
        return kept._replace(
            completion=self.completion[None, :],
            is_broken=is_broken[None, :],
            by_right_of_way=self.execution.collisions[None, :],
            own=np.zeros_like(kept.own),
            of_others=np.zeros_like(kept.of_others),
            between=np.zeros((0, 3), np.int64),
        )

    def _run(self) -> None:
        """Execute the plan, and make a forecast whenever there is news."""
        now = -1
        while True:
            news, breakdown = self.next_news(now), self.next_breakdown()
            now = min(news if news <= self.horizon() else NEVER, breakdown)
            if now == NEVER:
                return
            is_new = self.policy.replan and self.note_breakdowns(now)
            forecast = self.forecast(now)
            self.expected = forecast.times()
            if self.policy.switch and not is_new:
                forecast = self.try_to_reorder(forecast)
            if is_new:
                self.replan(forecast, NEVER)
            elif self.policy.replan and self.has_fallen_behind(forecast):
                self.tries += 1
                self.last_tried = int(forecast.graph.flowtime())
                self.replan(forecast, self.last_tried)

    def note_breakdowns(self, now: int) -> bool:
        """Note the robots that have broken down by now; return whether one has work left."""
        down = {r for r in range(len(self.stages)) if self.delay_sample.breakdown(r) <= now}
        lost = {r for r in down - self.broken if self.execution.completion[r] > now}
        self.broken, self.lost = self.broken.union(down), self.lost.union(lost)
        return bool(lost)

    def next_news(self, now: int) -> int:
        """Return the next tick at which a robot turns out to be later than expected."""
        overdue = self.expected + self.patience
        late = overdue[(self.execution.enter > overdue) & (overdue > now)]
        return int(late.min(initial=NEVER))

    def next_breakdown(self) -> int:
        """Return the next tick at which a robot breaks down before it completes."""
        if not self.policy.replan:
            return NEVER
        unfinished = np.flatnonzero(self.execution.completion == NEVER).tolist()
        new = (robot for robot in unfinished if robot not in self.broken)
        return min(map(self.delay_sample.breakdown, new), default=NEVER)

    def horizon(self) -> int:
        """Return until when late robots are looked at [ticks]."""
        return HORIZON * max(_last(self.adg.planned), _last(self.execution.enter))

    def forecast(self, now: int) -> Forecast:
        """Return what is expected at a tick."""
        return Forecast(self.adg, self.delay_sample, self.execution, now, self.broken)

    def try_to_reorder(self, forecast: Forecast) -> Forecast:
        """Switch rights of way where that helps; return what is expected then."""
        adg = reordered(forecast)
        if adg is None:
            return forecast
        self.switches += 1
        self.adg, self.expected = adg, forecast.times()
        self.execution = adg.execute(self.delay_sample)
        return self.forecast(forecast.now)

    def has_fallen_behind(self, forecast: Forecast) -> bool:
        """Tell whether to replan."""
        later = forecast.graph.flowtime() - self.last_tried
        return self.tries < MOST_PLANS and later * SHARE >= self.planned

    def replan(self, forecast: Forecast, limit: int) -> None:
        """Replan the rest; take the new plan if its expected flowtime is below a limit."""
        found = replan(forecast, self.stages, self.seed, self.deadline)
        if found is None:
            return
        robots = range(len(self.stages))
        drawn = found.adg.delay_sample(self.seed, self.run_number)
        arrays = stoppage_arrays([self.delay_sample.stoppages_of(robot) for robot in robots])
        delay_sample = drawn._replace(first_stoppage=arrays[0], tick=arrays[1], ticks=arrays[2])
        execution = found.adg.execute(delay_sample)
        new = Forecast(found.adg, delay_sample, execution, forecast.now, self.broken)
        flowtime = int(new.graph.flowtime())
        if new.is_possible and flowtime < limit:
            self.replans += 1
            self.adg, self.delay_sample, self.execution = found.adg, delay_sample, execution
            self.stages, self.cut_off = found.stages, self.cut_off | found.cut_off
            self.expected, self.last_tried = new.times(), flowtime


def _last(enter: Times) -> Tick:
    return Tick(int(enter[enter < NEVER].max()))
