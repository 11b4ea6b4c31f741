"""Monitoring of an execution, with reordering and replanning if they lower the expected flowtime.

Whenever a robot is later than last expected, the monitor makes a forecast: rights of way are
switched, and where the whole fleet has fallen behind, the rest is replanned. It is replanned as
well whenever a robot breaks down, and when closures leave a late robot no way. Only events that
have happened by the instant decides.

References
----------
Berndt, van Duijkeren, Palmieri & Keviczky, *A feedback scheme to reorder a multi-agent execution
schedule by persistently optimizing a switchable action dependency graph*, 2020. They solve an
integer program over a horizon at each look ahead; switching here is a descent over the whole rest.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.execution.forecast import Forecast
from rightofway.execution.progress import derive_progress
from rightofway.execution.replan import replan
from rightofway.model import NEVER, ExecutionTrace
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, RunBatch
from rightofway.repair.local_search import LocalSearch
from rightofway.repair.plan_request import PlanRequest

__all__ = ["ExecutionMonitor", "ExecutionPolicy", "has_fallen_behind"]

HORIZON = 2
"""Delays later than this multiple of the makespan, planned or actual, are ignored."""

LOOKS = 400
"""A visit is late from more than makespan / LOOKS, and the median visit, after its forecast."""

SHARE = 20
"""Replan when expected flowtime has grown by planned flowtime / SHARE since the last attempt."""

MOST_PLANS = 10
"""Maximum number of these attempts per run."""


def has_fallen_behind(expected: int, last_tried: int, planned: int) -> bool:
    """Return whether a fleet is so far behind its plan that the rest is replanned.

    Parameters
    ----------
    expected
        The flowtime that is expected now [ticks].
    last_tried
        The one that was expected after the last replanning, or when that failed [ticks].
    planned
        The one of the plan [ticks].
    """
    return (expected - last_tried) * SHARE >= max(planned, 1)


class ExecutionPolicy(NamedTuple):
    """Permitted changes during execution: switch rights of way, replan the remaining plan."""

    switch: bool = False
    replan: bool = False


class ExecutionMonitor:
    """One run of a plan, with changes during execution.

    Delays are those of a run of a seed, as for `ActionDependencyGraph.delay_sample`; the n-th visit
    of a robot meets the same delay in every plan. The seed is the planner's, too.

    Attributes
    ----------
    adg, delay_sample, execution
        The final plan, its delays, and its actual times.
    switches, replans
        How often rights of way were switched, and how often the rest was replanned.
    broken, lost, cut_off
        Robots that have broken down, those of them that had not completed before, and robots that a
        replanning did not bring to all their places.
    """

    def __init__(
        self,
        adg: ActionDependencyGraph,
        policy: ExecutionPolicy,
        seed: int,
        run: int,
        deadline: Deadline,
    ) -> None:
        self.adg, self.policy, self.seed, self.run = adg, policy, seed, run
        self.deadline = deadline
        self.delay_sample = adg.delay_sample(seed, run)
        self.execution = adg.execute(self.delay_sample)
        self.stages = tuple(itinerary.stages for itinerary in adg.scenario.problem.itineraries)
        self.switches = self.replans = 0
        self.broken = self.lost = self.cut_off = frozenset[int]()
        self.expected = adg.planned
        ends = adg.first_visit[1:] - 1
        self.last_tried = int((adg.planned + adg.dwell)[ends].sum())
        if any(policy):
            self._run_plan()

    @property
    def completion(self) -> NDArray[np.int64]:
        """Completion time of each robot, `NEVER` if a stage is not done [ticks]; int64[R]."""
        completion = self.execution.completion.copy()
        completion[sorted(self.lost | self.cut_off)] = NEVER
        return completion

    def as_batch(self, batch: RunBatch) -> RunBatch:
        """Return this run as a batch of one; ``kept`` is the same run of the plan as it was.

        Where the rest was replanned, the sources of lateness are not known and left out.
        """
        if not self.replans:
            return self.adg.make_runs(self.seed, self.run, 1)
        is_broken = self.execution.is_broken.copy()
        is_broken[sorted(self.lost)] = 1
        return batch._replace(
            completion=self.completion[None, :],
            is_broken=is_broken[None, :],
            by_right_of_way=self.execution.collisions[None, :],
            own=np.zeros_like(batch.own),
            of_others=np.zeros_like(batch.of_others),
            between=np.zeros((0, 3), np.int64),
            is_caught=self.execution.is_caught[None, :],
        )

    def trace(self) -> ExecutionTrace:
        """Return the actual tracks, and the duration of each visit and drive."""
        adg, sample = self.adg, self.delay_sample
        tracks = adg.build_tracks(self.execution.enter)
        firsts = adg.first_visit[:-1].tolist()
        visits = [slice(k, k + len(track)) for k, track in zip(firsts, tracks, strict=True)]
        return ExecutionTrace(
            tracks=tracks,
            dwell=tuple(sample.dwell[own] for own in visits),
            drive=tuple(sample.drive[own] for own in visits),
            completion=tuple(None if tick == NEVER else tick for tick in self.completion.tolist()),
            stoppages=tuple(
                tuple((k, None if n == NEVER else n) for k, n in sample.list_stoppages(robot))
                for robot in range(len(tracks))
            ),
        )

    def make_forecast(self, now: int) -> Forecast:
        """Return the forecast at a tick."""
        progress = derive_progress(self.adg, self.delay_sample, self.execution, now, self.broken)
        return Forecast(self.adg, progress)

    def _run_plan(self) -> None:
        """Execute the plan; at each delay or breakdown, make a forecast, then reorder or replan."""
        adg, now, tries, planned = self.adg, -1, 0, self.last_tried
        ticks = (self.delay_sample.find_breakdown(robot) for robot in range(len(self.stages)))
        breakdown = np.array([tick if self.policy.replan else NEVER for tick in ticks])
        patience = max(int(np.median(adg.dwell + adg.drive)), int(adg.planned.max()) // LOOKS, 1)
        while True:
            overdue = self.expected + patience
            late = overdue[(self.execution.enter > overdue) & (overdue > now)]
            news = int(late.min(initial=NEVER))
            real = self.execution.enter[self.execution.enter < NEVER]
            if news > HORIZON * max(int(self.adg.planned.max()), int(real.max())):
                news = NEVER
            at_work = self.execution.completion == NEVER
            at_work[sorted(self.broken)] = False
            now = min(news, int(breakdown[at_work].min(initial=NEVER)))
            if now == NEVER:
                return
            lost = np.flatnonzero(at_work & (breakdown <= now)).tolist()
            self.broken = self.broken.union(np.flatnonzero(breakdown <= now).tolist())
            self.lost = self.lost.union(lost)
            forecast = self.make_forecast(now)
            self.expected = forecast.compute_times()
            if lost:
                self._try_plans(forecast, NEVER)
                continue
            switched = _switch_rights(forecast) if self.policy.switch else None
            if switched is not None:
                self.switches += 1
                self.adg, self.expected = switched, forecast.compute_times()
                self.execution = switched.execute(self.delay_sample)
                forecast = self.make_forecast(now)
            flowtime = int(forecast.graph.compute_flowtime())
            is_shut_out = bool(adg.scenario.closures) and not forecast.is_possible
            wants_plan = is_shut_out or has_fallen_behind(flowtime, self.last_tried, planned)
            if self.policy.replan and wants_plan and tries < MOST_PLANS:
                tries += 1
                self.last_tried = flowtime
                self._try_plans(forecast, NEVER if is_shut_out else flowtime)

    def _try_plans(self, forecast: Forecast, limit: int) -> None:
        """Replan; accept the plan with the lowest expected flowtime below ``limit`` [ticks]."""
        lowest, best = limit, None
        for plan in replan(forecast, self.stages, self.seed, self.deadline):
            sample = plan.adg.delay_sample(self.seed, self.run)
            sample = sample.add_stoppages(self.delay_sample)
            execution = plan.adg.execute(sample)
            progress = derive_progress(plan.adg, sample, execution, forecast.now, self.broken)
            new = Forecast(plan.adg, progress)
            flowtime = int(new.graph.compute_flowtime())
            if new.is_possible and flowtime < lowest:
                lowest, best = flowtime, (plan, sample, execution, new)
        if best is not None:
            plan, self.delay_sample, self.execution, new = best
            self.replans += 1
            self.adg, self.stages, self.cut_off = plan.adg, plan.stages, self.cut_off | plan.cut_off
            self.expected, self.last_tried = new.compute_times(), lowest


def _switch_rights(forecast: Forecast) -> ActionDependencyGraph | None:
    """Flip rights of way of visits that have not begun; None if no other order helps.

    Each is flipped for a whole segment, as long as that lowers the expected flowtime. The graph of
    the forecast refuses every flip that closes a cycle; it gets the new order, if there is one.
    """
    adg, booked = forecast.adg, forecast.booked
    mark = forecast.graph.checkpoint()
    request = PlanRequest(scenario=adg.scenario)
    LocalSearch(request, forecast.graph, lambda visit: not booked[visit]).descend()
    order = adg.order_at(forecast.compute_times())
    # A visit that has begun must not wait for one that has not.
    first, second = order.T
    is_allowed = booked[first[booked[second]]].all()
    if np.array_equal(order, adg.order) or not is_allowed:
        forecast.graph.rollback(mark)
        return None
    return adg.reorder(order, np.where(booked, adg.since, forecast.now))
