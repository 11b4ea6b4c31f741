"""Anytime improvement: a few robots at a time give up their tracks and are planned anew.

References
----------
Li, Chen, Harabor, Stuckey & Koenig, *Anytime multi-agent path finding via large neighborhood
search*, IJCAI 2021.

Li, Chen, Harabor, Stuckey & Koenig, *MAPF-LNS2: Fast repairing for multi-agent path finding via
large neighborhood search*, AAAI 2022.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.model import Track
from rightofway.planners.joint import plan_jointly
from rightofway.planners.prioritized import fleet_search, plan_in_turn
from rightofway.planners.task import Draft, Task
from rightofway.search import FleetSearch

__all__ = ["lns"]

SHARE = 0.7
"""The part of the time that planning all together may take."""

PATIENCE = 1000
"""After so many neighbourhoods per robot without a gain it ends."""

BETWEEN_REPORTS = 0.5
"""Seconds from one sentence on progress to the next."""

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
    tracks, origin = (task.start, "the plan given") if task.start else _first_plan(task, search)
    search.start(tracks)
    improvement = _Improvement(task, search)
    improvement.run()
    return Draft(tracks=search.tracks(), status=improvement.status(origin))


def _first_plan(task: Task, search: FleetSearch) -> tuple[tuple[Track, ...], str]:
    """Plan all robots together, which is quick, and one after another; take the better plan."""
    together = _together(task)
    in_turn = plan_in_turn(task, search, "shortest")
    if in_turn is None:
        if together is None:
            raise GaveUp("time ran out before there was a first plan (give a longer time limit)")
        return together, "all together"
    if together is None or _flowtime(search, in_turn[0]) <= _flowtime(search, together):
        return in_turn
    return together, "all together"


def _together(task: Task) -> tuple[Track, ...] | None:
    try:
        return tuple(plan_jointly(replace(task, deadline=task.deadline.sooner(SHARE)))[0])
    except GaveUp:
        return None


def _flowtime(search: FleetSearch, tracks: Sequence[Track]) -> int:
    search.start(tracks)
    return search.flowtime


class _Improvement:
    """Improving the tracks of a search, and telling how it goes."""

    def __init__(self, task: Task, search: FleetSearch) -> None:
        self.task, self.search = task, search
        self.bound = int(search.alone().sum())
        self.patience = PATIENCE * len(task.scenario.robots)
        self.done = 0

    @property
    def is_optimal(self) -> bool:
        return self.search.flowtime == self.bound

    def run(self) -> None:
        """Improve until time, iterations or gains are used up, or nothing can be better."""
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
        return f"improved by {self.done} neighbourhoods (first plan: {origin})"

    def _gap(self) -> str:
        return f"{self.search.flowtime / self.bound - 1:.2%} above the bound"
