"""Reports on work that repeats: period, waits, bottleneck, sensitivity, comparison with a baseline.

The baseline of a timetable is the rule first come first served.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import islice

from rightofway.cyclic import (
    BaselineComparison,
    CyclicResult,
    GroupResult,
    LapWait,
    ParameterEffect,
    parameter_effects,
)
from rightofway.model import Scenario, Tick
from rightofway.model.place_names import PlaceNames
from rightofway.quantities import Quantities, decimal
from rightofway.report.circuits import circuit_in_words
from rightofway.report.laps_data import (
    HOUR,
    MAX_VISITS,
    MAX_VISITS_OF_SENSITIVITY,
    hour_of,
    is_long,
    names_in,
)
from rightofway.report.lines import COLUMNS, counted, further, short, wrapped

MAX_GROUPS = 3
"""Groups in the report; --json has them all."""

MAX_LINES = 12
"""Lines of a list; longer lists end with the number of further ones."""

MAX_TIMES = 4
"""Times of one wait within a period that the report lists; further ones are counted."""

MAX_EFFECTS = 3
"""Changes in the report that would shorten the period; --json has more."""

Sites = dict[tuple[int, int | None, int, int], list[Tick]]
"""Waits by vertex, the other robot's vertex, waiting and awaited robot: their times [ticks]."""


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
        f"throughput  {decimal(hour_of(run.scenario) * run.throughput())} laps {per}",
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
    if is_long(group):
        yield f"waits and bottleneck: not computed for a period of more than {MAX_VISITS} visits"
        return
    yield from _wait_lines(scenario, quantities, group)
    bottleneck = group.bottleneck()
    if bottleneck:
        yield from wrapped(f"bottleneck: {circuit_in_words(bottleneck.pieces, scenario)}")
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
    names = ["robot", *(short(name, room) for name in names_in(scenario, group)[:MAX_LINES])]
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
        place_now, place_ahead = place(route.vertex(last)), place(route.vertex(last + 1))
        listed.append(f"{name} in {place_now} on its way to {place_ahead}")
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
            f"{words} at {_moments(quantities, waits[site])}"
            for words, waits in (("first lap", first), ("each period", periodic))
            if site in waits
        ]
        yield from wrapped(f"{text}, {'; '.join(when)}", "  ")
    if len(sites) > MAX_LINES:
        yield f"  … and {len(sites) - MAX_LINES} more"


def _sites(waits: Sequence[LapWait]) -> Sites:
    sites: Sites = {}
    for wait in waits:
        site = wait.vertex, wait.beside, wait.waits, wait.for_robot
        sites.setdefault(site, []).append(wait.tick)
    return sites


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
    helpful = [
        parameter for parameter in effects if parameter.ten_per_cent < parameter.effect.cycle_time
    ]
    for parameter in helpful:
        saved = 1 - parameter.ten_per_cent / parameter.effect.cycle_time
        change = _change(scenario, parameter)
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


def comparison_lines(comparison: BaselineComparison) -> Iterator[str]:
    """Yield how a timetable compares with its baseline, and how fair it is."""
    baseline = {
        "repeats": "first come first served",
        "open": "first come first served as measured within its time",
        "starves": "first come first served, where a robot stands still for ever",
        "deadlock": "",
    }[comparison.baseline_ends]
    if not comparison.baseline:
        yield "throughput: first come first served ends in a deadlock"
    elif comparison.throughput < comparison.baseline:
        below = float(1 - comparison.throughput / comparison.baseline)
        yield from wrapped(f"throughput: {below:.2%} below {baseline} (give more time)")
    else:
        gain = float(comparison.throughput / comparison.baseline - 1)
        yield from wrapped(f"throughput: {gain:+.1%} against {baseline}")
    share = f"{float(comparison.fairness):.0%}"
    yield f"fairness: every robot makes at least {share} of the laps that it makes alone"
