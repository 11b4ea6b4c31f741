"""The decision log: who got the right of way, where, and by which numbers."""

from __future__ import annotations

from rightofway.cli.words import names_of, ticks, wrapped
from rightofway.model import Decision, Plan

__all__ = ["decision_log"]

INDENT = "    "


def decision_log(plan: Plan) -> str:
    """Return every decision and its reason, in the order they were taken."""
    names = names_of(plan)
    lines: list[str] = []
    for decision in plan.run.decisions:
        lines += wrapped(_decision(plan, names, decision))
        lines += wrapped(_reason(decision, names), INDENT)
    for reroute in plan.run.reroutes:
        lines += wrapped(f"{names[reroute.robot]} was sent another way: {reroute.because}.")
    return "\n".join(lines or ["Nothing had to be decided: no two robots meet."])


def _decision(plan: Plan, names: list[str], one: Decision) -> str:
    where, waits, first = _where(plan, one), names[one.waits], names[_goes_first(one)]
    wait = f"{waits} waits {ticks(one.ticks)} in {plan.scenario.roadmap.name(one.waits_at)}"
    if one.kind == "following":
        how = f"{wait} and follows {first}" if one.ticks else f"{waits} follows {first}"
        return f"tick {one.tick}, {where}: {how}."
    return f"tick {one.tick}, {where}: {wait}, {first} goes first."


def _goes_first(one: Decision) -> int:
    return one.robots[0] if one.waits == one.robots[1] else one.robots[1]


def _where(plan: Plan, one: Decision) -> str:
    first, last = (plan.scenario.roadmap.name(one.vertices[end]) for end in (0, -1))
    if one.kind == "vertex":
        return first
    return f"segment {first} to {last} ({len(one.vertices)} vertices)"


def _reason(one: Decision, names: list[str]) -> str:
    i, j = (names[robot] for robot in one.robots)
    if_i, if_j = one.conflicts_left
    left = f"conflicts left {if_i} if {i} waits, {if_j} if {j} does"
    if one.level == "only":
        return f"only choice: {names[_goes_first(one)]} cannot wait here."
    if one.level == "priority":
        return f"priority: {names[_goes_first(one)]} has the higher one."
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
