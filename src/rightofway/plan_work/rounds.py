"""Rounds of assigning and planning, and neighbourhoods of the best plan.

Tours are made from the travel times of robots alone. Their plan shows how much later robots are on
each leg, because they wait for others or drive around them. The next round adds these delays to the
travel times and makes other tours. From the best plan that the judge passes, jobs move between
tours as long as the planned cost falls.

A battery may last in a tour and not in its plan, because waiting drains it. Then the next round
counts the whole delay of each leg, so that the tour charges for longer; at last the robot loses its
last job.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from itertools import count

import numpy as np

from rightofway.assign import AssignmentSearch, Travel, WorkBound, measure_travel
from rightofway.check import Report, check
from rightofway.deadline import Deadline
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import Objective, OutcomeKind, Plan, Proof, Scenario, Tick
from rightofway.model.outcome import classify_cost
from rightofway.model.work import Assignment, TourItem, UnservedReason, WorkObjective
from rightofway.plan_work.cost import WorkCost, measure_work
from rightofway.plan_work.neighbourhoods import Neighbourhoods
from rightofway.progress import log_progress
from rightofway.search import Distances

ROUNDS = 8
"""The largest number of assignments that are planned."""

STEPS_PER_JOB = 200
"""Steps of the search for tours in each round, for each job."""

SHARE_OF_ROUNDS = 0.3
"""The part of the time for all rounds; the neighbourhoods of the best plan have the rest."""

SHARE_OF_TOURS, SHARE_OF_PLAN = 0.3, 0.5
"""The parts of the time left for rounds that a round takes for tours, then for their plan."""

MOVES, MOVES_PER_JOB, PATIENCE, PATIENCE_PER_JOB = 2000, 500, 1000, 200
"""Neighbours that are tried, and neighbours in a row without a gain; at least, and for each job."""

MEMORY = 0.5
"""The part of the known delay of a leg that a round keeps, where its plan shows another one."""

OBJECTIVES: Mapping[WorkObjective, Objective] = {
    "service": Objective.SERVICE,
    "flowtime": Objective.FLOWTIME,
    "makespan": Objective.MAKESPAN,
    "both": Objective.BOTH,
}

PlanTours = Callable[
    [Assignment, Deadline, int, Callable[[Plan], None] | None], tuple[Plan, Report]
]
"""Plans an assignment with a seed, and has the plan judged; may hand over plans on its way.

Raises `GaveUp` or `NoPlanExists` if it finds none.
"""


def plan_work(
    scenario: Scenario,
    plan_tours: PlanTours,
    *,
    deadline: Deadline,
    seed: int = 0,
    better: Callable[[Plan], None] = lambda _: None,
    report: Callable[[Fact], None] = log_progress,
) -> Plan:
    """Return the best judged plan of a scenario with jobs, with its tours and unserved jobs.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    plan_tours
        Plans an assignment.
    deadline
        When to stop.
    seed
        For all that is drawn.
    better
        Takes each plan that is better than those before.
    report
        Takes a fact on the progress after each round.

    Raises
    ------
    GaveUp, NoPlanExists
        If not even the begun jobs alone lead to a plan in time: the error of that assignment.
    """
    of_rounds = deadline.shorten(SHARE_OF_ROUNDS)
    rounds = _Rounds(scenario, plan_tours, (of_rounds, deadline), seed, better)
    for number in count(1):
        plan = rounds.run(number)
        if plan is not None:
            better(plan)
        report(Fact("round of jobs", number=number, unserved=rounds.count_unserved()))
        if rounds.best is not None and (number >= ROUNDS or of_rounds.measure_seconds_left() == 0):
            return rounds.move_jobs(deadline, better)
    raise AssertionError("rounds end with a plan or an error")


class _Rounds:
    """Rounds of assigning and planning.

    Attributes
    ----------
    best
        The cost of the best plan that the judge has passed, and the plan.
    """

    def __init__(
        self,
        scenario: Scenario,
        plan_tours: PlanTours,
        deadlines: tuple[Deadline, Deadline],
        seed: int,
        better: Callable[[Plan], None],
    ) -> None:
        work = scenario.problem.work
        assert work is not None, "the scenario has jobs"
        self._work, self._weights = work, scenario.problem.weights
        self._plan_tours, self._seed, self._better = plan_tours, seed, better
        self._deadline, self._last_deadline = deadlines  # of the rounds; without a plan
        self._travel = measure_travel(scenario.problem, Distances(scenario.roadmap))
        self._delays = np.zeros(self._travel.ticks.shape)
        # Kinds that share a table of drives share what is learned about it.
        kinds = self._travel.batteries
        tables = {id(kind.drives): np.zeros_like(kind.drives) for kind in kinds}
        self._drains = [tables[id(kind.drives)] for kind in kinds]
        self._start: Assignment | None = None  # from which the next search for tours starts
        self._fewer: Assignment | None = None  # the next assignment, after one without a plan
        self._n_refused = 0  # plans that the judge has refused since the last good one
        self._is_offered = False  # whether the best plan was handed over by a planner at work
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
            offer = self._take_offer if self.best is None else None
            plan, judged = self._plan_tours(assignment, deadline, self._seed + number - 1, offer)
        except (GaveUp, NoPlanExists):
            if self.best is None and not self._choose_next(assignment):
                raise
            return None
        self._learn(plan, assignment, whole=not judged.ok)
        if not judged.ok:
            self._n_refused += 1
            if self._n_refused > 1:  # the delays that were seen did not help
                self._fewer = self._relieve(assignment, judged)
                if self._fewer is None and self.best is None:
                    raise GaveUp(Fact("batteries do not last"))
            return None
        self._start, self._n_refused = assignment, 0
        cost = measure_work(plan)
        is_offered, self._is_offered = self._is_offered, False
        if self.best is not None and (self.best[0], is_offered) < (cost, True):
            return None
        self.best = cost, plan
        return plan

    def _take_offer(self, plan: Plan) -> None:
        """Keep a plan that the first round has on its way, so that there is one at once."""
        cost = measure_work(plan)
        if check(plan).ok and (self.best is None or cost < self.best[0]):
            self.best, self._is_offered = (cost, plan), True
            self._better(plan)

    def _choose_next(self, assignment: Assignment) -> bool:
        """Choose what is planned after an assignment without a plan; return whether there is any.

        First the same with more time, then half of the jobs at a time: a fleet in which nobody
        moves has a plan at last.
        """
        if self._deadline is not self._last_deadline:
            self._deadline, self._fewer = self._last_deadline, assignment
        else:
            self._fewer = self._keep_half(assignment)
        return self._fewer is not None

    def move_jobs(self, deadline: Deadline, better: Callable[[Plan], None]) -> Plan:
        """Return the best plan after moves of jobs."""
        assert self.best is not None, "rounds end with a plan"
        travel = self._delay_travel()
        search = AssignmentSearch(self._work, travel, weights=self._weights, seed=self._seed)
        near = Neighbourhoods(self.best[1], search, travel, self._seed)
        n_jobs = len(self._work.jobs)
        near.run(
            MOVES + MOVES_PER_JOB * n_jobs, PATIENCE + PATIENCE_PER_JOB * n_jobs, deadline, better
        )
        return self._prove(near.plan)

    def _prove(self, plan: Plan) -> Plan:
        """Return a plan with its outcome: the bound of the jobs that it serves.

        It is optimal if no plan serves one of the others, either.
        """
        bound = WorkBound(self._work, self._travel, self._weights)
        unserved = {job for job, _ in plan.unserved}
        served = [job for job in range(len(self._work.jobs)) if job not in unserved]
        objective = OBJECTIVES[self._work.objective]
        proof = Proof(bound=Tick(bound.compute(served)), objective=objective)
        outcome = classify_cost(plan.compute_value(objective), proof)
        if not all(map(bound.is_impossible, unserved)):
            outcome = replace(outcome, kind=OutcomeKind.BEST_FOUND)
        return replace(plan, run=replace(plan.run, outcome=outcome))

    def _delay_travel(self) -> Travel:
        return self._travel.delay(np.rint(self._delays).astype(np.int32), self._drains)

    def _assign(self, number: int) -> Assignment:
        """Return tours for the travel times and delays that are known."""
        search = AssignmentSearch(
            self._work, self._delay_travel(), weights=self._weights, seed=self._seed + number
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
        if whole:
            self._learn_drains(plan, assignment)
        seen: dict[tuple[int, int, int], list[int]] = {}
        for leg, ticks in self._list_delays(plan, assignment):
            seen.setdefault(leg, []).append(ticks)
        for leg, delays in seen.items():
            if whole:
                self._delays[leg] = max(self._delays[leg], *delays)
            else:
                mean = sum(delays) / len(delays)
                self._delays[leg] = MEMORY * self._delays[leg] + (1 - MEMORY) * mean

    def _learn_drains(self, plan: Plan, assignment: Assignment) -> None:
        """Count the charge that legs took with their detours."""
        travel, edge_class = self._travel, plan.scenario.roadmap.class_of_edge
        for robot, tour in enumerate(plan.tours or ()):
            battery = self._work.robots[robot].battery
            if battery is None:
                continue
            kind, at, visit = travel.battery_of[robot], travel.get_start(robot), 0
            scale = travel.batteries[kind].battery.full // battery.full
            vertices = plan.tracks[robot].vertices
            edges = plan.scenario.roadmap.find_edges(vertices[:-1], vertices[1:])
            drains = np.array(battery.drive, np.int64)[edge_class[edges]] * scale
            ends = [
                (item.visit, travel.place_of[wanted.vertex])
                for item, wanted in zip(tour, assignment.tours[robot], strict=False)
            ]
            home = self._work.robots[robot].home
            if home is not None:
                ends.append((len(vertices) - 1, travel.place_of[home]))
            for end, to in ends:
                more = int(drains[visit:end].sum()) - int(travel.batteries[kind].drives[at, to])
                self._drains[kind][at, to] = max(self._drains[kind][at, to], more)
                at, visit = to, end

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

    def _relieve(self, assignment: Assignment, judged: Report) -> Assignment | None:
        """Return an assignment in which robots with faults need less charge; None if none is left.

        They lose their last job, or charge if they have none. Where neither is possible, others
        have fewer jobs, so that robots need not make room for them.
        """
        last, charges = dict[int, int](), dict[int, TourItem]()
        for robot in {robot for fault in judged.faults for robot in fault.robots}:
            for item in assignment.tours[robot]:
                if item.job is not None and self._work.jobs[item.job].begun_by is None:
                    last[robot] = item.job
            charge = None if assignment.tours[robot] else self._make_charge(robot)
            if charge is not None:
                charges[robot] = charge
        if not last and not charges:
            return self._keep_half(assignment)
        tours = tuple(
            (charges[robot],) if robot in charges else tour
            for robot, tour in enumerate(assignment.tours)
        )
        return self._drop_jobs(replace(assignment, tours=tours), last.values())

    def _make_charge(self, robot: int) -> TourItem | None:
        """Return a full charge of a robot, at the place that it reaches first; None without one."""
        travel, own = self._travel, self._work.robots[robot]
        if own.battery is None or not own.battery.charge:
            return None
        start, ticks = travel.get_start(robot), travel.ticks[travel.kind_of[robot]]
        places = [travel.place_of[vertex] for vertex in own.charging]
        reached = [place for place in places if ticks[start, place] >= 0]
        if not reached:
            return None
        nearest = min(reached, key=lambda place: (int(ticks[start, place]), place))
        lasts = -(-(own.battery.full - own.battery.soc) // own.battery.charge)
        return TourItem(job=None, stop=None, vertex=travel.vertices[nearest], duration=Tick(lasts))

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
