"""Reports on work that repeats: period, waits, bottleneck, sensitivity, comparison with a baseline.

The baseline of a timetable is the rule first come first served.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import islice
from typing import Any

from rightofway.cli.terminal import COLUMNS, counted, further, measures, short, wrapped
from rightofway.cyclic import (
    Bottleneck,
    Comparison,
    CyclicResult,
    GroupResult,
    LapWait,
    ParameterEffect,
    bottleneck_along,
    in_words,
    parameter_curves,
    parameter_effects,
    visits_along,
)
from rightofway.errors import GaveUp
from rightofway.model import Scenario, Tick
from rightofway.model.place_names import PlaceNames
from rightofway.quantities import Quantities, decimal
from rightofway.values import written

HOUR = 3600
"""Seconds in an hour; where the time unit is not known, laps are counted in as many time units."""

MAX_GROUPS = 3
"""Groups in the report; --json has them all."""

MAX_LINES = 12
"""Lines of a list; longer lists end with the number of further ones."""

MAX_TIMES = 4
"""Times of one wait within a period that the report lists; further ones are counted."""

MAX_EFFECTS = 3
"""Changes in the report that would shorten the period; --json has more."""

MAX_VISITS = 1_000_000
"""Visits of a period in which waits and bottleneck are computed."""

MAX_VISITS_OF_SENSITIVITY = 200_000
"""Visits of a period whose sensitivity is computed; each parameter takes a search."""

MAX_STEPS = 2_000
"""Visits of a circuit that --json lists for curves; a longer one has no pieces there."""

BY_VISIT = ("conflicts", "first_lap", "bottleneck", "sensitivity", "curves")
"""Keys of --json that are computed visit by visit."""

Sites = dict[tuple[int, int | None, int, int], list[Tick]]
"""Waits by vertex, the other robot's vertex, waiting and awaited robot: their times [ticks]."""


def laps_data(run: CyclicResult, *, by_visit: bool = True) -> dict[str, Any]:
    """Return a result for programs: plain data, exact times [time unit].

    Parameters
    ----------
    run
        The result.
    by_visit
        Whether waits, bottlenecks and curves are wanted, which take longest.
    """
    return {
        "rule": run.rule,
        "routes": run.routes,
        **measures(run.scenario),
        "throughput_per_hour": written(_hour(run.scenario) * run.throughput()),
        "groups": [_group_data(run.scenario, group, by_visit=by_visit) for group in run.groups],
    }


def _hour(scenario: Scenario) -> Fraction:
    """Return the time units of an hour, or 3600 where they are not known."""
    return HOUR / (scenario.units.seconds or Fraction(1))


def _group_data(scenario: Scenario, group: GroupResult, *, by_visit: bool) -> dict[str, Any]:
    robots, place, clock = scenario.robots, scenario.roadmap.name, scenario.problem.clock
    names, pattern, measured, time = _names(scenario, group), group.pattern, None, clock.time
    means = [None if mean is None else written(mean * clock.tick) for mean in group.mean_laps()]
    shares = [None if share is None else written(share) for share in group.waiting_shares()]
    if pattern is None:
        found = group.measured()
        laps = dict(zip(names, found.laps, strict=True))
        measured = {"from": written(time(found.warm_up)), "laps": laps}

    def waits_data(waits: Sequence[LapWait], when: str) -> list[dict[str, Any]]:
        return [
            {
                "vertex": place(wait.vertex),
                **({} if wait.beside is None else {"beside": place(wait.beside)}),
                "robots": [robots[robot].name for robot in wait.pair],
                "waits": robots[wait.waits].name,
                when: written(time(wait.tick)),
                "for": written(time(wait.ticks)),
            }
            for wait in waits
        ]

    data: dict[str, Any] = {
        "robots": names,
        "ends": group.ends,
        "why": group.why,
        "transient": written(time(pattern.transient)) if pattern else None,
        "begins": written(time(pattern.begins)) if pattern else None,
        "period": written(time(pattern.period)) if pattern else None,
        "laps_per_period": dict(zip(names, pattern.counts, strict=True)) if pattern else None,
        "laps_made": dict(zip(names, group.laps_made(), strict=True)),
        "mean_lap": dict(zip(names, means, strict=True)),
        "measured": measured,
        "waiting_share": dict(zip(names, shares, strict=True)),
    }
    if _is_long(group) or not by_visit:
        data |= dict.fromkeys(BY_VISIT)
    else:
        bottleneck = group.bottleneck()
        data |= {
            "conflicts": waits_data(group.waits(), "offset"),
            "first_lap": waits_data(group.first_waits(), "time"),
            "bottleneck": _pieces_data(scenario, bottleneck),
            "sensitivity": _sensitivity_data(scenario, group),
            "curves": _curves_data(scenario, group),
        }
    if group.comparison is not None:
        hour = _hour(scenario) / clock.tick
        data |= {
            "throughput_per_hour": written(group.comparison.throughput * hour),
            "fairness": written(group.comparison.fairness),
            "first_come": {
                "ends": group.comparison.baseline_ends,
                "throughput_per_hour": written(group.comparison.baseline * hour),
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
            "gain": written(one.effect.gain * tick),
            "loss": written(one.effect.loss * tick),
            "until": written(one.effect.until),
            "at_best": written(one.effect.at_best * tick),
            "ten_per_cent": written(one.ten_per_cent * tick),
        }
        for one in parameter_effects(scenario, graph)
    ]


def _pieces_data(scenario: Scenario, bottleneck: Bottleneck | None) -> list[dict[str, Any]]:
    place, clock = scenario.roadmap.name, scenario.problem.clock
    return [
        {
            "kind": piece.kind,
            "robot": scenario.robots[piece.robot].name,
            "vertices": [place(vertex) for vertex in piece.places],
            "for": written(clock.time(piece.ticks)),
        }
        for piece in (bottleneck.pieces if bottleneck else ())
    ]


def _curves_data(scenario: Scenario, group: GroupResult) -> dict[str, Any] | None:
    """Return the period as a function of each parameter, and the circuits that decide it.

    The period is ``fixed + slope * value``; of a speed ``fixed + slope / value``.
    """
    graph, pattern = group.graph(), group.pattern
    if graph is None or pattern is None or len(graph) > MAX_VISITS_OF_SENSITIVITY:
        return None
    data: dict[str, Any] = {"exact": scenario.problem.clock.exact, "why": ""}
    try:
        found = parameter_curves(scenario, graph)
    except GaveUp as error:
        return data | {"why": str(error), "curves": [], "circuits": []}
    circuits: dict[tuple[int, ...], int] = {}
    curves = [
        {
            "kind": curve.kind,
            "robot": None if curve.robot is None else scenario.robots[curve.robot].name,
            "stop": curve.stop,
            "value": written(curve.value),
            "pieces": [
                {
                    "from": written(piece.start),
                    "to": written(piece.until),
                    "fixed": written(piece.fixed),
                    "slope": written(piece.slope),
                    "circuit": circuits.setdefault(tuple(piece.arcs.tolist()), len(circuits)),
                }
                for piece in curve.pieces
            ],
        }
        for curve in found
    ]
    listed = []
    for arcs in circuits:
        if len(arcs) > MAX_STEPS:
            listed.append(
                {"periods": int(graph.arcs.height[list(arcs)].sum()), "pieces": [], "visits": []}
            )
            continue
        bottleneck = bottleneck_along(graph, arcs)
        visits = [list(visit) for visit in visits_along(group, pattern, graph, arcs)]
        pieces = _pieces_data(scenario, bottleneck)
        listed.append({"periods": bottleneck.periods, "pieces": pieces, "visits": visits})
    return data | {"curves": curves, "circuits": listed}


def laps_report(run: CyclicResult, quantities: Quantities) -> str:
    """Return a result for people."""
    together = [group for group in run.groups if len(group.robots) > 1]
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], "periodic"),
        (ends["deadlock"], "in deadlock"),
        (ends["open"], "open: time ran out"),
    ]
    groups = [f"{number} of {len(together)} {words}" for number, words in counts if number]
    alone = len(run.groups) - len(together)
    if alone:
        groups.append("1 robot meets no other" if alone == 1 else f"{alone} robots meet no other")
    per = "per hour" if run.scenario.units.time else f"in {HOUR} time units"
    lines = [
        f"rule        {run.rule}, on {run.routes} routes",
        f"groups      {'; '.join(groups)}",
        f"throughput  {decimal(_hour(run.scenario) * run.throughput())} laps {per}",
    ]
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MAX_GROUPS]:
        lines += ["", *_group_lines(run.scenario, quantities, group)]
        if group.comparison is not None:
            lines += comparison_lines(group.comparison)
    if len(largest) > MAX_GROUPS:
        more = counted(len(largest) - MAX_GROUPS, "more group")
        lines += ["", f"… and {more}, none larger (--json lists all)"]
    return "\n".join(lines)


def _group_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[str]:
    size = f"{len(group.robots)} robots"
    if group.pattern is None:
        source = "Laps until then"
        if group.ends != "deadlock":
            measured = group.measured()
            laps = decimal(Fraction(sum(measured.laps), len(measured.laps)), 1)
            source = (
                f"Measured, not proven: means of {laps} laps per robot"
                f" from {quantities.moment(measured.warm_up)} on"
            )
        yield from wrapped(f"{size}: {group.why}. {source}:")
        yield from _robot_lines(scenario, quantities, group)
        return
    period, since = group.pattern.period, group.pattern.transient
    repeats = f"period {quantities.duration(period)}, from {quantities.moment(since)} on"
    yield from wrapped(f"{size}: {repeats}")
    yield from _robot_lines(scenario, quantities, group)
    yield from _stuck_lines(scenario, group)
    if _is_long(group):
        yield f"waits and bottleneck: not computed for a period of more than {MAX_VISITS} visits"
        return
    yield from _wait_lines(scenario, quantities, group)
    bottleneck = group.bottleneck()
    if bottleneck:
        yield from wrapped(f"bottleneck: {in_words(bottleneck, scenario)}")
        yield from _sensitivity_lines(scenario, group)


def _robot_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[str]:
    counts = group.pattern.counts if group.pattern else group.measured().laps
    never, cell, heading = "never" if group.pattern else "?", quantities.cell, quantities.heading
    rows = [
        ("laps/period" if group.pattern else "laps", heading("mean lap"), heading("alone"), "waits")
    ]
    rows += [
        (
            str(laps),
            never if mean is None else cell(mean),
            cell(route.duration),
            "" if share is None else f"{float(share):.1%}",
        )
        for laps, mean, share, route in islice(
            zip(counts, group.mean_laps(), group.waiting_shares(), group.context.laps, strict=True),
            MAX_LINES,
        )
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    room = COLUMNS - sum(widths) - 2 * len(widths)
    names = ["robot", *(short(name, room) for name in _names(scenario, group)[:MAX_LINES])]
    width = max(map(len, names))
    for name, cells in zip(names, rows, strict=True):
        line = "  ".join(f"{text:>{space}}" for text, space in zip(cells, widths, strict=True))
        yield f"{name:{width}}  {line}".rstrip()
    if len(group.robots) > MAX_LINES:
        yield f"… and {counted(len(group.robots) - MAX_LINES, 'more robot')} (--json lists all)"


def _stuck_lines(scenario: Scenario, group: GroupResult) -> Iterator[str]:
    """Yield which robots make no lap in a pattern, where they stand and where they want to go."""
    counts = group.pattern.counts if group.pattern else ()
    stuck = [robot for robot, laps in enumerate(counts) if not laps]
    place, listed = PlaceNames(scenario, numbered=True), list[str]()
    for robot in stuck[:MAX_LINES]:
        name = scenario.robots[group.robots[robot]].name
        route, last = group.context.routes[robot], len(group.history[robot]) - 1
        here, there = place(route.vertex(last)), place(route.vertex(last + 1))
        listed.append(f"{name} in {here} on its way to {there}")
    if len(stuck) > MAX_LINES:
        listed.append(f"{len(stuck) - MAX_LINES} more")
    if listed:
        never = "1 robot stands" if len(stuck) == 1 else f"{len(stuck)} robots stand"
        remedy = "another --rule may help, for example timetable"
        yield from wrapped(f"{never} still for ever: {', '.join(listed)} ({remedy})")


def _wait_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[str]:
    """Yield which robot waits where for which other, in each period and in the first lap."""
    first, periodic = _sites(group.first_waits()), _sites(group.waits())
    both = len(first.keys() & periodic.keys())
    yield f"waits: {len(first)} in the first lap, {len(periodic)} in each period, {both} in both"
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True)
    sites = list(periodic | first)
    for site in sites[:MAX_LINES]:
        vertex, beside, waiting, awaited = site
        where = place(vertex) if beside is None else f"{place(vertex)} beside {place(beside)}"
        text = f"{where}: {robots[waiting].name} waits for {robots[awaited].name}"
        when = [
            f"{words} at {_moments(quantities, found[site])}"
            for words, found in (("first lap", first), ("each period", periodic))
            if site in found
        ]
        yield from wrapped(f"{text}, {'; '.join(when)}", "  ")
    if len(sites) > MAX_LINES:
        yield f"  … and {len(sites) - MAX_LINES} more"


def _sites(waits: Sequence[LapWait]) -> Sites:
    found: Sites = {}
    for wait in waits:
        site = wait.vertex, wait.beside, wait.waits, wait.for_robot
        found.setdefault(site, []).append(wait.tick)
    return found


def _moments(quantities: Quantities, ticks: Sequence[Tick]) -> str:
    """Return several times: ``5.35 s, 1 min 56.2 s and 1 more time``, ``time 4, 13``."""
    others = map(further(quantities), ticks[1:MAX_TIMES])
    listed = ", ".join([quantities.moment(ticks[0]), *others])
    more = len(ticks) - MAX_TIMES
    return f"{listed} and {counted(more, 'more time')}" if more > 0 else listed


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
    where = PlaceNames(scenario, numbered=True).where(robot.stops[effect.stop].at)
    return f"{robot.name} 10% less work at {where}"


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
