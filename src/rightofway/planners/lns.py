"""Anytime improvement: a few robots at a time give up their tracks and are planned anew.

Where that is stuck, a few plans of the fleet are crossed with each other.

References
----------
Li, Chen, Harabor, Stuckey & Koenig, *Anytime multi-agent path finding via large neighborhood
search*, IJCAI 2021.

Li, Chen, Harabor, Stuckey & Koenig, *MAPF-LNS2: Fast repairing for multi-agent path finding via
large neighborhood search*, AAAI 2022.

Moscato & Norman, *A memetic approach for the traveling salesman problem*, 1992.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.model import Track, flowtime_of
from rightofway.planners.joint import plan_jointly
from rightofway.planners.prioritized import MOST_ROBOTS, fleet_search, plan_in_turn
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.precedence import graph_of
from rightofway.search import FleetSearch

__all__ = ["improved", "lns"]

SHARE = 0.9
"""The part of the time that planning all together may take."""

PATIENCE = 1000
"""After so many neighbourhoods per robot without a gain it ends."""

BETWEEN_REPORTS = 0.5
"""Seconds from one sentence on progress to the next."""

RETIMING = 0.6e-6
"""The time that the last step takes for each visit of the plan, `FleetSearch.retime` [s]."""

UNLIMITED = 2**62


def lns(task: Task) -> Draft:
    """Find a plan, or take the one given, and improve it until time is up.

    Parameters
    ----------
    task
        Options: ``iterations`` ends it after so many neighbourhoods; 0 does not. With a plan in
        ``start``, that one is improved.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out before there was a plan.
    """
    search = fleet_search(task)
    if task.start is not None:
        return _improve(task, search, Draft(tracks=task.start, status="the plan given"))
    return improved(task, search)


def improved(task: Task, search: FleetSearch, *, first: Draft | None = None) -> Draft:
    """Improve the best of several first plans, of one that is there already and of our own.

    Raises
    ------
    NoPlanExists, GaveUp
        As `lns`.
    """
    found = (first, _together(task), plan_in_turn(task, search, "shortest"))
    plans = [plan for plan in found if plan is not None]
    if not plans:
        raise GaveUp("time ran out before there was a first plan (give a longer time limit)")
    best = min(plans, key=lambda plan: flowtime_of(task.scenario, plan.tracks))
    return _improve(task, search, best)


def _together(task: Task) -> Draft | None:
    """Plan all robots together; that is quick, and no worse than nothing.

    Fleets too large to be planned in turn may take all the time.
    """
    share = SHARE if len(task.scenario.robots) <= MOST_ROBOTS else 1
    try:
        tracks, _ = plan_jointly(replace(task, deadline=task.deadline.sooner(share)))
    except GaveUp:
        return None
    return Draft(tracks=tuple(tracks), status="all together")


def _improve(task: Task, search: FleetSearch, first: Draft) -> Draft:
    spaced = _spaced(task, first.tracks)
    search.start(spaced)
    retiming = RETIMING * sum(map(len, spaced))
    improvement = _Improvement(replace(task, deadline=task.deadline.earlier(retiming)), search)
    improvement.run()
    if search.flowtime < improvement.first:
        search.retime()  # who waited for robots that come earlier now need not wait so long
    found = search.tracks()
    if spaced is not first.tracks and flowtime_of(task.scenario, found) > flowtime_of(
        task.scenario, first.tracks
    ):
        found = first.tracks  # the headway of planning costs more than was won
    return Draft(tracks=found, status=improvement.status(first.status))


def _spaced(task: Task, tracks: tuple[Track, ...]) -> Sequence[Track]:
    """Return the tracks with the headway of planning, where that is more than the scenario's."""
    headway = planning_headway(task.scenario)
    if headway == task.scenario.problem.headway:
        return tracks
    return graph_of(task.scenario, tracks, headway=headway).tracks()


class _Improvement:
    """Improving the tracks of a search, and telling how it goes."""

    def __init__(self, task: Task, search: FleetSearch) -> None:
        self.task, self.search = task, search
        self.bound = int(search.alone().sum())
        self.patience = PATIENCE * len(task.scenario.robots)
        self.first, self.done = search.flowtime, 0
        self.was_interrupted = False

    @property
    def is_optimal(self) -> bool:
        return self.search.flowtime == self.bound

    def run(self) -> None:
        """Improve until time, iterations or gains are used up, or nothing can be better.

        An interrupt ends it too where the task keeps the best plan.
        """
        try:
            self._run()
        except KeyboardInterrupt:
            if not self.task.keep_best:
                raise
            self.was_interrupted = True

    def _run(self) -> None:
        iterations = self.task.options["iterations"] or UNLIMITED
        while not self.is_optimal and self.done < iterations:
            began, before = time.perf_counter(), self.done
            left = self.task.deadline.seconds_left()
            self.done += self.search.improve(
                iterations - self.done,
                patience=self.patience,
                time_limit=left,
                pause=BETWEEN_REPORTS,
            )
            rate = (self.done - before) / (time.perf_counter() - began)
            self.task.report(f"flowtime {self.search.flowtime}, {self._gap()}, {rate:.0f} tries/s")
            if self.search.idle >= self.patience or self.task.deadline.seconds_left() == 0:
                return

    def status(self, origin: str) -> str:
        """Say what was done."""
        if self.is_optimal:
            return f"optimal: every robot as fast as alone (first plan: {origin})"
        ended = "interrupted: " if self.was_interrupted else ""
        if self.search.flowtime == self.first:
            return f"{ended}{origin}; {self.done} neighbourhoods found nothing better"
        return f"{ended}improved by {self.done} neighbourhoods (first plan: {origin})"

    def _gap(self) -> str:
        above = self.search.flowtime / self.bound - 1 if self.bound else float("inf")
        return f"{above:.2%} above the bound"
