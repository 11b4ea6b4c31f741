"""Entries of a journal on jobs: those of a scenario, and what people change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Any

from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.control.work_items import find_stop
from rightofway.dispatch import Round
from rightofway.dispatch.pool import JobEnd, PoolEvent
from rightofway.execution.drive_result import DrivenEnd
from rightofway.model import Job, Plan, Scenario, Tick

__all__ = [
    "list_driven_jobs",
    "list_driven_ways",
    "list_job_ends",
    "list_known_jobs",
    "list_planned_ends",
]


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


def list_driven_jobs(ledger: Ledger, scenario: Scenario, now: Tick) -> tuple[DrivenEnd, ...]:
    """Return the jobs that are done, in the order of their ends, and those that are open.

    A job is expected to end as in the latest plan that has it, and as much later as the next open
    job of its robot is overdue. Ends that are not noted yet are those of the present moment.

    Parameters
    ----------
    ledger
        Has the pool and the routes.
    scenario
        The scenario of the plan.
    now
        The time since the run began [ticks].
    """
    count, pool, robots = scenario.problem.clock.count_ticks, ledger.pool, _map_robots(ledger)
    overdue = dict[int | None, int]()
    for name, own in pool.jobs.items():
        robot, expected = robots.get(name), now if own.expected is None else own.expected
        overdue[robot] = max(overdue.get(robot, 0), now - expected)

    def make_end(name: str, robot: int | None, job: Job | JobEnd, **times: Any) -> DrivenEnd:
        due = None if job.due is None else count(job.due)
        return DrivenEnd(name=name, robot=robot, earliest=count(job.earliest), due=due, **times)

    done = (
        make_end(name, end.robot, end, planned=end.planned, ended=now if end.at is None else end.at)
        for name, end in pool.ends.items()
    )
    open_ones = (
        make_end(
            name,
            robot := robots.get(name),
            own.job,
            planned=own.planned,
            expected=None if own.expected is None else Tick(own.expected + overdue[robot]),
        )
        for name, own in pool.jobs.items()
    )
    return (*done, *open_ones)


def _map_robots(ledger: Ledger) -> dict[str, int]:
    """Return the robot of each open job, as far as it is begun or on a route, by name."""
    robots = {name: own.robot for name, own in ledger.pool.jobs.items() if own.robot is not None}
    for robot, own in enumerate(ledger.robots):
        if not own.is_off:
            for name, _ in filter(None, map(find_stop, own.route.all_jobs)):
                robots.setdefault(name, robot)
    return robots


def list_driven_ways(
    plan: Plan,
    ledger: Ledger,
    since: Sequence[float],
    ends: Mapping[int, Tick],
    now: Tick,
) -> tuple[DrivenEnd, ...]:
    """Return the ways of robots of a plan without jobs.

    A robot is expected to end its way as much later than planned as it is late now.

    Parameters
    ----------
    plan
        The plan.
    ledger
        Has the routes.
    since
        When each robot arrived where it is [ticks].
    ends
        When robots came to the ends of their ways [ticks], by index.
    now
        The time since the run began [ticks].
    """

    def find_delay(robot: int) -> int:
        track, arrived = plan.tracks[robot], ledger.robots[robot].arrived
        if ledger.robots[robot].route.end != len(track):  # a person has changed its work
            return 0
        late = int(since[robot]) - int(track.enter[arrived])
        if arrived + 1 < len(track):
            late = max(late, now - int(track.enter[arrived + 1]))
        return max(0, late)

    return tuple(
        DrivenEnd(
            name=name,
            robot=robot,
            planned=planned,
            ended=ends.get(robot),
            expected=None if robot in ends else max(now, Tick(planned + find_delay(robot))),
        )
        for robot, (name, planned) in enumerate(zip(ledger.names, plan.completions, strict=True))
    )
