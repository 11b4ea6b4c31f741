"""The report on a plan that robots have driven."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.execution.drive_result import DrivenJob, DriveResult
from rightofway.model import Tick
from rightofway.report.lines import Facts, Part, Table, lay_out
from rightofway.report.phrases import chain_items, say_count
from rightofway.report.quantities import Quantities

__all__ = ["report_drive"]

MAX_ROBOTS, MAX_JOBS = 20, 20
"""Robots and jobs in the report; --json has them all."""


def report_drive(result: DriveResult, quantities: Quantities) -> str:
    """Return the work done, how much later than planned, and by how many messages.

    Parameters
    ----------
    result
        The run.
    quantities
        How times are written.
    """
    facts = Facts(list(_list_totals(result, quantities)))
    robots, jobs = _make_robots(result, quantities), _make_jobs(result, quantities)
    return lay_out([facts, "", *robots, *jobs])


def _list_totals(result: DriveResult, quantities: Quantities) -> Iterator[tuple[str, str]]:
    yield "jobs", _count_jobs(result)
    if result.completion is None:
        time = quantities.format_duration(result.now)
        yield "laps", f"{sum(result.laps)} in {time}"
    elif None in result.completion:
        ended = sum(completion is not None for completion in result.completion)
        yield (
            "ended",
            "{ended} of {robots} at the end of their way after {time}".format(
                ended=str(ended),
                robots=say_count(len(result.completion), "robot", "robots"),
                time=quantities.format_duration(result.now),
            ),
        )
    else:
        makespan = max(completion or 0 for completion in result.completion)
        text = (
            f"{quantities.format_duration(makespan)}; planned"
            f" {quantities.format_duration(max(result.plan.completions))}"
        )
        yield "makespan", text
    sent = result.messages
    if not sent:
        return
    messages = (
        say_count(sent.get("order", 0), "order", "orders"),
        say_count(sent.get("instantActions", 0), "instant action", "instant actions"),
        say_count(sent.get("state", 0), "state", "states"),
    )
    yield "messages", chain_items(messages)


def _count_jobs(result: DriveResult) -> str:
    """Return how many jobs are done, and how many of those with a due time in time and late."""
    done, late = f"{sum(result.jobs)} done", sum(job.is_late for job in result.ended)
    in_time = sum(job.due is not None for job in result.ended) - late
    return f"{done}, {in_time} in time and {late} late" if in_time + late else done


def _make_jobs(result: DriveResult, quantities: Quantities) -> Iterator[Part]:
    """Yield a table of the jobs that are done, those that ended latest after they were due first.

    Jobs without a due time are compared with the plan.
    """
    if not result.ended:
        return

    def measure_delay(job: DrivenJob) -> int:
        wanted = job.planned if job.due is None else job.due
        return 0 if wanted is None else wanted - job.ended

    def write(tick: Tick | None) -> str:
        return "-" if tick is None else quantities.format_point(tick)

    yield ""
    yield quantities.format_heading("end of each job, the latest first")
    names = [robot.name for robot in result.plan.scenario.robots]
    rows = [
        (job.name, names[job.robot], write(job.planned), write(job.due), write(job.ended))
        for job in sorted(result.ended, key=measure_delay)[:MAX_JOBS]
    ]
    yield Table(("job", "robot", "planned", "due", "actual"), rows)
    if len(result.ended) > MAX_JOBS:
        yield f"… and {say_count(len(result.ended) - MAX_JOBS, 'more job', 'more jobs')}"


def _make_robots(result: DriveResult, quantities: Quantities) -> Iterator[Part]:
    robots = result.plan.scenario.robots
    if result.completion is None:
        yield "laps of each robot"
        headings = ("laps", "mean lap")
        times = [
            (str(laps), quantities.format_cell(round(result.now / laps)) if laps else "-")
            for laps in result.laps
        ]
    else:
        yield quantities.format_heading("completion of each robot")
        headings = ("planned", "actual")
        pairs = zip(result.plan.completions, result.completion, strict=True)
        times = [
            (
                quantities.format_point(planned),
                "-" if actual is None else quantities.format_point(actual),
            )
            for planned, actual in pairs
        ]
    rows = [
        (robots[robot].name, str(result.jobs[robot]), str(result.waits[robot]), *times[robot])
        for robot in range(min(len(robots), MAX_ROBOTS))
    ]
    yield Table(("robot", "jobs", "waits", *headings), rows)
    if len(robots) > MAX_ROBOTS:
        more = say_count(len(robots) - MAX_ROBOTS, "more robot", "more robots")
        yield f"… and {more}"
