"""Entries of a journal on jobs: those of a scenario, and what people change."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.control.journal import Entry
from rightofway.dispatch.pool import PoolEvent
from rightofway.model import Scenario, Tick

__all__ = ["list_known_jobs"]


def list_known_jobs(scenario: Scenario) -> Iterator[Entry]:
    """Yield entries on the jobs of a scenario, and on their stops that are done at the begin."""
    for job in scenario.jobs or ():
        event = PoolEvent(kind="job known", at=Tick(0), name=job.name, job=job)
        yield event.to_document(scenario.roadmap)
    for number, robot in enumerate(scenario.robots):
        for name, count in robot.start.begun if robot.start else ():
            yield {"kind": "stop done", "at": 0, "name": name, "robot": number, "stop": count - 1}
