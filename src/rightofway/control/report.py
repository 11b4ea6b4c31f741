"""The report on a plan that simulated robots have driven."""

from __future__ import annotations

from collections.abc import Iterator

from rightofway.control.demo import DemoResult
from rightofway.quantities import Quantities
from rightofway.report.lines import counted, row, short

__all__ = ["report"]

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""


def report(result: DemoResult, quantities: Quantities) -> str:
    """Return what was done, how much later than planned, and by how many messages.

    Parameters
    ----------
    result
        The run.
    quantities
        How times are written.
    """
    return "\n".join([*_totals(result, quantities), "", *_robots(result, quantities)])


def _totals(result: DemoResult, quantities: Quantities) -> Iterator[str]:
    sent = result.messages
    actions = counted(sent.get("instantActions", 0), "instant action")
    messages = f"{counted(sent['order'], 'order')}, {actions}, {counted(sent['state'], 'state')}"
    yield row("jobs", f"{sum(result.jobs)} done", 10)
    if result.trace is None:
        time = quantities.duration(result.now)
        yield row("laps", f"{sum(result.laps)} in {time}", 10)
    else:
        planned = quantities.duration(max(result.plan.completions))
        makespan = max(completion or 0 for completion in result.trace.completion)
        yield row("makespan", f"{quantities.duration(makespan)}; planned {planned}", 10)
    yield row("messages", messages, 10)


def _robots(result: DemoResult, quantities: Quantities) -> Iterator[str]:
    robots = result.plan.scenario.robots
    if result.trace is None:
        yield "laps of each robot"
        cells = [("robot", "jobs", "waits", "laps", "mean lap")]
        times = [
            (str(laps), quantities.cell(round(result.now / laps)) if laps else "-")
            for laps in result.laps
        ]
    else:
        yield quantities.heading("completion of each robot")
        cells = [("robot", "jobs", "waits", "planned", "actual")]
        pairs = zip(result.plan.completions, result.trace.completion, strict=True)
        times = [
            (quantities.cell(planned), quantities.cell(actual or 0)) for planned, actual in pairs
        ]
    for robot in range(min(len(robots), MAX_ROBOTS)):
        counts = (str(result.jobs[robot]), str(result.waits[robot]))
        cells.append((short(robots[robot].name), *counts, *times[robot]))
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for name, *others in cells:
        right = (f"{cell:>{width}}" for cell, width in zip(others, widths[1:], strict=True))
        yield "  ".join((f"{name:{widths[0]}}", *right))
    if len(robots) > MAX_ROBOTS:
        yield f"… and {counted(len(robots) - MAX_ROBOTS, 'more robot')}"
