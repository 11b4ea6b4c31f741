"""Reports on work that repeats: period, waits, bottleneck, sensitivity, comparison with a baseline.

The baseline of a timetable is the rule first come first served.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from rightofway.cli.terminal import wrapped
from rightofway.cyclic import (
    Comparison,
    CyclicResult,
    GroupResult,
    LapWait,
    ParameterEffect,
    in_words,
    parameter_effects,
)
from rightofway.model import Scenario

HOUR = 3600
"""Time units of a scenario in an hour, if they are seconds."""

MAX_GROUPS = 3
"""Groups in the report; --json has them all."""

MAX_LINES = 12
"""Lines of a list; longer lists end with the number of further ones."""

MAX_DENOMINATOR = 12
"""Fractions of smaller parts are rounded in the report."""

MAX_TIMES = 4
"""Times of one wait within a period that the report lists; further ones are counted."""

MAX_EFFECTS = 3
"""Changes in the report that would shorten the period; --json has more."""

MAX_VISITS = 1_000_000
"""Visits of a period in which waits and bottleneck are computed."""

MAX_VISITS_OF_SENSITIVITY = 200_000
"""Visits of a period whose sensitivity is computed; each parameter takes a search."""

Sites = dict[tuple[int, int, int], list[Fraction]]
"""Waits by vertex, waiting robot and awaited robot: their times [time unit]."""


def laps_data(run: CyclicResult) -> dict[str, Any]:
    """Return a result for programs: plain data, times as exact fractions of the time unit."""
    return {
        "rule": run.rule,
        "routes": run.routes,
        "throughput_per_hour": str(HOUR * run.throughput()),
        "groups": [_group_data(run.scenario, group) for group in run.groups],
    }


def _group_data(scenario: Scenario, group: GroupResult) -> dict[str, Any]:
    robots, place, clock = scenario.robots, scenario.roadmap.name, scenario.problem.clock
    names, pattern, measured, time = _names(scenario, group), group.pattern, None, clock.time
    means = [None if mean is None else str(mean * clock.tick) for mean in group.mean_laps()]
    shares = [None if share is None else str(share) for share in group.waiting_shares()]
    if pattern is None:
        found = group.measured()
        laps = dict(zip(names, found.laps, strict=True))
        measured = {"from": str(time(found.warm_up)), "laps": laps}

    def waits_data(waits: Sequence[LapWait], when: str) -> list[dict[str, Any]]:
        return [
            {
                "vertex": place(wait.vertex),
                "robots": [robots[robot].name for robot in wait.pair],
                "waits": robots[wait.waits].name,
                when: str(time(wait.tick)),
                "for": str(time(wait.ticks)),
            }
            for wait in waits
        ]

    data: dict[str, Any] = {
        "robots": names,
        "ends": group.ends,
        "why": group.why,
        "transient": str(time(pattern.transient)) if pattern else None,
        "begins": str(time(pattern.begins)) if pattern else None,
        "period": str(time(pattern.period)) if pattern else None,
        "laps_per_period": dict(zip(names, pattern.counts, strict=True)) if pattern else None,
        "laps_made": dict(zip(names, group.laps_made(), strict=True)),
        "mean_lap": dict(zip(names, means, strict=True)),
        "measured": measured,
        "waiting_share": dict(zip(names, shares, strict=True)),
    }
    if _is_long(group):
        data |= dict.fromkeys(("conflicts", "first_lap", "bottleneck", "sensitivity"))
    else:
        bottleneck = group.bottleneck()
        data |= {
            "conflicts": waits_data(group.waits(), "offset"),
            "first_lap": waits_data(group.first_waits(), "time"),
            "bottleneck": [
                {
                    "kind": piece.kind,
                    "robot": robots[piece.robot].name,
                    "vertices": [place(vertex) for vertex in piece.places],
                    "for": str(time(piece.ticks)),
                }
                for piece in (bottleneck.pieces if bottleneck else ())
            ],
            "sensitivity": _sensitivity_data(scenario, group),
        }
    if group.comparison is not None:
        hour = HOUR / clock.tick
        data |= {
            "throughput_per_hour": str(group.comparison.throughput * hour),
            "fairness": str(group.comparison.fairness),
            "first_come": {
                "ends": group.comparison.baseline_ends,
                "throughput_per_hour": str(group.comparison.baseline * hour),
            },
        }
    return data


def _names(scenario: Scenario, group: GroupResult) -> list[str]:
    return [scenario.robots[robot].name for robot in group.robots]


def _is_long(group: GroupResult) -> bool:
    """Return whether a period is too long to be computed visit by visit."""
    return group.pattern is not None and group.pattern.n_visits > MAX_VISITS


def _sensitivity_data(scenario: Scenario, group: GroupResult) -> list[dict[str, Any]]:
    graph, tick = group.graph(), scenario.problem.clock.tick
    if graph is None or len(graph.vertex) > MAX_VISITS_OF_SENSITIVITY:
        return []
    return [
        {
            "kind": one.kind,
            "robot": None if one.robot is None else scenario.robots[one.robot].name,
            "stop": one.stop,
            "gain": str(one.effect.gain * tick),
            "loss": str(one.effect.loss * tick),
            "until": str(one.effect.until),
            "at_best": str(one.effect.at_best * tick),
            "ten_per_cent": str(one.ten_per_cent * tick),
        }
        for one in parameter_effects(scenario, graph)
    ]


def laps_report(run: CyclicResult) -> str:
    """Return a result for people."""
    together = [group for group in run.groups if len(group.robots) > 1]
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], "periodic"),
        (ends["deadlock"], "in deadlock"),
        (ends["open"], "open: time ran out"),
    ]
    groups = [f"{number} of {len(together)} {words}" for number, words in counts if number]
    if len(together) < len(run.groups):
        groups.append(f"{len(run.groups) - len(together)} robots meet no other")
    lines = [
        f"rule        {run.rule}, on {run.routes} routes",
        f"groups      {'; '.join(groups)}",
        f"throughput  {_short(HOUR * run.throughput())} laps in {HOUR} time units",
    ]
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MAX_GROUPS]:
        lines += ["", *_group_lines(run.scenario, group)]
        if group.comparison is not None:
            lines += comparison_lines(group.comparison)
    if len(largest) > MAX_GROUPS:
        more = len(largest) - MAX_GROUPS
        lines += ["", f"… and {more} more groups, none larger (--json has them all)"]
    return "\n".join(lines)


def _group_lines(scenario: Scenario, group: GroupResult) -> Iterator[str]:
    time, size = scenario.problem.clock.time, f"{len(group.robots)} robots"
    if group.pattern is None:
        source = "Laps until then"
        if group.ends != "deadlock":
            measured = group.measured()
            laps = sum(measured.laps) / len(measured.laps)
            source = (
                f"Measured, not proven: means of {laps:.1f} laps per robot"
                f" from time {_short(time(measured.warm_up))} on"
            )
        yield from wrapped(f"{size}: {group.why}. {source}:")
        yield from _robot_lines(scenario, group)
        return
    period, since = time(group.pattern.period), time(group.pattern.transient)
    yield f"{size}: period {period}, from time {since} on"
    yield from _robot_lines(scenario, group)
    if _is_long(group):
        yield f"waits and bottleneck: not computed for a period of more than {MAX_VISITS} visits"
        return
    yield from _wait_lines(scenario, group)
    bottleneck = group.bottleneck()
    if bottleneck:
        yield from wrapped(f"bottleneck: {in_words(bottleneck, scenario)}")
        yield from _sensitivity_lines(scenario, group)


def _robot_lines(scenario: Scenario, group: GroupResult) -> Iterator[str]:
    names, tick = _names(scenario, group), scenario.problem.clock.tick
    counts = group.pattern.counts if group.pattern else group.measured().laps
    title = "laps/period" if group.pattern else "laps"
    width = max(map(len, ("robot", *names[:MAX_LINES])))
    yield f"{'robot':{width}}  {title:>11}  mean lap     alone  waiting"
    rows = zip(
        names, counts, group.mean_laps(), group.waiting_shares(), group.context.laps, strict=True
    )
    for name, laps, mean, share, route in list(rows)[:MAX_LINES]:
        lap = ("never" if group.pattern else "?") if mean is None else _short(mean * tick)
        alone = _short(route.duration * tick)
        waits = "" if share is None else f"{float(share):7.1%}"
        yield f"{name:{width}}  {laps:11}  {lap:>8}  {alone:>8}  {waits}".rstrip()
    if len(names) > MAX_LINES:
        yield f"… and {len(names) - MAX_LINES} more robots"


def _short(number: Fraction) -> str:
    return str(number) if number.denominator <= MAX_DENOMINATOR else f"{float(number):.2f}"


def _wait_lines(scenario: Scenario, group: GroupResult) -> Iterator[str]:
    """Yield which robot waits where for which other, in each period and in the first lap."""
    first, periodic = _sites(scenario, group.first_waits()), _sites(scenario, group.waits())
    both = len(first.keys() & periodic.keys())
    yield f"waits: {len(first)} in the first lap, {len(periodic)} in each period, {both} in both"
    robots, place = scenario.robots, scenario.roadmap.name
    sites = list(periodic | first)
    for site in sites[:MAX_LINES]:
        vertex, waiting, awaited = site
        text = f"{place(vertex)}: {robots[waiting].name} waits for {robots[awaited].name}"
        when = []
        for words, found in (("first lap at", first), ("each period at", periodic)):
            times = found.get(site, ())
            more = f" and {len(times) - MAX_TIMES} more times" if len(times) > MAX_TIMES else ""
            if times:
                when.append(f"{words} {', '.join(map(_short, times[:MAX_TIMES]))}{more}")
        yield from wrapped(f"{text}, {'; '.join(when)}", "  ")
    if len(sites) > MAX_LINES:
        yield f"  … and {len(sites) - MAX_LINES} more"


def _sites(scenario: Scenario, waits: Sequence[LapWait]) -> Sites:
    found: Sites = {}
    for wait in waits:
        site = (wait.vertex, wait.waits, wait.for_robot)
        found.setdefault(site, []).append(scenario.problem.clock.time(wait.tick))
    return found


def _sensitivity_lines(scenario: Scenario, group: GroupResult) -> Iterator[str]:
    """Say which changes of a parameter by 10 % would shorten the period."""
    graph = group.graph()
    if graph is None:
        return
    if len(graph.vertex) > MAX_VISITS_OF_SENSITIVITY:
        yield f"  sensitivity: not computed for more than {MAX_VISITS_OF_SENSITIVITY} visits"
        return
    effects = parameter_effects(scenario, graph, most=MAX_EFFECTS)
    helpful = [one for one in effects if one.ten_per_cent < one.effect.cycle_time]
    for one in helpful:
        saved = 1 - one.ten_per_cent / one.effect.cycle_time
        change = _change(scenario, one)
        yield f"  {change}: the period gets {float(saved):.2%} shorter"
    if not helpful:
        yield "  no single change shortens the period: another circuit is as long"


def _change(scenario: Scenario, effect: ParameterEffect) -> str:
    if effect.robot is None:
        return "10% less headway"
    robot = scenario.robots[effect.robot]
    if effect.kind == "speed":
        return f"{robot.name} 10% faster"
    if effect.stop is None:
        return f"{robot.name} 10% less turning"
    return f"{robot.name} 10% less work at {scenario.roadmap.name(robot.stops[effect.stop].at)}"


def comparison_lines(found: Comparison) -> Iterator[str]:
    """Yield how a timetable compares with its baseline, and how fair it is."""
    baseline = {
        "repeats": "first come first served",
        "open": "first come first served as measured within its time",
        "starves": "first come first served, where a robot stands still for ever",
        "deadlock": "",
    }[found.baseline_ends]
    if not found.baseline:
        yield "throughput: first come first served ends in a deadlock"
    elif found.throughput < found.baseline:
        below = float(1 - found.throughput / found.baseline)
        yield from wrapped(f"throughput: {below:.2%} below {baseline} (give more time)")
    else:
        gain = float(found.throughput / found.baseline - 1)
        yield from wrapped(f"throughput: {gain:+.1%} against {baseline}")
    share = f"{float(found.fairness):.0%}"
    yield f"fairness: every robot makes at least {share} of the laps that it makes alone"
