"""The jobs of a plan: which robot does each of them, from when until when, and how late."""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.model import Plan, Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class JobTimes:
    """The begin and the end of a job.

    Attributes
    ----------
    job, robot
        Their indices.
    begin, end
        When the work at its first stop begins, of those that are left, and at its last one ends
        [ticks].
    service_time
        From its `earliest` until its end [ticks].
    late
        The time from its `due` to its end [ticks], 0 if it is in time or has none.
    """

    job: int
    robot: int
    begin: Tick
    end: Tick
    service_time: Tick
    late: Tick


def list_job_times(plan: Plan) -> tuple[JobTimes, ...]:
    """Return the times of each served job of a plan, in the order of the scenario's jobs.

    Parameters
    ----------
    plan
        A plan; empty without jobs.
    """
    work = plan.scenario.problem.work
    if work is None:
        return ()
    done: dict[int, tuple[int, int, int]] = {}
    for robot, tour in enumerate(plan.tours or ()):
        for item in tour:
            if item.job is not None:
                _, begin, end = done.get(item.job, (robot, item.begin, item.end))
                done[item.job] = robot, min(begin, item.begin), max(end, item.end)
    return tuple(
        JobTimes(
            job=job,
            robot=robot,
            begin=Tick(begin),
            end=Tick(end),
            service_time=Tick(end - work.jobs[job].earliest),
            late=_measure_late(end, work.jobs[job].due),
        )
        for job, (robot, begin, end) in sorted(done.items())
    )


def _measure_late(end: int, due: Tick | None) -> Tick:
    return Tick(0 if due is None else max(0, end - due))
