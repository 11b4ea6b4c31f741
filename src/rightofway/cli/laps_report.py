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
    Bottleneck,
    Comparison,
    CyclicResult,
    GroupResult,
    LapWait,
    ParameterEffect,
    in_words,
    parameter_effects,
)
from rightofway.model import Scenario

__all__ = ["comparison_lines", "laps_data", "laps_report"]

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
        "groups": [_group_data(run, group) for group in run.groups],
    }


def _group_data(run: CyclicResult, group: GroupResult) -> dict[str, Any]:
    names, pattern = _names(run, group), group.pattern
    time = run.scenario.problem.clock.time
    means = [None if mean is None else str(mean * time(1)) for mean in group.mean_laps()]
    shares = [None if share is None else str(share) for share in group.waiting_shares()]
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
        "measured": _measured_data(run, group),
        "waiting_share": dict(zip(names, shares, strict=True)),
    }
    if _is_long(group):
        data |= dict.fromkeys(("conflicts", "first_lap", "bottleneck", "sensitivity"))
    else:
        data |= {
            "conflicts": [_wait_data(run, wait, "offset") for wait in group.waits()],
            "first_lap": [_wait_data(run, wait, "time") for wait in group.first_waits()],
            "bottleneck": _bottleneck_data(run.scenario, group.bottleneck()),
            "sensitivity": _sensitivity_data(run.scenario, group),
        }
    return data | _baseline_data(run.scenario, group.comparison)


def _names(run: CyclicResult, group: GroupResult) -> list[str]:
    return [run.scenario.robots[robot].name for robot in group.robots]


def _is_long(group: GroupResult) -> bool:
    """Return whether a period is too long to be computed visit by visit."""
    return group.pattern is not None and group.pattern.n_visits > MAX_VISITS


def _measured_data(run: CyclicResult, group: GroupResult) -> dict[str, Any] | None:
    """Return which laps the means are of, where no period is known."""
    if group.pattern:
        return None
    measured, names = group.measured(), _names(run, group)
    return {
        "from": str(run.scenario.problem.clock.time(measured.warm_up)),
        "laps": dict(zip(names, measured.laps, strict=True)),
    }


def _wait_data(run: CyclicResult, wait: LapWait, when: str) -> dict[str, Any]:
    time, robots = run.scenario.problem.clock.time, run.scenario.robots
    return {
        "vertex": run.scenario.roadmap.name(wait.vertex),
        "robots": [robots[robot].name for robot in wait.pair],
        "waits": robots[wait.waits].name,
        when: str(time(wait.tick)),
        "for": str(time(wait.ticks)),
    }


def _bottleneck_data(scenario: Scenario, bottleneck: Bottleneck | None) -> list[dict[str, Any]]:
    return [
        {
            "kind": piece.kind,
            "robot": scenario.robots[piece.robot].name,
            "vertices": [scenario.roadmap.name(place) for place in piece.places],
            "for": str(scenario.problem.clock.time(piece.ticks)),
        }
        for piece in (bottleneck.pieces if bottleneck else ())
    ]


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


def _baseline_data(scenario: Scenario, found: Comparison | None) -> dict[str, Any]:
    if found is None:
        return {}
    hour = HOUR / scenario.problem.clock.tick
    return {
        "throughput_per_hour": str(found.throughput * hour),
        "fairness": str(found.fairness),
        "first_come": {
            "ends": found.baseline_ends,
            "throughput_per_hour": str(found.baseline * hour),
        },
    }


def laps_report(run: CyclicResult) -> str:
    """Return a result for people."""
    return "\n".join(_lines(run))


def _lines(run: CyclicResult) -> Iterator[str]:
    together = [group for group in run.groups if len(group.robots) > 1]
    yield f"rule        {run.rule}, on {run.routes} routes"
    yield f"groups      {_groups(run, together)}"
    yield f"throughput  {_short(HOUR * run.throughput())} laps in {HOUR} time units"
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MAX_GROUPS]:
        yield ""
        yield from _group_lines(run, group)
        if group.comparison is not None:
            yield from comparison_lines(group.comparison)
    if len(largest) > MAX_GROUPS:
        yield ""
        yield f"… and {len(largest) - MAX_GROUPS} more groups, none larger (--json has them all)"


def _groups(run: CyclicResult, together: Sequence[GroupResult]) -> str:
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], "periodic"),
        (ends["deadlock"], "in deadlock"),
        (ends["open"], "open: time ran out"),
    ]
    found = [f"{number} of {len(together)} {words}" for number, words in counts if number]
    alone = len(run.groups) - len(together)
    return "; ".join([*found, *([f"{alone} robots meet no other"] if alone else [])])


def _group_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    time, size = run.scenario.problem.clock.time, f"{len(group.robots)} robots"
    if group.pattern is None:
        yield from wrapped(f"{size}: {group.why}. {_source_of_means(run, group)}:")
        yield from _robot_lines(run, group)
        return
    period, since = time(group.pattern.period), time(group.pattern.transient)
    yield f"{size}: period {period}, from time {since} on"
    yield from _robot_lines(run, group)
    if _is_long(group):
        yield f"waits and bottleneck: not computed for a period of more than {MAX_VISITS} visits"
        return
    yield from _wait_lines(run, group)
    bottleneck = group.bottleneck()
    if bottleneck:
        yield from wrapped(f"bottleneck: {in_words(bottleneck, run.scenario)}")
        yield from _sensitivity_lines(run.scenario, group)


def _source_of_means(run: CyclicResult, group: GroupResult) -> str:
    """Say which laps the means are of, where no period is known."""
    if group.ends == "deadlock":
        return "Laps until then"
    measured = group.measured()
    laps = sum(measured.laps) / len(measured.laps)
    since = _short(run.scenario.problem.clock.time(measured.warm_up))
    return f"Measured, not proven: means of {laps:.1f} laps per robot from time {since} on"


def _robot_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    names, tick = _names(run, group), run.scenario.problem.clock.tick
    routes = group.context.laps
    counts = group.pattern.counts if group.pattern else group.measured().laps
    title = "laps/period" if group.pattern else "laps"
    width = max(map(len, ("robot", *names[:MAX_LINES])))
    yield f"{'robot':{width}}  {title:>11}  mean lap     alone  waiting"
    rows = zip(names, counts, group.mean_laps(), group.waiting_shares(), routes, strict=True)
    for name, laps, mean, share, route in list(rows)[:MAX_LINES]:
        lap = ("never" if group.pattern else "?") if mean is None else _short(mean * tick)
        alone = _short(route.duration * tick)
        waits = "" if share is None else f"{float(share):7.1%}"
        yield f"{name:{width}}  {laps:11}  {lap:>8}  {alone:>8}  {waits}".rstrip()
    if len(names) > MAX_LINES:
        yield f"… and {len(names) - MAX_LINES} more robots"


def _short(number: Fraction) -> str:
    return str(number) if number.denominator <= MAX_DENOMINATOR else f"{float(number):.2f}"


def _wait_lines(run: CyclicResult, group: GroupResult) -> Iterator[str]:
    """Yield which robot waits where for which other, in each period and in the first lap."""
    first, periodic = _sites(run, group.first_waits()), _sites(run, group.waits())
    both = len(first.keys() & periodic.keys())
    yield f"waits: {len(first)} in the first lap, {len(periodic)} in each period, {both} in both"
    robots, place = run.scenario.robots, run.scenario.roadmap.name
    sites = [*periodic, *(site for site in first if site not in periodic)]
    for site in sites[:MAX_LINES]:
        vertex, waiting, awaited = site
        text = f"{place(vertex)}: {robots[waiting].name} waits for {robots[awaited].name}"
        when = [
            f"{words} {_times(found[site])}"
            for words, found in (("first lap at", first), ("each period at", periodic))
            if site in found
        ]
        yield from wrapped(f"{text}, {'; '.join(when)}", "  ")
    if len(sites) > MAX_LINES:
        yield f"  … and {len(sites) - MAX_LINES} more"


def _sites(run: CyclicResult, waits: Sequence[LapWait]) -> Sites:
    found: Sites = {}
    for wait in waits:
        when = run.scenario.problem.clock.time(wait.tick)
        found.setdefault((wait.vertex, wait.waits, wait.for_robot), []).append(when)
    return found


def _times(times: Sequence[Fraction]) -> str:
    listed = ", ".join(map(_short, times[:MAX_TIMES]))
    more = len(times) - MAX_TIMES
    return listed if more <= 0 else f"{listed} and {more} more times"


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
