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
from rightofway.model.place_names import PlaceNames
from rightofway.phrases import Phrase, chain_items, say_count
from rightofway.quantities import Quantities, format_decimal
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
    throughput = Phrase("{rate} laps per hour", rate=rate)
    if not run.scenario.units.time:
        throughput = Phrase("{rate} laps in {hour} time units", rate=rate, hour=str(HOUR))
    yield Facts(
        [
            (
                Phrase("rule"),
                Phrase("{rule}, on {routes} routes", rule=run.rule, routes=str(run.routes)),
            ),
            (Phrase("groups"), _groups(together, len(run.groups) - len(together))),
            (Phrase("throughput"), throughput),
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
        yield Phrase("… and {groups}, none larger (--json lists all)", groups=more)


def _groups(together: Sequence[GroupResult], alone: int) -> str:
    ends = Counter(group.ends for group in together)
    counts = [
        (ends["repeats"], Phrase("periodic")),
        (ends["deadlock"], Phrase("in deadlock")),
        (ends["open"], Phrase("open: time ran out")),
    ]
    groups: list[str] = [
        Phrase("{number} of {all} {end}", number=str(number), all=str(len(together)), end=end)
        for number, end in counts
        if number
    ]
    if alone:
        groups.append(say_count(alone, "robot meets no other", "robots meet no other"))
    return chain_items(groups, "{first}; {second}")


def _group_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[Part]:
    number = str(len(group.robots))
    if group.pattern is None:
        source = Phrase("Laps until then")
        if group.ends != "deadlock":
            measured = group.measure_laps()
            laps = format_decimal(Fraction(sum(measured.laps), len(measured.laps)), 1)
            source = Phrase(
                "Measured, not proven: means of {laps} laps per robot from {moment} on",
                laps=laps,
                moment=quantities.format_moment(measured.warm_up),
            )
        yield Phrase(
            "{number} robots: {why}. {source}:",
            number=number,
            why=write_reason(group, quantities),
            source=source,
        )
        yield _robot_table(scenario, quantities, group)
        yield from _further_robots(group)
        return
    yield Phrase(
        "{number} robots: period {period}, from {moment} on",
        number=number,
        period=quantities.format_duration(group.pattern.period),
        moment=quantities.format_moment(group.pattern.transient),
    )
    yield _robot_table(scenario, quantities, group)
    yield from _further_robots(group)
    yield from _stuck_lines(scenario, group)
    if is_long(group):
        yield Phrase(
            "waits and bottleneck: not computed for a period of more than {number} visits",
            number=str(MAX_VISITS),
        )
        return
    yield from _wait_lines(scenario, quantities, group)
    bottleneck = group.find_bottleneck()
    if bottleneck:
        circuit = describe_circuit(bottleneck.pieces, scenario)
        yield Phrase("bottleneck: {circuit}", circuit=circuit)
        yield from _sensitivity_lines(scenario, group)


def _robot_table(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Table:
    counts = group.pattern.counts if group.pattern else group.measure_laps().laps
    never: str = Phrase("never") if group.pattern else "?"
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
    laps_heading = Phrase("laps/period") if group.pattern else Phrase("laps")
    means, alone = map(quantities.format_heading, (Phrase("mean lap"), Phrase("alone")))
    return Table((Phrase("robot"), laps_heading, means, alone, Phrase("waits")), rows)


def _further_robots(group: GroupResult) -> Iterator[Part]:
    if len(group.robots) > MAX_LINES:
        more = say_count(len(group.robots) - MAX_LINES, "more robot", "more robots")
        yield Phrase("… and {robots} (--json lists all)", robots=more)


def _stuck_lines(scenario: Scenario, group: GroupResult) -> Iterator[Part]:
    """Yield which robots make no lap in a pattern, where they stand and where they want to go."""
    counts = group.pattern.counts if group.pattern else ()
    stuck = [robot for robot, laps in enumerate(counts) if not laps]
    place, listed = PlaceNames(scenario, numbered=True), list[str]()
    for robot in stuck[:MAX_LINES]:
        name = scenario.robots[group.robots[robot]].name
        route, last = group.context.routes[robot], len(group.history[robot]) - 1
        values = {"place": place(route.get_vertex(last)), "next": place(route.get_vertex(last + 1))}
        listed.append(Phrase("{robot} in {place} on its way to {next}", robot=name, **values))
    if len(stuck) > MAX_LINES:
        listed.append(Phrase("{number} more", number=str(len(stuck) - MAX_LINES)))
    if listed:
        yield Phrase(
            "{stand} still for ever: {robots} (another --rule may help, for example timetable)",
            stand=say_count(len(stuck), "robot stands", "robots stand"),
            robots=chain_items(listed),
        )


def _wait_lines(scenario: Scenario, quantities: Quantities, group: GroupResult) -> Iterator[Part]:
    """Yield which robot waits where for which other, in each period and in the first lap."""
    first, periodic = _sites(group.list_first_waits()), _sites(group.waits())
    yield Phrase(
        "waits: {first} in the first lap, {periodic} in each period, {both} in both",
        first=str(len(first)),
        periodic=str(len(periodic)),
        both=str(len(first.keys() & periodic.keys())),
    )
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True)
    sites = list(periodic | first)
    for site in sites[:MAX_LINES]:
        vertex, beside, waiting, awaited = site
        where = place(vertex)
        if beside is not None and place(beside) != where:
            where = Phrase("{place} beside {other}", place=where, other=place(beside))
        when: list[str] = []
        if site in first:
            moments = _moments(quantities, first[site])
            when.append(Phrase("first lap at {moments}", moments=moments))
        if site in periodic:
            moments = _moments(quantities, periodic[site])
            when.append(Phrase("each period at {moments}", moments=moments))
        text = Phrase(
            "{place}: {robot} waits for {other}, {when}",
            place=where,
            robot=robots[waiting].name,
            other=robots[awaited].name,
            when=chain_items(when, "{first}; {second}"),
        )
        yield Paragraph(text, "  ")
    if len(sites) > MAX_LINES:
        yield Paragraph(Phrase("… and {number} more", number=str(len(sites) - MAX_LINES)), "  ")


def _sites(waits: Sequence[LapWait]) -> Sites:
    sites: Sites = {}
    for wait in waits:
        site = wait.vertex, wait.beside, wait.waits, wait.for_robot
        sites.setdefault(site, []).append(wait.tick)
    return sites


def _moments(quantities: Quantities, ticks: Sequence[Tick]) -> str:
    """Return several times: ``5.35 s, 1 min 56.2 s and 1 more time``, ``time 4, 13``."""
    others = map(choose_further_format(quantities), ticks[1:MAX_TIMES])
    listed = chain_items([quantities.format_moment(ticks[0]), *others])
    more = len(ticks) - MAX_TIMES
    if more <= 0:
        return listed
    return Phrase(
        "{first} and {last}", first=listed, last=say_count(more, "more time", "more times")
    )


def _sensitivity_lines(scenario: Scenario, group: GroupResult) -> Iterator[Part]:
    """Say which changes of a parameter by 10 % would shorten the period."""
    graph = group.build_graph()
    if graph is None:
        return
    if len(graph.vertex) > MAX_VISITS_OF_SENSITIVITY:
        most = str(MAX_VISITS_OF_SENSITIVITY)
        text = Phrase("sensitivity: not computed for more than {number} visits", number=most)
        yield Paragraph(text, "  ")
        return
    effects = compute_parameter_effects(scenario, graph, most=MAX_EFFECTS)
    helpful = [
        parameter for parameter in effects if parameter.ten_per_cent < parameter.effect.cycle_time
    ]
    for parameter in helpful:
        text = Phrase(
            "{change}: the period gets {share} shorter",
            change=_change(scenario, parameter),
            share=f"{float(1 - parameter.ten_per_cent / parameter.effect.cycle_time):.2%}",
        )
        yield Paragraph(text, "  ")
    if not helpful:
        text = Phrase("no single change shortens the period: another circuit is as long")
        yield Paragraph(text, "  ")


def _change(scenario: Scenario, effect: ParameterEffect) -> Phrase:
    if effect.robot is None:
        return Phrase("10% less headway")
    robot = scenario.robots[effect.robot]
    if effect.kind == "speed":
        return Phrase("{robot} 10% faster", robot=robot.name)
    if effect.stop is None:
        return Phrase("{robot} 10% less turning", robot=robot.name)
    where = PlaceNames(scenario, numbered=True).describe_place(robot.stops[effect.stop].at)
    return Phrase("{robot} 10% less work at {place}", robot=robot.name, place=where)


BASELINES = {
    "repeats": Phrase("first come first served"),
    "open": Phrase("first come first served as measured within its time"),
    "starves": Phrase("first come first served, where a robot stands still for ever"),
}
"""What a timetable is compared with, by how that ends."""


def report_comparison(comparison: BaselineComparison) -> Iterator[Phrase]:
    """Yield how a timetable compares with its baseline, and how fair it is."""
    if not comparison.baseline:
        yield Phrase("throughput: first come first served ends in a deadlock")
    elif comparison.throughput < comparison.baseline:
        yield Phrase(
            "throughput: {share} below {baseline} (give more time)",
            share=f"{float(1 - comparison.throughput / comparison.baseline):.2%}",
            baseline=BASELINES[comparison.baseline_ends],
        )
    else:
        yield Phrase(
            "throughput: {share} against {baseline}",
            share=f"{float(comparison.throughput / comparison.baseline - 1):+.1%}",
            baseline=BASELINES[comparison.baseline_ends],
        )
    yield Phrase(
        "fairness: every robot makes at least {share} of the laps that it makes alone",
        share=f"{float(comparison.fairness):.0%}",
    )
