"""The decision log: who got the right of way, where, and by which numbers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from rightofway.cli.words import names_of, ticks, wrapped
from rightofway.model import Decision, Plan

__all__ = ["decision_log"]

INDENT = "    "


def decision_log(plan: Plan) -> str:
    """Return every decision and its reason, in the order they were taken.

    Where one robot stays behind another from place to place, because there is no other choice, the
    first place stands for all.
    """
    names = names_of(plan)
    lines: list[str] = []
    for _, alike in groupby(enumerate(plan.run.decisions), _without_choice):
        lines += _decisions(plan, names, [decision for _, decision in alike])
    for reroute in plan.run.reroutes:
        lines += wrapped(f"{names[reroute.robot]} was sent another way: {reroute.because}.")
    return "\n".join(lines or ["Nothing had to be decided: no two robots meet."])


def _without_choice(numbered: tuple[int, Decision]) -> tuple[int, ...]:
    """Return what decisions have in common that are told as one; others have their number."""
    number, one = numbered
    follows = one.level == "only" and one.kind == "vertex"
    return (-1, *one.robots, one.waits) if follows else (number,)


def _decisions(plan: Plan, names: list[str], alike: list[Decision]) -> Iterator[str]:
    one, *others = alike
    place, goes_first = plan.scenario.roadmap.name, names[_goes_first(one)]
    yield from wrapped(
        f"tick {one.tick}, {_where(plan, one)}: {names[one.waits]} waits {ticks(one.ticks)} in"
        f" {place(one.waits_at)}, {goes_first} goes first."
    )
    yield from wrapped(_reason(one, names), INDENT)
    if others:
        last = others[-1]
        often = "once" if len(others) == 1 else f"{len(others)} times"
        until = f"the last at tick {last.tick}, {place(last.vertices[0])}"
        yield from wrapped(f"the same {often} more, {until}.", INDENT)


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
