"""The jobs of a plan as the page reads them: who does each, why that robot, and the tours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rightofway.assign import JobCost, list_job_costs
from rightofway.facts import Fact
from rightofway.metrics import TourCourse, list_job_times, trace_tours
from rightofway.metrics.tours import Charge
from rightofway.model import Plan
from rightofway.model.work import BoundJob
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import PhraseBook
from rightofway.viz.page.schema import JobCostRow, JobData, JobStopRow, TourData, WorkData

DECIMALS = 4
"""Decimals of a state of charge; a tenth of a thousandth cannot be seen."""

MOST_COSTS = 20_000
"""Jobs times robots up to which costs are compared; more would take seconds."""

SHOWN_ROBOTS = 10
"""Robots that a job is compared on, those of least cost."""


def make_work_data(
    plan: Plan, book: PhraseBook, *, measured: Sequence[Sequence[Charge]] | None = None
) -> WorkData:
    """Return the jobs and tours of a plan whose scenario has jobs.

    With the measured state of charge of robots it is the plan of what they have done: nobody chose
    among all robots then, so jobs are not compared on them.
    """
    work = plan.scenario.problem.work
    assert work is not None, "the scenario has jobs"
    is_small = measured is None and len(work.jobs) * len(work.robots) <= MOST_COSTS
    costs = list_job_costs(plan) if is_small else ()
    return {
        "jobs": _list_jobs(plan, work.jobs, costs, book),
        "tours": [
            _make_tour(plan, robot, course)
            for robot, course in enumerate(trace_tours(plan, measured=measured))
        ],
    }


def _list_jobs(
    plan: Plan,
    bound: Sequence[BoundJob],
    costs: Sequence[Sequence[JobCost]],
    book: PhraseBook,
) -> list[JobData]:
    done = {times.job: times for times in list_job_times(plan)}
    items = {
        (item.job, item.stop): (item.begin, item.end)
        for tour in plan.tours or ()
        for item in tour
        if item.job is not None
    }
    reasons, writer = dict(plan.unserved), FactWriter(plan.scenario)
    jobs = list[JobData]()
    for index, (job, own) in enumerate(zip(plan.scenario.jobs or (), bound, strict=True)):
        stops: list[JobStopRow] = [
            (int(stop.at), stop.load, *items.get((index, place), (-1, -1)))
            for place, stop in enumerate(job.stops)
        ]
        data: JobData = {"name": job.name, "stops": stops}
        if times := done.get(index):
            data["robot"] = times.robot
            data["times"] = (times.begin, times.end, times.service_time, times.late)
        if index in reasons:
            reason = writer.write(Fact(f"unserved {reasons[index]}", plan.scenario))
            data["reason"] = book.add(reason)
        if own.due is not None:
            data["due"] = own.due
        if costs:
            data["costs"] = list(_list_costs(costs[index], data.get("robot")))
        jobs.append(data)
    return jobs


def _list_costs(costs: Sequence[JobCost], robot: int | None) -> Iterator[JobCostRow]:
    """Yield the robots of least cost, and the one that does the job."""
    ranked = sorted(costs, key=lambda cost: (cost.cost is None, cost.cost or 0, cost.robot))
    for place, cost in enumerate(ranked):
        if place < SHOWN_ROBOTS or cost.robot == robot:
            yield cost.robot, None if cost.cost is None else round(cost.cost)


def _make_tour(plan: Plan, robot: int, course: TourCourse) -> TourData:
    work = plan.scenario.problem.work
    assert work is not None, "the scenario has jobs"
    data: TourData = {
        "items": [
            (
                -1 if item.job is None else item.job,
                -1 if item.stop is None else item.stop,
                plan.scenario.roadmap.get_drawn(int(plan.tracks[robot].vertices[item.visit])),
                item.begin,
                item.end,
                load,
            )
            for item, load in zip((plan.tours or ())[robot], course.loads, strict=True)
        ],
        "load": work.robots[robot].load,
        "capacity": work.robots[robot].capacity,
    }
    if course.reserve is not None:
        data["reserve"] = round(float(course.reserve), DECIMALS)
        data["charges"] = [(tick, round(float(soc), DECIMALS)) for tick, soc in course.charges]
    return data
