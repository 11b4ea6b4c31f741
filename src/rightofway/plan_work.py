"""From jobs to a plan: who does which job, then routes; each learns from the other.

    jobs → tours → routes → rights of way → timetable → plan → judge
      ↑                                                          │
      └──────────────────── delays of the legs ──────────────────┘

Tours are made from the travel times of robots alone. Their plan shows how much later robots are on
each leg, because they wait for others or drive around them. The next round adds these delays to the
travel times and makes other tours. The best plan that the judge passes wins.

A battery may last in a tour and not in its plan, because waiting drains it. Then the next round
counts the whole delay of each leg, so that the tour charges for longer; at last the robot loses its
last job.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from fractions import Fraction
from itertools import count
from typing import NamedTuple

import numpy as np

from rightofway.assign import AssignmentSearch, measure_travel
from rightofway.check import Report
from rightofway.deadline import Deadline
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.metrics import list_job_times
from rightofway.model import Objective, Plan, Scenario, compute_cost
from rightofway.model.work import Assignment, UnservedReason, Work
from rightofway.search import Distances

ROUNDS = 8
"""How many assignments are planned, at most."""

STEPS_PER_JOB = 60
"""Steps of the search for tours in each round, for each job."""

SHARE_OF_TOURS, SHARE_OF_PLAN = 0.3, 0.5
"""The parts of the time left that a round takes for tours, then for their plan."""

MEMORY = 0.5
"""The part of the known delay of a leg that a round keeps, where its plan shows another one."""

PlanTours = Callable[[Assignment, Deadline, int], tuple[Plan, Report]]
"""Plans an assignment with a seed, and has the plan judged.

Raises `GaveUp` or `NoPlanExists` if it finds none.
"""


class WorkCost(NamedTuple):
    """The objective of a plan with jobs; compared from left to right.

    Attributes
    ----------
    unserved
        The sum of the weights of unserved jobs.
    value
        The objective of the work [ticks times weights].
    cost
        The flowtime with weights of robots and surcharges [ticks].
    """

    unserved: int
    value: Fraction
    cost: int


def measure_work(plan: Plan) -> WorkCost:
    """Return the objective of a plan with jobs and tours that keeps the rules."""
    work = plan.scenario.problem.work
    assert work is not None, "the scenario has jobs"
    cost = compute_cost(plan.scenario, plan.tracks)
    return WorkCost(
        unserved=sum(work.jobs[job].weight for job, _ in plan.unserved),
        value=_measure_value(plan, work),
        cost=cost,
    )


def _measure_value(plan: Plan, work: Work) -> Fraction:
    match work.objective:
        case "service":
            return sum(
                (
                    work.jobs[done.job].weight * (done.service_time + work.late * done.late)
                    for done in list_job_times(plan)
                ),
                Fraction(0),
            )
        case "flowtime":
            return Fraction(sum(plan.completions))
        case "makespan":
            return Fraction(max(plan.completions))
        case "both":
            weights = plan.scenario.problem.weights
            return Fraction(Objective.BOTH.compute_values(weights, plan.completions)[0])


def plan_work(
    scenario: Scenario,
    plan_tours: PlanTours,
    *,
    deadline: Deadline,
    seed: int = 0,
    better: Callable[[Plan], None] = lambda _: None,
    report: Callable[[Fact], None] = lambda _: None,
) -> Plan:
    """Return the best judged plan of a scenario with jobs, with its tours and unserved jobs.

    A first plan is looked for whatever the deadline. `better` takes each plan that is better than
    those before, `report` a fact on the progress after each round. If not even the begun jobs
    alone lead to a plan, the error of that assignment is raised.
    """
    rounds = _Rounds(scenario, plan_tours, deadline, seed)
    for number in count(1):
        plan = rounds.run(number)
        if plan is not None:
            better(plan)
        report(Fact("round of jobs", number=number, unserved=rounds.count_unserved()))
        if rounds.best is not None and (number >= ROUNDS or deadline.measure_seconds_left() == 0):
            return rounds.best[1]
    raise AssertionError("rounds end with a plan or an error")


class _Rounds:
    """Rounds of assigning and planning.

    Attributes
    ----------
    best
        The cost of the best plan that the judge has passed, and the plan.
    """

    def __init__(
        self, scenario: Scenario, plan_tours: PlanTours, deadline: Deadline, seed: int
    ) -> None:
        work = scenario.problem.work
        assert work is not None, "the scenario has jobs"
        self._work, self._weights = work, scenario.problem.weights
        self._plan_tours, self._deadline, self._seed = plan_tours, deadline, seed
        self._travel = measure_travel(scenario.problem, Distances(scenario.roadmap))
        self._delays = np.zeros(self._travel.ticks.shape)
        self._start: Assignment | None = None  # from which the next search for tours starts
        self._fewer: Assignment | None = None  # the next assignment, after one without a plan
        self._n_refused = 0  # plans that the judge has refused since the last good one
        self.best: tuple[WorkCost, Plan] | None = None

    def count_unserved(self) -> int:
        """Return the number of unserved jobs of the best plan; without a plan, that of all jobs."""
        return len(self._work.jobs) if self.best is None else len(self.best[1].unserved)

    def run(self, number: int) -> Plan | None:
        """Make tours, plan them, learn their delays; return the plan if it is the best one."""
        deadline, fewer = self._deadline.shorten(SHARE_OF_PLAN), self._fewer
        try:
            assignment, self._fewer = fewer or self._assign(number), None
        except GaveUp:
            if self.best is None:
                raise
            return None
        try:
            plan, judged = self._plan_tours(assignment, deadline, self._seed + number - 1)
        except (GaveUp, NoPlanExists):
            if self.best is None:
                # Half of the jobs at a time: a fleet in which nobody moves has a plan at last.
                self._fewer = self._keep_half(assignment)
                if self._fewer is None:
                    raise
            return None
        self._learn(plan, assignment, whole=not judged.ok)
        if not judged.ok:
            self._n_refused += 1
            if self._n_refused > 1:  # the delays that were seen did not help
                self._fewer = self._drop_last_jobs(assignment, judged)
                if self._fewer is None and self.best is None:
                    raise GaveUp(Fact("plan with faults", faults=judged.total))
            return None
        self._start, self._n_refused = assignment, 0
        cost = measure_work(plan)
        if self.best is not None and self.best[0] <= cost:
            return None
        self.best = cost, plan
        return plan

    def _assign(self, number: int) -> Assignment:
        """Return tours for the travel times and delays that are known."""
        travel = self._travel.delay(np.rint(self._delays).astype(np.int32))
        search = AssignmentSearch(
            self._work, travel, weights=self._weights, seed=self._seed + number
        )
        if self._start is not None:
            search.start(self._start)
        deadline = self._deadline.shorten(SHARE_OF_TOURS)
        search.construct(deadline.measure_seconds_left())
        steps = STEPS_PER_JOB * len(self._work.jobs)
        search.improve(steps, deadline.measure_seconds_left())
        if search.cost.missing:  # they may not be left out, so fewer jobs do not help
            raise GaveUp(Fact("begun jobs without a tour"))
        return search.assignment

    def _learn(self, plan: Plan, assignment: Assignment, *, whole: bool) -> None:
        """Correct the delays of the legs that robots have driven.

        ``whole``: keep nothing of what was known, and no delay becomes less.
        """
        seen: dict[tuple[int, int, int], list[int]] = {}
        for leg, ticks in self._list_delays(plan, assignment):
            seen.setdefault(leg, []).append(ticks)
        for leg, delays in seen.items():
            if whole:
                self._delays[leg] = max(self._delays[leg], *delays)
            else:
                mean = sum(delays) / len(delays)
                self._delays[leg] = MEMORY * self._delays[leg] + (1 - MEMORY) * mean

    def _list_delays(
        self, plan: Plan, assignment: Assignment
    ) -> Iterator[tuple[tuple[int, int, int], int]]:
        """Yield each leg (kind of travel, from, to) with its delay in a plan [ticks].

        A robot that would have waited at its next stop anyway is not late.
        """
        travel, jobs = self._travel, self._work.jobs
        for robot, tour in enumerate(plan.tours or ()):
            kind, at = travel.kind_of[robot], travel.get_start(robot)
            free = self._work.robots[robot].ready
            for item, wanted in zip(tour, assignment.tours[robot], strict=False):
                to, needed = travel.place_of[wanted.vertex], 0
                if item.job is not None and item.stop is not None:
                    job = jobs[item.job]
                    needed = job.stops[item.stop - job.first].earliest
                alone = free + max(0, int(travel.ticks[kind, at, to]))
                yield (kind, at, to), max(0, item.begin - max(alone, needed))
                at, free = to, item.end

    def _keep_half(self, assignment: Assignment) -> Assignment | None:
        """Return an assignment with half of the jobs, those of most weight; None without jobs."""
        served = {item.job for tour in assignment.tours for item in tour if item.job is not None}
        free = sorted(
            (job for job in served if self._work.jobs[job].begun_by is None),
            key=lambda job: (self._work.jobs[job].weight, job),
        )
        return self._drop_jobs(assignment, free[: -(-len(free) // 2)]) if free else None

    def _drop_last_jobs(self, assignment: Assignment, judged: Report) -> Assignment | None:
        """Return an assignment in which robots with faults lose their last job; None if none do."""
        last = dict[int, int]()
        for robot in {robot for fault in judged.faults for robot in fault.robots}:
            for item in assignment.tours[robot]:
                if item.job is not None and self._work.jobs[item.job].begun_by is None:
                    last[robot] = item.job
        return self._drop_jobs(assignment, last.values()) if last else None

    def _drop_jobs(self, assignment: Assignment, jobs: Collection[int]) -> Assignment:
        """Return an assignment without some jobs, and without those after them."""
        unserved: dict[int, UnservedReason] = dict(assignment.unserved)
        follows: Collection[int] = jobs
        unserved.update(dict.fromkeys(jobs, "not found"))
        while follows:
            follows = [
                job
                for job, own in enumerate(self._work.jobs)
                if job not in unserved and not unserved.keys().isdisjoint(own.after)
            ]
            unserved.update(dict.fromkeys(follows, "after"))
        return Assignment(
            tours=tuple(
                tuple(item for item in tour if item.job not in unserved)
                for tour in assignment.tours
            ),
            unserved=tuple(sorted(unserved.items())),
        )
