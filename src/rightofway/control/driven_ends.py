"""Planned ends of jobs and of ways of robots, next to their actual or expected ends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rightofway.control.ledger import Ledger
from rightofway.control.work_items import find_stop
from rightofway.dispatch.pool import JobEnd
from rightofway.execution.drive_result import (
    DrivenEnd,
    DriveResult,
    Punctuality,
    measure_punctuality,
    sort_latest_first,
)
from rightofway.model import Job, Plan, Scenario, Tick
from rightofway.viz.page.schema import EndRow, EndsData, PunctualityRow

__all__ = ["list_driven_jobs", "list_driven_ways", "make_ends_data"]

MAX_ENDS = 200
"""Jobs that a page lists; the report for programs has all."""

DECIMALS = 2
"""Decimals of a mean delay [ticks]."""


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


def make_ends_data(result: DriveResult, ways: tuple[DrivenEnd, ...]) -> EndsData | None:
    """Return planned and actual ends for a page, the latest first; None of laps.

    Parameters
    ----------
    result
        The run.
    ways
        The ways of robots, for a plan without jobs.
    """
    if result.completion is None:
        return None
    has_jobs = result.plan.scenario.jobs is not None
    ends = result.ends if has_jobs else ways
    per_robot = [list[DrivenEnd]() for _ in result.jobs if has_jobs]
    for end in ends if has_jobs else ():
        if end.robot is not None:
            per_robot[end.robot].append(end)
    return {
        "hasJobs": has_jobs,
        "all": _make_row(measure_punctuality(ends)),
        "robots": [_make_row(measure_punctuality(own)) for own in per_robot],
        "rows": [_make_end_row(end) for end in sort_latest_first(ends)[:MAX_ENDS]],
    }


def _make_row(measured: Punctuality) -> PunctualityRow:
    delay = None if measured.delay is None else round(float(measured.delay), DECIMALS)
    return measured.done, measured.open, measured.late, delay


def _make_end_row(end: DrivenEnd) -> EndRow:
    robot = -1 if end.robot is None else end.robot
    times = end.planned, end.due, end.ended, end.expected, end.delay
    return end.name, robot, *times, end.is_late
