"""A plan in words: its summary, why robots wait, what was decided. Lines of at most 80 columns."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from rightofway.metrics import Metrics, Wait, measure, waits
from rightofway.model import Decision, Plan

__all__ = ["decision_log", "summary", "summary_data"]

COLUMNS = 80
MOST_LINES = 20
"""Longer lists end with how many more there are; --json has them all."""


def summary(plan: Plan) -> str:
    """Return what a person wants to know of a plan first."""
    metrics = measure(plan)
    return "\n".join([*_head(plan, metrics), "", *_robots(plan, metrics), *_waits(plan)])


def summary_data(plan: Plan) -> dict[str, Any]:
    """Return the same for programs; times in ticks."""
    metrics, names, place = measure(plan), _names(plan), plan.scenario.roadmap.name
    return {
        "planner": plan.run.name,
        "status": plan.run.status,
        "tick": str(plan.scenario.timing.clock.tick),
        "metrics": {**metrics.as_dict(), "gap": round(metrics.gap, 6)},
        "robots": [
            {"name": name, "completion": completion, "alone": alone, "waiting": waiting}
            for name, completion, alone, waiting in zip(
                names, metrics.completions, metrics.alone, _waiting(plan), strict=True
            )
        ],
        "waits": [
            {
                "robot": names[wait.robot],
                "vertex": place(wait.vertex),
                "tick": wait.tick,
                "ticks": wait.ticks,
                "for": None if wait.for_robot is None else names[wait.for_robot],
            }
            for wait in waits(plan)
        ],
        "rerouted": [names[reroute.robot] for reroute in plan.run.reroutes],
    }


def decision_log(plan: Plan) -> str:
    """Return every decision and its reason, in the order they were taken."""
    names = _names(plan)
    lines = [line for one in plan.run.decisions for line in _decision(plan, one)]
    for reroute in plan.run.reroutes:
        lines += _wrapped(f"{names[reroute.robot]} was sent another way: {reroute.because}.")
    return "\n".join(lines or ["Nothing had to be decided: no two robots meet."])


def ticks(number: int) -> str:
    """Return a number of ticks in words."""
    return f"{number} tick" + "s" * (number != 1)


def _names(plan: Plan) -> list[str]:
    return [robot.name for robot in plan.scenario.robots]


def _head(plan: Plan, metrics: Metrics) -> Iterator[str]:
    tick = plan.scenario.timing.clock.tick
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


def _waiting(plan: Plan) -> list[int]:
    total = [0] * len(plan.tracks)
    for wait in waits(plan):
        total[wait.robot] += wait.ticks
    return total


def _robots(plan: Plan, metrics: Metrics) -> Iterator[str]:
    rows = list(zip(_names(plan), metrics.completions, metrics.alone, _waiting(plan), strict=True))
    longest = sorted(rows, key=lambda row: row[2] - row[1])[:MOST_LINES]
    shown = [row for row in rows if row in longest]
    width = max(5, *(min(len(row[0]), 40) for row in shown))
    yield f"{'robot':{width}}  completes  alone  waits"
    for name, completion, alone, waiting in shown:
        short = textwrap.shorten(name, width, placeholder="…") or name[:width]
        yield f"{short:{width}}  {completion:9}  {alone:5}  {waiting:5}"
    if len(rows) > len(shown):
        yield f"… and {len(rows) - len(shown)} more, who lose less time"


def _waits(plan: Plan) -> Iterator[str]:
    """Yield who waits for whom, the longest in all first."""
    groups: dict[tuple[int, int | None], list[Wait]] = {}
    for wait in waits(plan):
        groups.setdefault((wait.robot, wait.for_robot), []).append(wait)
    longest = sorted(groups.values(), key=lambda group: -sum(wait.ticks for wait in group))
    if longest:
        yield ""
    for group in longest[:MOST_LINES]:
        yield from _wrapped(_wait(plan, group))
    if len(longest) > MOST_LINES:
        yield f"… and {len(longest) - MOST_LINES} more who wait for somebody"


def _wait(plan: Plan, group: list[Wait]) -> str:
    names, place, first = _names(plan), plan.scenario.roadmap.name, group[0]
    total = f"{names[first.robot]} waits {ticks(sum(wait.ticks for wait in group))}"
    whom = "to let others pass further on"
    if first.for_robot is not None:
        whom = f"for {names[first.for_robot]} to leave {place(first.towards)}"
    if len(group) == 1:
        return f"{total} in {place(first.vertex)} at tick {first.tick}, {whom}."
    start = f"first in {place(first.vertex)} at tick {first.tick}"
    return f"{total} in {len(group)} places, {start}, {whom}."


def _decision(plan: Plan, one: Decision) -> Iterator[str]:
    names, place = _names(plan), plan.scenario.roadmap.name
    first = one.robots[0] if one.waits == one.robots[1] else one.robots[1]
    where = place(one.vertices[0])
    if one.kind == "head-on":
        where = f"segment {where} to {place(one.vertices[-1])} ({len(one.vertices)} vertices)"
    yield from _wrapped(
        f"tick {one.tick}, {where}: {names[one.waits]} waits {ticks(one.ticks)} in"
        f" {place(one.waits_at)}, {names[first]} goes first."
    )
    yield from _wrapped(_reason(one, names), indent="    ")


def _reason(one: Decision, names: list[str]) -> str:
    i, j = (names[robot] for robot in one.robots)
    if_i, if_j = one.conflicts_left
    left = f"conflicts left {if_i} if {i} waits, {if_j} if {j} does"
    if one.level == "only":
        other = names[one.robots[0] if one.waits == one.robots[1] else one.robots[1]]
        return f"only choice: {other} cannot wait here."
    if one.level == "settled":
        return f"node level: the other choice meets robots that are settled already ({left})."
    if one.level == "node":
        return f"node level: {left}."
    return f"robot level: {left}. {_sums(one, i, j)}"


def _sums(one: Decision, i: str, j: str) -> str:
    if_i, if_j = one.completion_sums or (None, None)
    if if_i is None or if_j is None:
        return f"Only with {j if if_i is None else i} waiting do both get through."
    return f"Their work takes {if_i} ticks together if {i} waits, {if_j} if {j} does."


def _wrapped(text: str, indent: str = "") -> list[str]:
    return textwrap.wrap(text, COLUMNS, initial_indent=indent, subsequent_indent=indent + "    ")
