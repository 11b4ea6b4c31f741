"""Reports on a plan: its costs, the time that each robot loses, the decisions behind it."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

from rightofway.cli.terminal import COLUMNS, row, short, wrapped
from rightofway.metrics import Metrics, measure, waits
from rightofway.model import Decision, Plan, Wait

MAX_LINES = 20
"""Lines of a list; longer lists end with the number of further ones, --json has them all."""


def summary(plan: Plan) -> str:
    """Return the costs of a plan, and which robots lose time for which others."""
    metrics, found = measure(plan), waits(plan)
    tick = plan.scenario.problem.clock.tick

    def time(number: int) -> str:
        return _ticks(number) + ("" if tick == 1 else f" = {number * tick} time units")

    above = f"{metrics.gap:.1%} above the lower bound {metrics.lower_bound}"
    rows = [
        ("planner", f"{plan.run.name}: {plan.run.status}"),
        ("flowtime", f"{time(metrics.flowtime)}, {above}"),
        ("makespan", time(metrics.makespan)),
        ("waiting", time(metrics.waiting)),
    ]
    costs = [
        row(key, textwrap.shorten(text, 4 * COLUMNS, placeholder=" …"), 10) for key, text in rows
    ]
    return "\n".join([*costs, "", *_robots(plan, metrics, found), *_waits(plan, found)])


def summary_data(plan: Plan) -> dict[str, Any]:
    """Return the same for programs, the planner as in a plan file; times in ticks."""
    metrics, run, found = measure(plan), plan.run, waits(plan)
    names, place = _names(plan), plan.scenario.roadmap.name
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


def _names(plan: Plan) -> list[str]:
    return [robot.name for robot in plan.scenario.robots]


def _ticks(number: int) -> str:
    return f"{number} tick" + "s" * (number != 1)


def _waiting(plan: Plan, found: Sequence[Wait]) -> list[int]:
    total = [0] * len(plan.tracks)
    for wait in found:
        total[wait.robot] += wait.ticks
    return total


def _robots(plan: Plan, metrics: Metrics, found: Sequence[Wait]) -> Iterator[str]:
    waiting = _waiting(plan, found)
    lost = [done - alone for done, alone in zip(metrics.completions, metrics.alone, strict=True)]
    listed = sorted(sorted(range(len(lost)), key=lambda robot: -lost[robot])[:MAX_LINES])
    names = {robot: short(plan.scenario.robots[robot].name) for robot in listed}
    width = max(map(len, ("robot", *names.values())))
    yield f"{'robot':{width}}  completes  alone  waits"
    for robot, name in names.items():
        times = f"{metrics.completions[robot]:9}  {metrics.alone[robot]:5}  {waiting[robot]:5}"
        yield f"{name:{width}}  {times}"
    if len(lost) > len(listed):
        yield f"… and {len(lost) - len(listed)} more robots, which lose less time"


def _waits(plan: Plan, found: Sequence[Wait]) -> Iterator[str]:
    """Yield which robot waits for which other, largest sums of waits first."""
    groups: dict[tuple[int, int | None], list[Wait]] = {}
    for wait in found:
        groups.setdefault((wait.robot, wait.for_robot), []).append(wait)
    longest = sorted(groups.values(), key=lambda group: -sum(wait.ticks for wait in group))
    if longest:
        yield ""
    names, place = _names(plan), plan.scenario.roadmap.name
    for group in longest[:MAX_LINES]:
        first, where = group[0], ""
        if len(group) > 1:
            where = f" in {len(group)} places, first"
        where += f" in {place(first.vertex)} at tick {first.tick}"
        reason = "to let others pass further on"
        if first.for_robot is not None:
            reason = f"for {names[first.for_robot]} to leave {place(first.towards)}"
        total = _ticks(sum(wait.ticks for wait in group))
        yield from wrapped(f"{names[first.robot]} waits {total}{where}, {reason}.")
    if len(longest) > MAX_LINES:
        yield f"… and {len(longest) - MAX_LINES} more (--json lists all)"


def decision_log(plan: Plan) -> str:
    """Return every decision of the planner with its reason, in the order they were taken."""
    names = _names(plan)
    lines: list[str] = []
    for decision in plan.run.decisions:
        lines += wrapped(_decision(plan, names, decision))
        lines += wrapped(_reason(decision, names), "    ")
    for reroute in plan.run.reroutes:
        lines += wrapped(f"{names[reroute.robot]} is rerouted: {reroute.because}.")
    return "\n".join(lines or ["No decision was needed: no two robots meet."])


def _decision(plan: Plan, names: list[str], decision: Decision) -> str:
    place, vertices = plan.scenario.roadmap.name, decision.vertices
    where = place(vertices[0])
    if decision.kind != "vertex":
        where = f"segment {where} to {place(vertices[-1])} ({len(vertices)} vertices)"
    waits, first = names[decision.waits], names[_goes_first(decision)]
    how = f"{waits} waits {_ticks(decision.ticks)} in {place(decision.waits_at)}"
    if decision.kind == "following":
        how = f"{how} and follows {first}" if decision.ticks else f"{waits} follows {first}"
    else:
        how = f"{how}, {first} goes first"
    return f"tick {decision.tick}, {where}: {how}."


def _goes_first(decision: Decision) -> int:
    one, other = decision.robots
    return one if decision.waits == other else other


def _reason(decision: Decision, names: list[str]) -> str:
    i, j = (names[robot] for robot in decision.robots)
    if_i, if_j = decision.conflicts_left
    left = f"conflicts left {if_i} if {i} waits, {if_j} if {j} does"
    match decision.level:
        case "only":
            return f"only choice: {names[_goes_first(decision)]} cannot wait here."
        case "priority":
            return f"priority: {names[_goes_first(decision)]} has the higher one."
        case "settled":
            return f"node level: the other choice meets robots that are settled already ({left})."
        case "node":
            return f"node level: {left}."
    if_i, if_j = decision.completion_sums or (None, None)
    if if_i is None or if_j is None:
        sums = f"Only with {j if if_i is None else i} waiting do both get through."
    else:
        sums = f"Their work takes {if_i} ticks together if {i} waits, {if_j} if {j} does."
    return f"robot level: {left}. {sums}"
