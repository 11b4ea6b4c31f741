"""Reports on a plan that is executed many times by robots that are late."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from rightofway.execution import PolicyGain, Quantiles, SimulationResult
from rightofway.model.place_names import PlaceNames
from rightofway.phrases import Phrase, chain_items, say_count
from rightofway.quantities import Quantities, format_decimal
from rightofway.report.lines import Facts, Part, Table, choose_further_format, lay_out, shorten_name

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""

MAX_SOURCES = 8
"""Places in the report where lateness began; --json has them all."""

LEAST_SHARE = 0.01
"""The report names a robot that causes at least this share of another one's lateness."""


def report(outcome: SimulationResult, quantities: Quantities) -> str:
    """Return how often robots collided, how late each one was, and where lateness began."""
    facts = Facts(list(_totals(outcome, quantities)))
    parts = [facts, "", *_robots(outcome, quantities), *_sources(outcome, quantities)]
    return lay_out(parts)


def _totals(outcome: SimulationResult, quantities: Quantities) -> Iterator[tuple[str, str]]:
    runs, late, gain = outcome.runs, outcome.lateness, outcome.gain
    yield (
        Phrase("runs"),
        Phrase(
            "{runs} with {delays}; seed {seed}",
            runs=str(runs),
            delays=", ".join(outcome.delays),
            seed=str(outcome.seed),
        ),
    )
    collisions = say_count(outcome.collisions or Phrase("no"), "collision", "collisions")
    deadlocks = say_count(outcome.deadlocks or Phrase("no"), "deadlock", "deadlocks")
    yield Phrase("right of way"), chain_items([collisions, deadlocks])
    yield Phrase("by the clock"), _by_clock(outcome, quantities)
    yield Phrase("late"), _lateness(late.all, quantities, is_delay=True)
    if late.flowtime.mean is not None:
        yield Phrase("flowtime"), _lateness(late.flowtime, quantities)
        yield Phrase("makespan"), _lateness(late.makespan, quantities)
    stranded = _mean(outcome.stranded, runs)
    if outcome.plan.scenario.closures:
        text = Phrase(
            "robots per run: {caught} are caught in a closure, {stranded} never complete",
            caught=_mean(outcome.caught, runs),
            stranded=stranded,
        )
        yield Phrase("closures"), text
    if outcome.switches:
        yield Phrase("switched"), _per_run(outcome.switches, runs)
    if outcome.replans:
        yield Phrase("replanned"), _per_run(outcome.replans, runs)
    if gain and gain.runs and gain.flowtime.mean is not None:
        yield Phrase("gain"), _gain(gain, gain.flowtime.mean, quantities)
    if outcome.broken:
        broken: str = Phrase(
            "robots per run: {broken} break down, {stranded} wait for them for ever",
            broken=_mean(outcome.broken, runs),
            stranded=stranded,
        )
        if outcome.replans:
            cut_off = _mean(outcome.cut_off, runs)
            broken = chain_items(
                [broken, Phrase("{number} are cut off from a place", number=cut_off)]
            )
        yield Phrase("broken"), broken


def _by_clock(outcome: SimulationResult, quantities: Quantities) -> Phrase:
    clock, runs = outcome.by_clock, outcome.runs
    if not clock.runs or clock.first.median is None:
        return Phrase("no run collides")
    return Phrase(
        "{share} of runs collide, {times}, first at {moment} (median)",
        share=f"{clock.runs / runs:.1%}",
        times=_per_run(clock.total, runs),
        moment=quantities.format_moment(clock.first.median),
    )


def _gain(gain: PolicyGain, saved: float, quantities: Quantities) -> Phrase:
    """Compare runs with the plan's rights of way in the same runs; a loss is below zero."""
    if not (gain.earlier or gain.later):
        return Phrase("none")
    values = {
        "time": quantities.format_duration(abs(saved)),
        "earlier": f"{gain.earlier / gain.runs:.0%}",
        "later": f"{gain.later / gain.runs:.0%}",
    }
    if saved < 0:
        return Phrase(
            "flowtime {time} more on average than with the plan's rights of way in the same runs;"
            " {earlier} of runs earlier, {later} later",
            **values,
        )
    return Phrase(
        "flowtime {time} less on average than with the plan's rights of way in the same runs;"
        " {earlier} of runs earlier, {later} later",
        **values,
    )


def _mean(number: int, runs: int) -> str:
    return format_decimal(Fraction(number, runs))


def _per_run(number: int, runs: int) -> Phrase:
    times = say_count(_mean(number, runs), "time", "times")
    return Phrase("{times} per run on average", times=times)


def _lateness(lateness: Quantiles, quantities: Quantities, *, is_delay: bool = False) -> Phrase:
    """Return how late robots are, or how much later a sum of their times is."""
    mean, most = lateness.mean, lateness.max
    if mean is None or most is None:
        return Phrase("no robot ever completes")
    write = choose_further_format(quantities)
    times = {"time": quantities.format_duration(abs(mean))}
    if mean < 0:
        average = Phrase("earlier by {time} on average", **times)
    elif is_delay:
        average = Phrase("by {time} on average", **times)
    else:
        average = Phrase("later by {time} on average", **times)
    quantiles = (
        (Phrase("median"), lateness.median),
        (Phrase("90% within"), lateness.p90),
        (Phrase("95% within"), lateness.p95),
    )
    parts: list[str] = [
        Phrase("{cause} {time}", cause=name, time=write(ticks))
        for name, ticks in quantiles
        if ticks is not None
    ]
    parts.append(Phrase("at most {time}", time=write(most)))
    return Phrase("{first}; {second}", first=average, second=chain_items(parts))


def _robots(outcome: SimulationResult, quantities: Quantities) -> Iterator[Part]:
    names = [shorten_name(robot.name) for robot in outcome.plan.scenario.robots]
    robots, cell = outcome.lateness.robots, quantities.format_cell
    latest = sorted(range(len(robots)), key=lambda robot: -(robots[robot].quantiles.mean or 0))
    listed = sorted(latest[:MAX_ROBOTS])
    rows = []
    for number in listed:
        robot, late = robots[number], robots[number].quantiles
        if late.mean is None or late.p95 is None or late.max is None:
            rows.append([names[number], Phrase("never completes")])
            continue
        waiting = [
            f"{names[other]} {cell(ticks)}"
            for other, ticks in robot.waiting.items()
            if ticks >= LEAST_SHARE * late.mean
        ]
        times = (cell(late.mean), cell(late.p95), cell(late.max), cell(robot.own))
        rows.append([names[number], *times, ", ".join(waiting[:3])])
    yield quantities.format_heading(Phrase("how late each robot is"))
    headings = (Phrase("mean"), "95%", Phrase("most"), Phrase("own"), Phrase("waiting for"))
    yield Table((Phrase("robot"), *headings), rows, has_remarks=True)
    if len(robots) > len(listed):
        more = say_count(len(robots) - len(listed), "more robot", "more robots")
        yield Phrase("… and {robots} that are less late", robots=more)


def _sources(outcome: SimulationResult, quantities: Quantities) -> Iterator[Part]:
    sources = outcome.lateness.sources
    if not sources:
        return
    scenario = outcome.plan.scenario
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True).describe_place
    rows = [
        [
            Phrase(
                "{robot} at {place}",
                robot=shorten_name(robots[source.robot].name),
                place=place(source.vertex),
            ),
            quantities.format_cell(source.own),
            quantities.format_cell(source.of_others),
        ]
        for source in sources[:MAX_SOURCES]
    ]
    yield ""
    yield quantities.format_heading(Phrase("where most lateness begins, mean per run"))
    yield Table((Phrase("robot"), Phrase("itself"), Phrase("others")), rows)
    if len(sources) > len(rows):
        more = say_count(len(sources) - len(rows), "more place", "more places")
        yield Phrase("… and {places} (--json lists all)", places=more)
