"""What a person, or a program, wants to know of a run of laps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from rightofway.cli.words import wrapped
from rightofway.laps import Conflict, GroupRun, LapsRun

__all__ = ["laps_data", "laps_report"]

MOST_GROUPS = 3
"""More groups are only counted; --json has them all."""

MOST_LINES = 12
"""Longer lists end with how many more there are."""

MOST_OF_NUMBER = 8
"""Columns that a number may take; longer fractions are rounded for people."""


def laps_data(run: LapsRun) -> dict[str, Any]:
    """Return a run for programs; times are exact fractions of the scenario's unit."""
    return {
        "rule": run.rule,
        "routes": run.routes,
        "throughput_per_hour": str(3600 * run.throughput()),
        "groups": [_group_data(run, group) for group in run.groups],
    }


def _group_data(run: LapsRun, group: GroupRun) -> dict[str, Any]:
    names, time = _names(run, group), run.scenario.timing.clock.time
    pattern = group.pattern
    means = [None if mean is None else str(mean * time(1)) for mean in group.mean_laps()]
    return {
        "robots": names,
        "ends": group.ends,
        "why": group.why,
        "transient": str(time(pattern.transient)) if pattern else None,
        "period": str(time(pattern.period)) if pattern else None,
        "begins": str(time(pattern.begins)) if pattern else None,
        "laps_per_period": dict(zip(names, pattern.counts, strict=True)) if pattern else None,
        "laps_made": dict(zip(names, group.laps_made(), strict=True)),
        "mean_lap": dict(zip(names, means, strict=True)),
        "waiting_share": dict(zip(names, map(str, group.waiting_shares()), strict=True)),
        "conflicts": [_conflict_data(run, one, "offset") for one in run.conflicts(group)],
        "first_lap": [_conflict_data(run, one, "time") for one in run.first_conflicts(group)],
        "bottleneck": [],
    }


def _conflict_data(run: LapsRun, conflict: Conflict, when: str) -> dict[str, Any]:
    time, robots = run.scenario.timing.clock.time, run.scenario.robots
    return {
        "vertex": run.scenario.roadmap.name(conflict.vertex),
        "robots": [robots[robot].name for robot in conflict.pair],
        "waits": robots[conflict.waits].name,
        when: str(time(conflict.tick)),
        "for": str(time(conflict.ticks)),
    }


def laps_report(run: LapsRun) -> str:
    """Return a run for people."""
    return "\n".join(_lines(run))


def _lines(run: LapsRun) -> Iterator[str]:
    ends = Counter(group.ends for group in run.groups)
    together = [group for group in run.groups if len(group.robots) > 1]
    alone = len(run.groups) - len(together)
    yield f"rule        {run.rule}, routes {run.routes}"
    yield f"robots      {len(run.scenario.robots)}, {alone} of them never meet another"
    yield f"groups      {len(together)}" + "".join(
        f", {number} {words}"
        for end, words in (("deadlock", "come to a standstill"), ("open", "open in this time"))
        if (number := ends[end])  # type: ignore[index]
    )
    yield f"throughput  {float(3600 * run.throughput()):.6g} laps in 3600 time units"
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MOST_GROUPS]:
        yield ""
        yield from _group_lines(run, group)
    if len(largest) > MOST_GROUPS:
        yield ""
        yield f"… and {len(largest) - MOST_GROUPS} smaller groups (--json has them all)"


def _group_lines(run: LapsRun, group: GroupRun) -> Iterator[str]:
    yield from wrapped(_headline(run, group))
    yield from _robot_lines(run, group)
    if group.pattern:
        yield from _conflict_lines(run, group)


def _headline(run: LapsRun, group: GroupRun) -> str:
    time, pattern = run.scenario.timing.clock.time, group.pattern
    who = f"{len(group.robots)} robots"
    if pattern is None:
        return f"{who}: {group.why}; the laps so far:"
    return f"{who}: after {time(pattern.transient)} all repeats every {time(pattern.period)}"


def _robot_lines(run: LapsRun, group: GroupRun) -> Iterator[str]:
    names = _names(run, group)
    width = max(5, *map(len, names))
    counts = group.pattern.counts if group.pattern else group.laps_made()
    yield f"{'robot':{width}}  laps  mean lap  alone  waiting"
    time = run.scenario.timing.clock.time
    rows = zip(names, counts, group.mean_laps(), group.waiting_shares(), group.group, strict=True)
    for name, laps, mean, share, endless in list(rows)[:MOST_LINES]:
        lap = "never" if mean is None else _short(mean * time(1))
        alone = _short(time(endless.lap.duration))
        yield f"{name:{width}}  {laps:4}  {lap:>8}  {alone:>5}  {float(share):7.1%}"
    if len(names) > MOST_LINES:
        yield f"… and {len(names) - MOST_LINES} more robots"


def _short(number: Fraction) -> str:
    return str(number) if len(str(number)) <= MOST_OF_NUMBER else f"{float(number):.4g}"


def _conflict_lines(run: LapsRun, group: GroupRun) -> Iterator[str]:
    first, steady = run.first_conflicts(group), run.conflicts(group)
    yield f"conflicts: first lap {len(first)}, then {len(steady)} a period"
    place, robots = run.scenario.roadmap.name, run.scenario.robots
    time = run.scenario.timing.clock.time
    for one in steady[:MOST_LINES]:
        who = f"{robots[one.waits].name} waits {_short(time(one.ticks))}"
        whom = f"for {robots[one.for_robot].name} to leave {place(one.vertex)}"
        yield f"  at {_short(time(one.tick))}: {who} {whom}"


def _names(run: LapsRun, group: GroupRun) -> list[str]:
    return [run.scenario.robots[robot].name for robot in group.robots]
