"""The report on a plan that robots have driven."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.execution.drive_result import DriveResult, measure_punctuality, sort_latest_first
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
    delay = measure_punctuality(result.ends).delay
    if delay is not None:
        direction = "later" if delay >= 0 else "earlier"
        time = quantities.format_duration(abs(delay))
        yield "delay", f"{time} {direction} than planned on average"
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
    """Return how many jobs are done, in time and late, and how many are open."""
    done = f"{sum(result.jobs)} done"
    if not result.ends:
        return done
    ended = [end for end in result.ends if end.ended is not None]
    late = sum(end.is_late for end in ended)
    text = f"{done}, {len(ended) - late} in time and {late} late"
    n_open = len(result.ends) - len(ended)
    return f"{text}; {n_open} open" if n_open else text


def _make_jobs(result: DriveResult, quantities: Quantities) -> Iterator[Part]:
    """Yield a table of jobs: those that end latest after they were due or planned, then others."""
    if not result.ends:
        return

    def write(tick: Tick | None) -> str:
        return "-" if tick is None else quantities.format_point(tick)

    yield ""
    yield quantities.format_heading("end of each job, the latest first")
    names = [robot.name for robot in result.plan.scenario.robots]
    ends = sort_latest_first(result.ends)[:MAX_JOBS]
    has_open = any(end.ended is None for end in result.ends)
    rows = [
        (
            end.name,
            "-" if end.robot is None else names[end.robot],
            *map(write, (end.planned, end.due, end.ended)),
            *([write(end.expected)] if has_open else []),
        )
        for end in ends
    ]
    expected = ("expected",) if has_open else ()
    yield Table(("job", "robot", "planned", "due", "actual", *expected), rows)
    if len(result.ends) > MAX_JOBS:
        yield f"… and {say_count(len(result.ends) - MAX_JOBS, 'more job', 'more jobs')}"


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
