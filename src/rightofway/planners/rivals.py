"""Prioritized planning in turns with the improvement of another plan, which it may replace.

A plan of LaCAM is there in an instant, and far from the best. Planning one robot after another
takes longer, and its plan is better as a rule. So the improvement begins with the plan of LaCAM,
and takes over each better one.

Where neither has a plan soon, robots with speeds of their own are planned at one pace: as robots of
one speed, with the same order at each vertex afterwards. If planning one after another fails, that
plan is improved at one pace. Steps of equal length need few states, so that this is quick, and the
order that it finds is better for the real robots, too.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from rightofway.errors import GaveUp
from rightofway.model import Scenario, Status
from rightofway.planners.prioritized import (
    MOST_ROBOTS,
    SEARCHES,
    SEARCHES_AT_ONE_PACE,
    choose_order,
    make_paced,
)
from rightofway.precedence import build_timetable
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import FleetSearch

SHARE_OF_GREEDY = 0.5
"""The most of the time left for a greedy plan, which takes a small part of it as a rule."""

FIRST_TURN, TURN = 0.3, 1.0
"""How long prioritized planning goes on at first and then [s]: its plan is better, as a rule, than
what the improvement comes to meanwhile.
"""

SHARE_AT_ONE_PACE = 0.5
"""The part of the time left for a plan at one pace and its improvement.

The rest is for the improvement at own speeds: at first it gains most, with any plan.
"""

TASKS_AT_ONE_PACE = 20
"""Neighbourhoods for each robot at one pace where no time limit ends that."""

UNLIMITED = 2**62


class Rival:
    """Prioritized planning that takes turns with the improvement, until it has a plan or fails.

    Without a limit of time it plans to its end first.

    Attributes
    ----------
    is_over
        No more turns are needed.
    status
        The origin of the plan with which the search continues; None for the plan that it had.
    """

    def __init__(self, request: PlanRequest, search: FleetSearch, *, competes: bool) -> None:
        self._request, self._search, self._competes = request, search, competes
        self._order = choose_order(request.scenario, search, "shortest", request.seed)
        self._searches = SEARCHES * len(self._order)
        self.is_over = not competes or len(self._order) > MOST_ROBOTS
        self.status: Status | None = None
        self._paced: FleetSearch | None = None  # with a plan at one pace

    def begin(self) -> None:
        """Plan for a moment, which is enough for most fleets; then by quicker methods."""
        self.go_on(FIRST_TURN)
        if not self._competes or (self.is_over and len(self._order) <= MOST_ROBOTS):
            return
        left = self._request.deadline.shorten(SHARE_OF_GREEDY).measure_seconds_left()
        with self._watch(Status("in turn")):
            self._search.hurry(self._order, searches=self._searches, time_limit=left)
        if self.status is None and _has_own_speeds(self._request.scenario):
            self._plan_at_one_pace()

    def go_on(self, seconds: float = TURN) -> None:
        """Plan for a while; at one pace, if that has failed."""
        left = self._request.deadline.measure_seconds_left()
        if self.is_over or left == 0:
            return
        limit = None if left is None else min(left, seconds)
        began, before = time.perf_counter(), self._search.cost
        with self._watch(Status("in turn")):
            has_ended = self._search.compete(self._order, searches=self._searches, time_limit=limit)
        has_given_up = limit is None or time.perf_counter() - began < limit / 2
        self.is_over = has_ended or has_given_up
        has_failed = not has_ended and has_given_up and self._search.cost == before
        if has_failed and _has_own_speeds(self._request.scenario) and self._plan_at_one_pace():
            self._improve_at_one_pace()

    def _plan_at_one_pace(self) -> bool:
        """Plan one robot after another at one pace, once; return whether there is such a plan."""
        if self._paced is None and len(self._order) <= MOST_ROBOTS:
            with suppress(GaveUp):  # the time ended meanwhile: the plan of the search stays
                problem = make_paced(self._request.scenario).problem
                paced = FleetSearch(problem, seed=self._request.seed)
                left = self._request.deadline.shorten(SHARE_AT_ONE_PACE).measure_seconds_left()
                searches = SEARCHES_AT_ONE_PACE * len(self._order)
                if paced.prioritize(self._order, searches=searches, time_limit=left):
                    self._paced = paced
                    self._take_order(paced)
        return self._paced is not None

    def _improve_at_one_pace(self) -> None:
        """Improve the plan at one pace, and take over each better order."""
        assert self._paced is not None, "there is a plan to improve"
        deadline = self._request.deadline.shorten(SHARE_AT_ONE_PACE)
        left = deadline.measure_seconds_left()
        tasks = TASKS_AT_ONE_PACE * len(self._order) if left is None else UNLIMITED
        done = tasks
        while tasks > 0 and left != 0 and done > 0:
            pause = None if left is None else TURN
            done = self._paced.improve(tasks, patience=tasks, time_limit=left, pause=pause)
            self._take_order(self._paced)
            tasks, left = tasks - done, deadline.measure_seconds_left()

    def _take_order(self, paced: FleetSearch) -> None:
        """Let robots of own speeds visit each vertex in the order of a plan at one pace."""
        tracks = build_timetable(self._request.scenario.problem, paced.list_tracks())
        assert tracks is not None, "what robots of one pace do in some order, others can do in it"
        if self._request.measure_worth(tracks) < (self._search.value, self._search.cost):
            with self._watch(Status("in turn at one pace")):
                self._search.start(tracks)

    @contextmanager
    def _watch(self, status: Status) -> Iterator[None]:
        """Note, and hand over, a plan that the search takes over."""
        before = self._search.value, self._search.cost
        yield
        if (self._search.value, self._search.cost) < before:
            self.status = status
            self._request.better(self._search.list_tracks)


def _has_own_speeds(scenario: Scenario) -> bool:
    """Return whether robots at one pace differ from those of the scenario."""
    return scenario.rules.occupancy == "both" or len({robot.speed for robot in scenario.robots}) > 1
