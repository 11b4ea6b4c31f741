"""The jobs of a plan in words: who does each of them, when and how late; and those nobody does."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any

from rightofway.facts import Fact
from rightofway.metrics import list_job_times, measure
from rightofway.model import Plan
from rightofway.report.lines import Part, Table
from rightofway.report.sentences import Words

MAX_JOBS = 10
"""Jobs that a report lists; --json lists all."""


def list_job_costs(words: Words) -> Iterator[tuple[str, str]]:
    """Yield how many jobs are done, and how long they took; nothing without jobs."""
    plan, metrics = words.plan, measure(words.plan)
    if metrics.service_time is None or metrics.lateness is None:
        return
    n_jobs, n_served = len(plan.scenario.jobs or ()), len(list_job_times(plan))
    yield "jobs", f"{n_served} of {n_jobs} done"
    yield "service time", words.say_time(metrics.service_time)
    if metrics.lateness:
        yield "lateness", words.say_time(metrics.lateness)


def list_jobs(words: Words) -> Iterator[Part]:
    """Yield a table of the first jobs of a plan, and why others are not served."""
    plan, cell = words.plan, words.quantities.format_cell
    jobs, done = plan.scenario.jobs or (), sorted(list_job_times(plan), key=lambda job: job.begin)
    if done:
        yield ""
        yield words.quantities.format_heading("jobs, by their begin")
        rows = [
            [
                jobs[times.job].name,
                words.name_robot(times.robot),
                *map(words.quantities.format_point, (times.begin, times.end)),
                cell(times.late),
            ]
            for times in done[:MAX_JOBS]
        ]
        yield Table(("job", "robot", "begins", "ends", "late"), rows)
    if len(done) > MAX_JOBS:
        yield f"… and {len(done) - MAX_JOBS} more (--json lists all)"
    if plan.unserved:
        yield ""
    for job, reason in islice(plan.unserved, MAX_JOBS):
        yield str(
            Fact("unserved", plan.scenario, job=jobs[job].name, why=Fact(f"unserved {reason}"))
        )
    if len(plan.unserved) > MAX_JOBS:
        yield f"… and {len(plan.unserved) - MAX_JOBS} more that are not served"


def make_jobs_data(plan: Plan) -> dict[str, Any]:
    """Return the jobs of a plan for programs; empty without jobs. Times are in ticks."""
    jobs = plan.scenario.jobs
    if jobs is None:
        return {}
    return {
        "jobs": [
            {
                "name": jobs[times.job].name,
                "robot": plan.scenario.robots[times.robot].name,
                "begin": times.begin,
                "end": times.end,
                "service_time": times.service_time,
                "late": times.late,
            }
            for times in list_job_times(plan)
        ],
        "unserved": [{"job": jobs[job].name, "reason": reason} for job, reason in plan.unserved],
    }
