"""Neighbourhoods of tours and routes together: jobs move, and few robots are planned again.

A neighbour of a plan has few jobs at other places of the same or of other tours, or the tails of
two tours exchanged. The routes of the robots concerned are removed and planned again around the
bookings of all others (``cpp/tours/routed_moves.hpp``). The neighbour becomes the plan if its
planned cost is less: travel times, which know no other robots, only choose the neighbours.

References
----------
Ropke & Pisinger, *An adaptive large neighborhood search heuristic for the pickup and delivery
problem with time windows*, Transportation Science 2006 (removal and insertion of jobs).

Li, Chen, Harabor, Stuckey & Koenig, *Anytime multi-agent path finding via large neighborhood
search*, IJCAI 2021 (replanning of few robots).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.assign import AssignmentSearch, Travel
from rightofway.check import check
from rightofway.deadline import Deadline
from rightofway.metrics import derive_outcome
from rightofway.model import Plan, Scenario, Tick, Track, Work
from rightofway.model.passing import wait_before_chains
from rightofway.model.scenario import assign_tours
from rightofway.model.stays import find_stays
from rightofway.model.work import Assignment, Tour, TourItem, UnservedReason
from rightofway.native.problem import scale_costs
from rightofway.plan_work.cost import measure_work
from rightofway.search import FleetSearch, compute_least_completions

MOST_TIMES_LARGER = 3
"""A tour may cost that many times more for each tick than the one that costs most now."""


class Neighbourhoods:
    """A local search from a judged plan.

    Parameters
    ----------
    plan
        A plan with tours that the judge has passed.
    search
        The search for tours, whose best assignment is that of the plan.
    travel
        The places of that search.
    seed
        For all that is drawn.

    Attributes
    ----------
    plan, cost
        The best plan, which the judge has passed, and its cost.
    """

    def __init__(self, plan: Plan, search: AssignmentSearch, travel: Travel, seed: int) -> None:
        self.plan, self.cost = plan, measure_work(plan)
        self._search, self._travel, self._seed = search, travel, seed

    def run(
        self, tries: int, patience: int, deadline: Deadline, better: Callable[[Plan], None]
    ) -> None:
        """Try neighbours.

        ``tries`` and ``patience`` are the most neighbours, and the most in a row without a gain;
        ``better`` takes each better plan.
        """
        work = self.plan.scenario.problem.work
        assert work is not None, "the plan has jobs"
        # Waiting may empty a battery, so the judge sees each gain.
        most_gains = 1 if any(robot.battery for robot in work.robots) else tries
        moves, gains, idle = self._make_moves(work), 0, 0
        while tries > 0 and idle < patience and deadline.measure_seconds_left() != 0:
            done = moves.run(tries, most_gains, deadline.measure_seconds_left())
            tries -= max(1, done)
            idle += done
            if moves.n_gains == gains:
                continue
            gains = moves.n_gains
            if self._adopt(moves):
                idle = 0
                better(self.plan)
            else:
                moves, gains = self._make_moves(work), 0

    def _make_moves(self, work: Work) -> _core.RoutedMoves:
        """Return the search in the native core, from the best plan."""
        return _core.RoutedMoves(**self.make_arguments(work))

    def make_arguments(self, work: Work) -> dict[str, Any]:
        """Return the arguments of that search; ``work`` are the jobs of the plan."""
        scenario = assign_tours(self.plan.scenario, self._list_tours())
        problem = replace(scenario.problem, after=())  # the tours know which jobs follow others
        fleet = FleetSearch(problem, seed=self._seed, threads=1)
        fleet.start(self.plan.tracks)
        self._search.start(Assignment(tours=scenario.tours or ()))
        stays = find_stays(scenario, self.plan.tracks)
        stops, ends = list[int](), list[Tick]()
        for tour, stay in zip(scenario.tours or (), stays, strict=True):
            stops += [
                -1
                if item.job is None or item.stop is None
                else self._search.find_number(item.job, item.stop)
                for item in tour
            ]
            ends += [*stay.ends[: len(tour)]]
            stops.append(-1)
            ends.append(stay.completion)
        self._seed += 1
        cost, late_cost = _scale_jobs(work, scenario.tours or ())
        return {
            "fleet": fleet.native,
            "tours": self._search.native,
            "vertex_of": np.array(self._travel.vertices, np.int32),
            "turn_of": np.array([robot.turn for robot in work.robots], np.int64),
            "stops": np.array(stops, np.int32),
            "ends": np.array(ends, np.int64),
            "completions": np.array([stay.completion for stay in stays], np.int64),
            "cost": cost,
            "late_cost": late_cost,
            "seed": self._seed,
        }

    def _adopt(self, moves: _core.RoutedMoves) -> bool:
        """Take over the plan of moves if the judge passes it and it costs less."""
        scenario = assign_tours(self.plan.scenario, self._read_tours(moves))
        first, vertices, enter = moves.tracks()
        tracks = [Track(vertices=vertices[a:b], enter=enter[a:b]) for a, b in pairwise(first)]
        plan = _make_plan(self.plan, scenario, tracks)
        cost = measure_work(plan)
        if cost >= self.cost or not check(plan).ok:
            return False
        self.plan, self.cost = plan, cost
        return True

    def _list_tours(self) -> list[Tour]:
        """Return the tours of the plan, without vertices where robots rest that end anywhere."""
        tours = self.plan.scenario.tours
        assert tours is not None, "the plan has tours"
        return [
            tour[:-1] if tour and tour[-1].job is None and not tour[-1].duration else tour
            for tour in tours
        ]

    def _read_tours(self, moves: _core.RoutedMoves) -> list[Tour]:
        """Return all tours, with those that have changed."""
        tours = self._list_tours()
        robots, first, stops, vertices, ticks = (array.tolist() for array in moves.items())
        for robot, (begin, end) in zip(robots, pairwise(first), strict=True):
            items = list[TourItem]()
            for k in range(begin, end):
                job, stop = (None, None) if stops[k] < 0 else self._search.find_item(stops[k])
                items.append(
                    TourItem(job=job, stop=stop, vertex=vertices[k], duration=Tick(ticks[k]))
                )
            tours[robot] = tuple(items)
        return tours


def _scale_jobs(work: Work, tours: Sequence[Tour]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the cost of a tick of the end of each job in searches; empty without service."""
    if work.objective != "service" or not work.jobs:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    exact = [(job.weight, job.weight * work.late * (job.due is not None)) for job in work.jobs]
    slopes = [cost + late for cost, late in exact]
    largest = max(
        (sum(slopes[job] for job in {item.job for item in tour} if job is not None))
        for tour in tours
    )
    slope = min(sum(slopes), MOST_TIMES_LARGER * max(largest, *slopes))
    return scale_costs(exact, slope, work.late.denominator)


def _make_plan(old: Plan, scenario: Scenario, tracks: Sequence[Track]) -> Plan:
    """Return the plan of other tours and tracks, with the jobs that the tours leave out."""
    alone = compute_least_completions(scenario)
    assert alone is not None, "there is no time limit"
    run = replace(
        old.run,
        alone=tuple(alone.tolist()),
        outcome=None,
        decisions=(),
        reroutes=(),
        forced_losses=(),
    )
    plan = Plan(
        scenario=scenario,
        tracks=wait_before_chains(scenario.problem, tracks),
        run=run,
        unserved=_list_unserved(old, scenario),
    )
    return replace(plan, run=replace(run, outcome=derive_outcome(plan)))


def _list_unserved(plan: Plan, scenario: Scenario) -> tuple[tuple[int, UnservedReason], ...]:
    """Return the jobs that tours leave out, each with the reason that it had, if that holds."""
    reasons = dict(plan.unserved)
    assert scenario.problem.work is not None, "the scenario has jobs"
    jobs = scenario.problem.work.jobs
    unserved = set(range(len(jobs))) - {
        item.job for tour in scenario.tours or () for item in tour if item.job is not None
    }
    for job in unserved:
        if not unserved.isdisjoint(jobs[job].after):
            reasons.setdefault(job, "after")
        elif reasons.get(job, "after") == "after":  # those before it are served now
            reasons[job] = "not found"
    return tuple((job, reasons[job]) for job in sorted(unserved))
