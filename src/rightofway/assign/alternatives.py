"""Why a robot does a job: the cost of the job on each robot that may do it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from rightofway.assign.tours import AssignmentSearch
from rightofway.assign.travel import measure_travel
from rightofway.model import Plan, Tick
from rightofway.model.work import Assignment, Tour, TourItem, Work
from rightofway.search import Distances

__all__ = ["JobCost", "list_job_costs"]


@dataclass(frozen=True, slots=True, kw_only=True)
class JobCost:
    """The cost that a job adds to the objective on one robot.

    Attributes
    ----------
    robot
        Index of the robot.
    cost
        The growth of the objective with the job at its best place in the tour of the robot,
        compared with the tours without the job [ticks; of a job or a robot of weight 1]; None if it
        fits nowhere.
    """

    robot: int
    cost: Fraction | None


def list_job_costs(plan: Plan) -> tuple[tuple[JobCost, ...], ...]:
    """Return the cost of each job on each robot that may do it, in the order of robots.

    Parameters
    ----------
    plan
        A plan; empty without jobs.

    Notes
    -----
    All other jobs stay where they are in the tours of the plan; jobs that come after the job do not
    count. Robots do not wait for each other here: costs are those of their travel times alone.
    """
    scenario = plan.scenario
    work = scenario.problem.work
    if work is None:
        return ()
    travel = measure_travel(scenario.problem, Distances(scenario.roadmap))
    search = AssignmentSearch(work, travel, weights=scenario.problem.weights)
    search.start(Assignment(tours=tuple(_list_tours(plan, work))))
    return tuple(tuple(_list_costs(search, plan, work, job)) for job in range(len(work.jobs)))


def _list_tours(plan: Plan, work: Work) -> Iterator[Tour]:
    """Yield the stops of each robot, in order; charges are planned again."""
    for tour in plan.tours or ():
        yield tuple(
            TourItem(
                job=item.job,
                stop=item.stop,
                vertex=work.jobs[item.job].stops[item.stop - work.jobs[item.job].first].vertex,
                duration=Tick(item.end - item.begin),
            )
            for item in tour
            if item.job is not None and item.stop is not None
        )


def _list_costs(search: AssignmentSearch, plan: Plan, work: Work, job: int) -> Iterator[JobCost]:
    values, without = search.compare_robots(job)
    unit = _measure_unit(plan, work, job)
    for robot in work.jobs[job].robots:
        value = values[robot]
        yield JobCost(robot=robot, cost=None if value is None else (value - without) / unit)


def _measure_unit(plan: Plan, work: Work, job: int) -> Fraction:
    """Return what a tick costs of a job or a robot of weight 1."""
    robots, jobs = plan.scenario.robots, plan.scenario.jobs
    assert jobs is not None, "the scenario has jobs"
    match work.objective:
        case "service":
            return work.late.denominator * work.jobs[job].weight / jobs[job].weight
        case "flowtime" | "both":
            return plan.scenario.problem.weights[0] / robots[0].weight
        case "makespan":
            return Fraction(1)
