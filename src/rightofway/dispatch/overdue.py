"""Overdue jobs first: each is assigned so that those before it are not delayed.

The objective `service` alone may starve a distant job, because nearer ones cost less and come again
and again. So the tours of a round are made in steps. First the begun jobs and the oldest overdue
job get tours in which that job ends as early as it can, then the next oldest one, and so on; then
all others. The end that a step has found for its job is its `latest` in all later steps, so what is
assigned after it never delays it. Only the search for tours knows that; planners get the true
`latest`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.assign import AssignmentSearch, Travel
from rightofway.deadline import Deadline
from rightofway.model import Assignment, Tick, Work

__all__ = ["assign_overdue", "has_choice"]

MOST_OVERDUE = 10
"""Overdue jobs of a round that are assigned one after another; the others follow together."""

FIRST = 1000
"""The weight of a tick of the job in turn, compared with one of another job."""

STEPS = 20
"""Steps of the search for tours, for each job that has its turn or had it before."""


def assign_overdue(
    work: Work,
    travel: Travel,
    old: Assignment,
    overdue: Sequence[int],
    *,
    weights: Sequence[int],
    deadline: Deadline,
) -> tuple[Work, Assignment]:
    """Return the work in which overdue jobs end no later than they can, and tours that keep that.

    Parameters
    ----------
    work, travel
        The work of the round, and its travel times.
    old
        The tours to start from.
    overdue
        Indices of overdue jobs that no robot has begun, the oldest first.
    weights
        The weights of the robots.
    deadline
        When to stop: then the jobs that are left have no `latest` of their own.
    """
    taken: set[int | None] = {
        index for index, job in enumerate(work.jobs) if job.begun_by is not None
    }
    best = _keep_jobs(old, taken)
    for index in overdue[:MOST_OVERDUE]:
        if deadline.measure_seconds_left() == 0:
            break
        taken |= {index, *_list_before(work, index)}
        urgent = _put_first(work, index, taken)
        search = AssignmentSearch(urgent, travel, weights=weights)
        search.start(best)
        search.construct(deadline.measure_seconds_left())
        search.improve(STEPS * len(taken), deadline.measure_seconds_left())
        best = search.assignment
        for tour, ends in zip(best.tours, search.list_ends(), strict=True):
            own = [end for item, end in zip(tour, ends, strict=True) if item.job == index]
            work = _limit_end(work, index, own[-1]) if own else work
    return work, _add_others(best, old, taken)


def _put_first(work: Work, index: int, taken: set[int | None]) -> Work:
    """Return the work of some jobs, in which the end of one counts more than all other ends."""
    jobs = (
        replace(job, weight=FIRST if number == index else 1)
        if number in taken
        else replace(job, robots=(), after=())
        for number, job in enumerate(work.jobs)
    )
    return replace(work, jobs=tuple(jobs), objective="service", late=Fraction(0))


def _add_others(best: Assignment, old: Assignment, taken: set[int | None]) -> Assignment:
    """Return tours with the other jobs of old tours at their ends."""
    others = _keep_jobs(old, {item.job for tour in old.tours for item in tour} - taken)
    tours = (own + more for own, more in zip(best.tours, others.tours, strict=True))
    return Assignment(tours=tuple(tours))


def _list_before(work: Work, index: int) -> set[int]:
    """Return the jobs that end before a job begins, directly or not."""
    before, front = set[int](), [index]
    while front:
        more = set(work.jobs[front.pop()].after) - before
        before |= more
        front.extend(more)
    return before


def _keep_jobs(assignment: Assignment, jobs: set[int | None]) -> Assignment:
    tours = (tuple(item for item in tour if item.job in jobs) for tour in assignment.tours)
    return Assignment(tours=tuple(tours))


def _limit_end(work: Work, index: int, end: Tick) -> Work:
    """Return work in which a job ends by a tick."""
    job = work.jobs[index]
    last = replace(job.stops[-1], latest=end)
    jobs = list(work.jobs)
    jobs[index] = replace(job, stops=(*job.stops[:-1], last))
    return replace(work, jobs=tuple(jobs))


def has_choice(work: Work) -> bool:
    """Return whether some robot has several jobs, or some job several robots."""
    robots = [job.robots for job in work.jobs]
    return any(len(own) > 1 for own in robots) or len(set(robots)) < len(robots)
