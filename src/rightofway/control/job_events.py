"""Entries of a journal on jobs: those of a scenario, and what people change."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.dispatch import Round
from rightofway.dispatch.pool import PoolEvent
from rightofway.model import Plan, Scenario, Tick

__all__ = ["list_job_ends", "list_known_jobs", "list_planned_ends"]


def list_known_jobs(plan: Plan) -> Iterator[Entry]:
    """Yield entries on the jobs of a plan, their planned ends and stops done at the begin."""
    scenario = plan.scenario
    jobs = scenario.jobs or ()
    for job in jobs:
        event = PoolEvent(kind="job known", at=Tick(0), name=job.name, job=job)
        yield event.to_document(scenario.roadmap)
    for number, robot in enumerate(scenario.robots):
        for name, count in robot.start.begun if robot.start else ():
            yield {"kind": "stop done", "at": 0, "name": name, "robot": number, "stop": count - 1}
    for tour in plan.tours or ():
        ends = {jobs[item.job].name: item.end for item in tour if item.job is not None}
        for name, end in ends.items():  # of the last stop of each
            event = PoolEvent(kind="job planned", at=Tick(0), name=name, end=end)
            yield event.to_document(scenario.roadmap)


def list_planned_ends(ledger: Ledger, planned: Round, takeover: Tick) -> Iterator[Entry]:
    """Yield entries on the jobs whose ends a round has planned for another time than before.

    Parameters
    ----------
    ledger
        Has the pool.
    planned
        The round.
    takeover
        When it takes over [ticks].
    """
    for step in chain.from_iterable(planned.steps):
        own = ledger.pool.jobs.get(step.job or "")
        if own is None or step.stop != len(own.job.stops) - 1:
            continue
        end = Tick(takeover + step.end)
        if end != own.expected:
            event = PoolEvent(kind="job planned", at=takeover, name=own.job.name, end=end)
            yield event.to_document(ledger.roadmap)


def list_job_ends(ledger: Ledger, now: int, scenario: Scenario) -> Iterator[Entry]:
    """Yield entries with the present time for jobs that have ended since the last call."""
    for name in sorted(ledger.pool.unnoted):
        event = PoolEvent(kind="job ended", at=Tick(now), name=name)
        yield event.to_document(scenario.roadmap)
