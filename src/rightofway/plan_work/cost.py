"""The objective of plans with jobs: unserved weight, the value of the work, and the flowtime."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from rightofway.metrics import list_job_times
from rightofway.model import Objective, Plan, Scenario, Tick, Track, compute_cost
from rightofway.model.stays import find_stays
from rightofway.model.work import Work


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
    """Return the objective of a plan with jobs.

    Parameters
    ----------
    plan
        A plan with tours that keeps the rules.
    """
    work = _get_work(plan.scenario)
    done = [(job.job, job.end) for job in list_job_times(plan)]
    return _measure(plan.scenario, work, plan.tracks, done, plan.completions)


def measure_tracks(scenario: Scenario, tracks: Sequence[Track]) -> WorkCost:
    """Return the objective of tracks that follow the tours of a scenario."""
    work, tours = _get_work(scenario), scenario.tours
    assert tours is not None, "the scenario has tours"
    done, completions = dict[int, Tick](), list[Tick]()
    for tour, stay in zip(tours, find_stays(scenario, tracks), strict=True):
        completions.append(stay.completion)
        for item, end in zip(tour, stay.ends, strict=False):
            if item.job is not None:
                done[item.job] = end
    return _measure(scenario, work, tracks, done.items(), completions)


def _get_work(scenario: Scenario) -> Work:
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    return work


def _measure(
    scenario: Scenario,
    work: Work,
    tracks: Sequence[Track],
    done: Iterable[tuple[int, Tick]],
    completions: Sequence[Tick],
) -> WorkCost:
    """Return the objective by the ends of the served jobs and the completions of robots."""
    ends, weights = dict(done), scenario.problem.weights
    return WorkCost(
        unserved=sum(job.weight for k, job in enumerate(work.jobs) if k not in ends),
        value=_measure_value(work, ends, completions, weights),
        cost=compute_cost(scenario, tracks)
        if scenario.roadmap.has_surcharges
        else int(np.dot(weights, completions)),
    )


def _measure_value(
    work: Work, ends: dict[int, Tick], completions: Sequence[Tick], weights: Sequence[int]
) -> Fraction:
    match work.objective:
        case "service":
            times = delays = 0
            for number, end in ends.items():
                job = work.jobs[number]
                times += job.weight * (end - job.earliest)
                delays += 0 if job.due is None else job.weight * max(0, end - job.due)
            return times + work.late * delays
        case "flowtime":
            return Fraction(sum(completions))
        case "makespan":
            return Fraction(max(completions))
        case "both":
            return Fraction(Objective.BOTH.compute_values(weights, completions)[0])
