"""What a person, or a program, wants to know of a run of laps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from rightofway.cli.laps_theory import (
    HOUR,
    comparison_data,
    comparison_lines,
    sensitivity_data,
    sensitivity_lines,
)
from rightofway.cli.words import wrapped
from rightofway.cyclic import Bottleneck, CyclicResult, GroupResult, LapWait, in_words

__all__ = ["laps_data", "laps_report"]

MOST_GROUPS = 3
"""More groups are only counted; --json has them all."""

MOST_LINES = 12
"""Longer lists end with how many more there are."""

MOST_OF_DENOMINATOR = 12
"""Fractions of smaller parts are rounded for people."""

MOST_TIMES = 4
"""How often a conflict is told within one period; more times are counted."""

MOST_VISITS = 1_000_000
"""In periods of more visits nobody looks for who waits for whom, and for the bottleneck."""

Sights = dict[tuple[int, int, int], list[Fraction]]
"""By place, who waits and for whom: when [time unit]."""


def laps_data(run: CyclicResult) -> dict[str, Any]:
    """Return a result for programs; times are exact fractions of the scenario's unit."""
    return {
        "rule": run.rule,
        "routes": run.routes,
        "throughput_per_hour": str(HOUR * run.throughput()),
        "groups": [_group_data(run, group) for group in run.groups],
    }


def _group_data(run: CyclicResult, group: GroupResult) -> dict[str, Any]:
    names, pattern = _names(run, group), group.pattern
    time = run.scenario.problem.clock.time
    means = [None if mean is None else str(mean * time(1)) for mean in group.mean_laps()]
    shares = [None if share is None else str(share) for share in group.waiting_shares()]
    return {
        "robots": names,
        "ends": group.ends,
        "why": group.why,
        "transient": str(time(pattern.transient)) if pattern else None,
        "begins": str(time(pattern.begins)) if pattern else None,
        "period": str(time(pattern.period)) if pattern else None,
        "laps_per_period": dict(zip(names, pattern.counts, strict=True)) if pattern else None,
        "laps_made": dict(zip(names, group.laps_made(), strict=True)),
        "mean_lap": dict(zip(names, means, strict=True)),
        "measured": _measured_data(run, group),
        "waiting_share": dict(zip(names, shares, strict=True)),
        **(_NOT_TOLD if _is_long(group) else _waits_data(run, group)),
        **comparison_data(run.scenario, group.comparison),
    }


_NOT_TOLD = dict.fromkeys(("conflicts", "first_lap", "bottleneck", "sensitivity"))


def _is_long(group: GroupResult) -> bool:
    """Tell whether a period is too long to be looked at visit by visit."""
    return group.pattern is not None and group.pattern.n_visits > MOST_VISITS


def _waits_data(run: CyclicResult, group: GroupResult) -> dict[str, Any]:
    """Return who waits for whom, and what sets the pace."""
    return {
        "conflicts": [_conflict_data(run, one, "offset") for one in group.waits()],
        "first_lap": [_conflict_data(run, one, "time") for one in group.first_waits()],
        "bottleneck": _bottleneck_data(run, group.bottleneck()),
        "sensitivity": sensitivity_data(run, group),
    }


def _measured_data(run: CyclicResult, group: GroupResult) -> dict[str, Any] | None:
    """Return what the means are of, where nothing is known to repeat."""
    if group.pattern:
        return None
    measured, names = group.measured(), _names(run, group)
    return {
        "from": str(run.scenario.problem.clock.time(measured.warm_up)),
        "laps": dict(zip(names, measured.laps, strict=True)),
    }


def _conflict_data(run: CyclicResult, conflict: LapWait, when: str) -> dict[str, Any]:
    time, robots = run.scenario.problem.clock.time, run.scenario.robots
    return {
        "vertex": run.scenario.roadmap.name(conflict.vertex),
        "robots": [robots[robot].name for robot in conflict.pair],
        "waits": robots[conflict.waits].name,
        when: str(time(conflict.tick)),
        "for": str(time(conflict.ticks)),
    }


def _bottleneck_data(run: CyclicResult, bottleneck: Bottleneck | None) -> list[dict[str, Any]]:
    time, scenario = run.scenario.problem.clock.time, run.scenario
    return [
        {
            "kind": piece.kind,
            "robot": scenario.robots[piece.robot].name,
            "vertices": [scenario.roadmap.name(place) for place in piece.places],
            "for": str(time(piece.ticks)),
        }
        for piece in (bottleneck.pieces if bottleneck else ())
    ]


def laps_report(run: CyclicResult) -> str:
    """Return a result for people."""
    return "\n".join(_lines(run))


def _lines(run: CyclicResult) -> Iterator[str]:
    together = [group for group in run.groups if len(group.robots) > 1]
    yield f"rule        {run.rule}, on {run.routes} routes"
    yield f"groups      {_groups(run, together)}"
    yield f"throughput  {_short(HOUR * run.throughput())} laps in {HOUR} time units"
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MOST_GROUPS]:
        yield ""
        yield from _group_lines(run, group)
        if group.comparison is not None:
            yield from comparison_lines(group.comparison)
    if len(largest) > MOST_GROUPS:
        yield ""
        yield f"… and {len(largest) - MOST_GROUPS} more groups, none larger (--json has them all)"


def _groups(run: CyclicResult, together: Sequence[GroupResult]) -> str:
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], "repeats itself"),
        (ends["deadlock"], "comes to a standstill"),
        (ends["open"], "is open: time ran out"),
    ]
    told = [f"{number} of {len(together)} {words}" for number, words in counts if number]
    alone = len(run.groups) - len(together)
    lonely = [f"{alone} robots never meet anybody"] if alone else []
    return "; ".join([*told, *lonely])


def _group_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    time = run.scenario.problem.clock.time
    who = f"{len(group.robots)} robots"
    if group.pattern is None:
        yield from wrapped(f"{who}: {group.why}. {_so_far(run, group)}:")
        yield from _robot_lines(run, group)
        return
    transient, period = time(group.pattern.transient), time(group.pattern.period)
    yield f"{who}: from time {transient} on, all repeats every {period}"
    yield from _robot_lines(run, group)
    if _is_long(group):
        yield "waits and the bottleneck are not looked for in a period as long as this"
        return
    yield from _conflict_lines(run, group)
    bottleneck = group.bottleneck()
    if bottleneck:
        yield from wrapped(f"bottleneck: {in_words(bottleneck, run.scenario)}")
        yield from sensitivity_lines(run, group)


def _so_far(run: CyclicResult, group: GroupResult) -> str:
    """Say what the means of laps are of, where nothing is known to repeat."""
    if group.ends == "deadlock":
        return "Their laps so far"
    measured = group.measured()
    laps = sum(measured.laps) / len(measured.laps)
    since = _short(run.scenario.problem.clock.time(measured.warm_up))
    return f"Means of {laps:.1f} laps each, from time {since} on, not proven to stay so"


def _robot_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    names, tick = _names(run, group), run.scenario.problem.clock.tick
    counts = group.pattern.counts if group.pattern else group.measured().laps
    title = "laps/period" if group.pattern else "laps"
    width = max(map(len, ("robot", *names[:MOST_LINES])))
    yield f"{'robot':{width}}  {title:>11}  mean lap     alone  waiting"
    rows = zip(
        names, counts, group.mean_laps(), group.waiting_shares(), group.context.laps, strict=True
    )
    for name, laps, mean, share, one in list(rows)[:MOST_LINES]:
        lap = ("never" if group.pattern else "?") if mean is None else _short(mean * tick)
        alone, waits = (
            _short(one.duration * tick),
            "" if share is None else f"{float(share):7.1%}",
        )
        yield f"{name:{width}}  {laps:11}  {lap:>8}  {alone:>8}  {waits}".rstrip()
    if len(names) > MOST_LINES:
        yield f"… and {len(names) - MOST_LINES} more robots"


def _short(number: Fraction) -> str:
    return str(number) if number.denominator <= MOST_OF_DENOMINATOR else f"{float(number):.2f}"


def _conflict_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    """Yield who waits where for whom: in each period, and in the first lap."""
    first, steady = (_sights(run, found) for found in (group.first_waits(), group.waits()))
    both = len(first.keys() & steady.keys())
    yield f"waits: {len(first)} in the first lap, {len(steady)} in each period, {both} in both"
    robots, place = run.scenario.robots, run.scenario.roadmap.name
    for sight in [*steady, *(one for one in first if one not in steady)][:MOST_LINES]:
        vertex, waits, whom = sight
        text = f"{place(vertex)}: {robots[waits].name} waits for {robots[whom].name}"
        when = [
            f"{words} {_times(found[sight])}"
            for words, found in (("first lap at", first), ("each period at", steady))
            if sight in found
        ]
        yield from wrapped(f"{text}, {'; '.join(when)}", "  ")
    more = len(first.keys() | steady.keys()) - MOST_LINES
    if more > 0:
        yield f"  … and {more} more"


def _sights(run: CyclicResult, conflicts: Sequence[LapWait]) -> Sights:
    found: Sights = {}
    for one in conflicts:
        when = run.scenario.problem.clock.time(one.tick)
        found.setdefault((one.vertex, one.waits, one.for_robot), []).append(when)
    return found


def _times(times: Sequence[Fraction]) -> str:
    told = ", ".join(map(_short, times[:MOST_TIMES]))
    return told if len(times) <= MOST_TIMES else f"{told} and {len(times) - MOST_TIMES} times more"


def _names(run: CyclicResult, group: GroupResult) -> list[str]:
    return [run.scenario.robots[robot].name for robot in group.robots]
