"""Entries of a journal on jobs: those of a scenario, and what people change."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.dispatch.pool import PoolEvent
from rightofway.execution.drive_result import DrivenJob
from rightofway.model import Plan, Scenario, Tick

__all__ = ["list_driven_jobs", "list_job_ends", "list_known_jobs"]


def list_known_jobs(scenario: Scenario) -> Iterator[Entry]:
    """Yield entries on the jobs of a scenario, and on their stops that are done at the begin."""
    for job in scenario.jobs or ():
        event = PoolEvent(kind="job known", at=Tick(0), name=job.name, job=job)
        yield event.to_document(scenario.roadmap)
    for number, robot in enumerate(scenario.robots):
        for name, count in robot.start.begun if robot.start else ():
            yield {"kind": "stop done", "at": 0, "name": name, "robot": number, "stop": count - 1}


def list_job_ends(ledger: Ledger, now: int, scenario: Scenario) -> Iterator[Entry]:
    """Yield entries with the present time for jobs that have ended since the last call."""
    for name in sorted(ledger.pool.unnoted):
        event = PoolEvent(kind="job ended", at=Tick(now), name=name)
        yield event.to_document(scenario.roadmap)


def list_driven_jobs(plan: Plan, ledger: Ledger, now: Tick) -> tuple[DrivenJob, ...]:
    """Return the jobs that are done, in the order of their ends, with the times of the plan.

    Ends that are not noted yet are those of the present moment.
    """
    jobs, count = plan.scenario.jobs or (), plan.scenario.problem.clock.count_ticks
    planned = dict[str, Tick]()
    for tour in plan.tours or ():
        planned |= {jobs[item.job].name: item.end for item in tour if item.job is not None}
    return tuple(
        DrivenJob(
            name=name,
            robot=end.robot,
            earliest=count(end.earliest),
            due=None if end.due is None else count(end.due),
            planned=planned.get(name),
            ended=now if end.at is None else end.at,
        )
        for name, end in ledger.pool.ends.items()
    )
