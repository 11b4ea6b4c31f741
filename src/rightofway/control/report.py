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
    planned, sent = max(result.plan.completions), result.messages
    makespan = max(completion or 0 for completion in result.trace.completion)
    actions = counted(sent.get("instantActions", 0), "instant action")
    messages = f"{counted(sent['order'], 'order')}, {actions}, {counted(sent['state'], 'state')}"
    yield row("jobs", f"{sum(result.jobs)} done", 10)
    yield row(
        "makespan", f"{quantities.duration(makespan)}; planned {quantities.duration(planned)}", 10
    )
    yield row("messages", messages, 10)


def _robots(result: DemoResult, quantities: Quantities) -> Iterator[str]:
    robots = result.plan.scenario.robots
    cells = [("robot", "jobs", "waits", "planned", "actual")]
    for robot in range(min(len(robots), MAX_ROBOTS)):
        name = short(robots[robot].name)
        times = (result.plan.completions[robot], result.trace.completion[robot] or 0)
        counts = (str(result.jobs[robot]), str(result.waits[robot]))
        cells.append((name, *counts, quantities.cell(times[0]), quantities.cell(times[1])))
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    yield quantities.heading("completion of each robot")
    for name, *others in cells:
        right = (f"{cell:>{width}}" for cell, width in zip(others, widths[1:], strict=True))
        yield "  ".join((f"{name:{widths[0]}}", *right))
    if len(robots) > MAX_ROBOTS:
        yield f"… and {counted(len(robots) - MAX_ROBOTS, 'more robot')}"
