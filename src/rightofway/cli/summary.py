"""What a person, or a program, wants to know of a plan first."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from rightofway.cli.words import COLUMNS, names_of, ticks, wrapped
from rightofway.metrics import Metrics, Wait, measure, waits
from rightofway.model import Plan

__all__ = ["MOST_LINES", "short", "summary", "summary_data"]

MOST_LINES = 20
"""Longer lists end with how many more there are; --json has them all."""

MOST_OF_NAME = 40
"""Columns that a robot's name may take."""


def summary(plan: Plan) -> str:
    """Return the costs of a plan, who loses how much time, and for whom; for people."""
    metrics, found = measure(plan), waits(plan)
    robots = _robots(plan, metrics, found)
    return "\n".join([*_head(plan, metrics), "", *robots, *_waits(plan, found)])


def summary_data(plan: Plan) -> dict[str, Any]:
    """Return the same for programs, the planner as in a plan file; times in ticks."""
    metrics, names, place, run = measure(plan), names_of(plan), plan.scenario.roadmap.name, plan.run
    found = waits(plan)
    rows = zip(names, metrics.completions, metrics.alone, _waiting(plan, found), strict=True)
    return {
        "planner": {
            "name": run.name,
            "options": dict(run.options),
            "seed": run.seed,
            "status": run.status,
        },
        "tick": str(plan.scenario.problem.clock.tick),
        "metrics": {**metrics.as_dict(), "gap": round(metrics.gap, 6)},
        "robots": [
            {"name": name, "completion": completion, "alone": alone, "waiting": waiting}
            for name, completion, alone, waiting in rows
        ],
        "waits": [
            {
                "robot": names[wait.robot],
                "vertex": place(wait.vertex),
                "tick": wait.tick,
                "ticks": wait.ticks,
                "for": None if wait.for_robot is None else names[wait.for_robot],
            }
            for wait in found
        ],
        "rerouted": [names[reroute.robot] for reroute in run.reroutes],
    }


def _head(plan: Plan, metrics: Metrics) -> Iterator[str]:
    tick = plan.scenario.problem.clock.tick
    above = f"{metrics.gap:.1%} above the lower bound {metrics.lower_bound}"
    rows = [
        ("planner", f"{plan.run.name}: {plan.run.status}"),
        ("flowtime", f"{_long(metrics.flowtime, tick)}, {above}"),
        ("makespan", _long(metrics.makespan, tick)),
        ("waiting", _long(metrics.waiting, tick)),
    ]
    for key, text in rows:
        yield _row(key, text)


def _row(key: str, text: str) -> str:
    short = textwrap.shorten(text, 4 * COLUMNS, placeholder=" …")
    return textwrap.fill(short, COLUMNS, initial_indent=f"{key:10}", subsequent_indent=" " * 10)


def _long(number: int, tick: Fraction) -> str:
    return ticks(number) if tick == 1 else f"{ticks(number)} = {number * tick} time units"


def _waiting(plan: Plan, found: Sequence[Wait]) -> list[int]:
    total = [0] * len(plan.tracks)
    for wait in found:
        total[wait.robot] += wait.ticks
    return total


def _robots(plan: Plan, metrics: Metrics, found: Sequence[Wait]) -> Iterator[str]:
    waiting = _waiting(plan, found)
    lost = [done - alone for done, alone in zip(metrics.completions, metrics.alone, strict=True)]
    shown = sorted(sorted(range(len(lost)), key=lambda robot: -lost[robot])[:MOST_LINES])
    names = {robot: short(plan.scenario.robots[robot].name) for robot in shown}
    width = max(map(len, ("robot", *names.values())))
    yield f"{'robot':{width}}  completes  alone  waits"
    for robot, name in names.items():
        times = f"{metrics.completions[robot]:9}  {metrics.alone[robot]:5}  {waiting[robot]:5}"
        yield f"{name:{width}}  {times}"
    if len(lost) > len(shown):
        yield f"… and {len(lost) - len(shown)} more, who lose less time"


def short(name: str) -> str:
    """Return a name in as many columns as it may take."""
    return name if len(name) <= MOST_OF_NAME else f"{name[: MOST_OF_NAME - 1]}…"


def _waits(plan: Plan, found: Sequence[Wait]) -> Iterator[str]:
    """Yield who waits for whom, the longest in all first."""
    groups: dict[tuple[int, int | None], list[Wait]] = {}
    for wait in found:
        groups.setdefault((wait.robot, wait.for_robot), []).append(wait)
    longest = sorted(groups.values(), key=lambda group: -sum(wait.ticks for wait in group))
    if longest:
        yield ""
    for group in longest[:MOST_LINES]:
        yield from wrapped(_wait(plan, group))
    if len(longest) > MOST_LINES:
        yield f"… and {len(longest) - MOST_LINES} more (--json lists all)"


def _wait(plan: Plan, group: list[Wait]) -> str:
    names, place, first = names_of(plan), plan.scenario.roadmap.name, group[0]
    total = f"{names[first.robot]} waits {ticks(sum(wait.ticks for wait in group))}"
    whom = "to let others pass further on"
    if first.for_robot is not None:
        whom = f"for {names[first.for_robot]} to leave {place(first.towards)}"
    if len(group) == 1:
        return f"{total} in {place(first.vertex)} at tick {first.tick}, {whom}."
    start = f"first in {place(first.vertex)} at tick {first.tick}"
    return f"{total} in {len(group)} places, {start}, {whom}."
