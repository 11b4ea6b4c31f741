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
    compute_parameter_effects,
)
from rightofway.model import Scenario, Tick
from rightofway.report.circuits import describe_circuit
from rightofway.report.laps_data import (
    HOUR,
    MAX_VISITS,
    MAX_VISITS_OF_SENSITIVITY,
    compute_hour,
    is_long,
    list_names,
    write_reason,
)
from rightofway.report.lines import Facts, Paragraph, Part, Table, choose_further_format, lay_out
from rightofway.report.phrases import chain_items, say_count
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities, format_decimal

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


def report_laps(run: CyclicResult, quantities: Quantities) -> str:
    """Return a result for people."""
    return lay_out(_report(run, quantities))


def _report(run: CyclicResult, quantities: Quantities) -> Iterator[Part]:
    together = [group for group in run.groups if len(group.robots) > 1]
    rate = format_decimal(compute_hour(run.scenario) * run.compute_throughput())
    throughput = f"{rate} laps per hour"
    if not run.scenario.units.time:
        throughput = f"{rate} laps in {HOUR} time units"
    yield Facts(
        [
            (
                "rule",
                f"{run.rule}, on {run.routes} routes",
            ),
            ("groups", _write_groups(together, len(run.groups) - len(together))),
            ("throughput", throughput),
        ]
    )
    largest = sorted(together, key=lambda group: -len(group.robots))
    for group in largest[:MAX_GROUPS]:
        yield ""
        yield from _group_lines(run.scenario, quantities, group)
        if group.comparison is not None:
            yield from report_comparison(group.comparison)
    if len(largest) > MAX_GROUPS:
        more = say_count(len(largest) - MAX_GROUPS, "more group", "more groups")
        yield ""
        yield f"… and {more}, none larger (--json lists all)"


def _write_groups(together: Sequence[GroupResult], alone: int) -> str:
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], "periodic"),
        (ends["deadlock"], "in deadlock"),
        (ends["open"], "open: time ran out"),
    ]
    groups: list[str] = [f"{number} of {len(together)} {end}" for number, end in counts if number]
    if alone:
        groups.append(say_count(alone, "robot meets no other", "robots meet no other"))
    return chain_items(groups, "two clauses")


def _group_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[Part]:
    number = str(len(group.robots))
    if group.pattern is None:
        source = "Laps until then"
        if group.ends != "deadlock":
            measured = group.measure_laps()
            laps = format_decimal(Fraction(sum(measured.laps), len(measured.laps)), 1)
            source = (
                f"Measured, not proven: means of {laps} laps per robot from"
                f" {quantities.format_moment(measured.warm_up)} on"
            )
        yield f"{number} robots: {write_reason(group, quantities)}. {source}:"
        yield _make_robot_table(scenario, quantities, group)
        yield from _write_further_robots(group)
        return
    yield (
        f"{number} robots: period {quantities.format_duration(group.pattern.period)},"
        f" from {quantities.format_moment(group.pattern.transient)} on"
    )
    yield _make_robot_table(scenario, quantities, group)
    yield from _write_further_robots(group)
    yield from _write_stuck_lines(scenario, group)
    if is_long(group):
        yield f"waits and bottleneck: not computed for a period of more than {MAX_VISITS} visits"
        return
    yield from _wait_lines(scenario, quantities, group)
    bottleneck = group.find_bottleneck()
    if bottleneck:
        circuit = describe_circuit(bottleneck.pieces, scenario)
        yield f"bottleneck: {circuit}"
        yield from _write_sensitivity(scenario, group)


def _make_robot_table(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Table:
    counts = group.pattern.counts if group.pattern else group.measure_laps().laps
    never: str = "never" if group.pattern else "?"
    rows = [
        [
            name,
            str(laps),
            never if mean is None else quantities.format_cell(mean),
            quantities.format_cell(route.duration),
            "" if share is None else f"{float(share):.1%}",
        ]
        for name, laps, mean, share, route in islice(
            zip(
                list_names(scenario, group),
                counts,
                group.compute_mean_laps(),
                group.compute_waiting_shares(),
                group.context.laps,
                strict=True,
            ),
            MAX_LINES,
        )
    ]
    laps_heading = "laps/period" if group.pattern else "laps"
    means, alone = map(quantities.format_heading, ("mean lap", "alone"))
    return Table(("robot", laps_heading, means, alone, "waits"), rows)


def _write_further_robots(group: GroupResult) -> Iterator[Part]:
    if len(group.robots) > MAX_LINES:
        more = say_count(len(group.robots) - MAX_LINES, "more robot", "more robots")
        yield f"… and {more} (--json lists all)"


def _write_stuck_lines(scenario: Scenario, group: GroupResult) -> Iterator[Part]:
    """Yield which robots make no lap in a pattern, where they stand and where they want to go."""
    counts = group.pattern.counts if group.pattern else ()
    stuck = [robot for robot, laps in enumerate(counts) if not laps]
    place, listed = PlaceNames(scenario, numbered=True), list[str]()
    for robot in stuck[:MAX_LINES]:
        name = scenario.robots[group.robots[robot]].name
        route, last = group.context.routes[robot], len(group.history[robot]) - 1
        values = {"place": place(route.get_vertex(last)), "next": place(route.get_vertex(last + 1))}
        listed.append("{robot} in {place} on its way to {next}".format(robot=name, **values))
    if len(stuck) > MAX_LINES:
        listed.append(f"{len(stuck) - MAX_LINES} more")
    if listed:
        yield (
            "{stand} still permanently: {robots} (another --rule may help, for example timetable)"
        ).format(
            stand=say_count(len(stuck), "robot stands", "robots stand"),
            robots=chain_items(listed),
        )


def _wait_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[Part]:
    """Yield which robot waits where for which other, in each period and in the first lap."""
    first, periodic = _join_sites(group.list_first_waits()), _join_sites(group.waits())
    yield (
        f"waits: {len(first)} in the first lap, {len(periodic)} in each period,"
        f" {len(first.keys() & periodic.keys())} in both"
    )
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True)
    sites = list(periodic | first)
    for site in sites[:MAX_LINES]:
        vertex, beside, waiting, awaited = site
        where = place(vertex)
        if beside is not None and place(beside) != where:
            where = f"{where} beside {place(beside)}"
        when: list[str] = []
        if site in first:
            moments = _write_moments(quantities, first[site])
            when.append(f"first lap at {moments}")
        if site in periodic:
            moments = _write_moments(quantities, periodic[site])
            when.append(f"each period at {moments}")
        text = "{place}: {robot} waits for {other}, {when}".format(
            place=where,
            robot=robots[waiting].name,
            other=robots[awaited].name,
            when=chain_items(when, "two clauses"),
        )
        yield Paragraph(text, "  ")
    if len(sites) > MAX_LINES:
        yield Paragraph(f"… and {len(sites) - MAX_LINES} more", "  ")


def _join_sites(waits: Sequence[LapWait]) -> Sites:
    sites: Sites = {}
    for wait in waits:
        site = wait.vertex, wait.beside, wait.waits, wait.for_robot
        sites.setdefault(site, []).append(wait.tick)
    return sites


def _write_moments(quantities: Quantities, ticks: Sequence[Tick]) -> str:
    """Return several times: ``5.35 s, 1 min 56.2 s and 1 more time``, ``time 4, 13``."""
    others = map(choose_further_format(quantities), ticks[1:MAX_TIMES])
    listed = chain_items([quantities.format_moment(ticks[0]), *others])
    more = len(ticks) - MAX_TIMES
    if more <= 0:
        return listed
    return "{first} and {last}".format(
        first=listed, last=say_count(more, "more time", "more times")
    )


def _write_sensitivity(scenario: Scenario, group: GroupResult) -> Iterator[Part]:
    """Say which changes of a parameter by 10 % would shorten the period."""
    graph = group.build_graph()
    if graph is None:
        return
    if len(graph.vertex) > MAX_VISITS_OF_SENSITIVITY:
        most = str(MAX_VISITS_OF_SENSITIVITY)
        text = f"sensitivity: not computed for more than {most} visits"
        yield Paragraph(text, "  ")
        return
    effects = compute_parameter_effects(scenario, graph, most=MAX_EFFECTS)
    helpful = [
        parameter for parameter in effects if parameter.ten_per_cent < parameter.effect.cycle_time
    ]
    for parameter in helpful:
        text = "{change}: the period gets {share} shorter".format(
            change=_change(scenario, parameter),
            share=f"{float(1 - parameter.ten_per_cent / parameter.effect.cycle_time):.2%}",
        )
        yield Paragraph(text, "  ")
    if not helpful:
        text = "no single change shortens the period: another circuit is as long"
        yield Paragraph(text, "  ")


def _change(scenario: Scenario, effect: ParameterEffect) -> str:
    if effect.robot is None:
        return "10% less headway"
    robot = scenario.robots[effect.robot]
    if effect.kind == "speed":
        return f"{robot.name} 10% faster"
    if effect.stop is None:
        return f"{robot.name} 10% less turning"
    where = PlaceNames(scenario, numbered=True).describe_place(robot.stops[effect.stop].at)
    return f"{robot.name} 10% less work at {where}"


BASELINES = {
    "repeats": "first come first served",
    "open": "first come first served as measured within its time",
    "starves": "first come first served, where a robot is permanently stuck",
}
"""Baselines of a timetable, by their end."""


def report_comparison(comparison: BaselineComparison) -> Iterator[str]:
    """Yield how a timetable compares with its baseline, and how fair it is."""
    if not comparison.baseline:
        yield "throughput: first come first served ends in a deadlock"
    elif comparison.throughput < comparison.baseline:
        yield "throughput: {share} below {baseline} (give more time)".format(
            share=f"{float(1 - comparison.throughput / comparison.baseline):.2%}",
            baseline=BASELINES[comparison.baseline_ends],
        )
    else:
        yield "throughput: {share} against {baseline}".format(
            share=f"{float(comparison.throughput / comparison.baseline - 1):+.1%}",
            baseline=BASELINES[comparison.baseline_ends],
        )
    yield "fairness: every robot makes at least {share} of the laps that it makes alone".format(
        share=f"{float(comparison.fairness):.0%}",
    )
