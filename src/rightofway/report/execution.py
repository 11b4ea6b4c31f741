"""Reports on a plan that is executed many times by robots that are late."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from rightofway.execution import PolicyGain, Quantiles, SimulationResult
from rightofway.report.lines import Facts, Part, Table, choose_further_format, lay_out, shorten_name
from rightofway.report.phrases import chain_items, say_count
from rightofway.report.place_names import PlaceNames
from rightofway.report.quantities import Quantities, format_decimal

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""

MAX_SOURCES = 8
"""Places in the report where lateness began; --json has them all."""

LEAST_SHARE = 0.01
"""The report names a robot that causes at least this share of another one's lateness."""


def report(outcome: SimulationResult, quantities: Quantities) -> str:
    """Return how often robots collided, how late each one was, and where lateness began."""
    facts = Facts(list(_list_totals(outcome, quantities)))
    parts = [facts, "", *_make_robots(outcome, quantities), *_make_sources(outcome, quantities)]
    return lay_out(parts)


def _list_totals(outcome: SimulationResult, quantities: Quantities) -> Iterator[tuple[str, str]]:
    runs, late, gain = outcome.runs, outcome.lateness, outcome.gain
    yield (
        "runs",
        "{runs} with {delays}; seed {seed}".format(
            runs=str(runs),
            delays=", ".join(outcome.delays),
            seed=str(outcome.seed),
        ),
    )
    collisions = say_count(outcome.collisions or "no", "collision", "collisions")
    deadlocks = say_count(outcome.deadlocks or "no", "deadlock", "deadlocks")
    yield "right of way", chain_items([collisions, deadlocks])
    yield "by the clock", _write_by_clock(outcome, quantities)
    yield "late", _write_lateness(late.all, quantities, is_delay=True)
    if late.flowtime.mean is not None:
        yield "flowtime", _write_lateness(late.flowtime, quantities)
        yield "makespan", _write_lateness(late.makespan, quantities)
    stranded = _write_mean(outcome.stranded, runs)
    if outcome.plan.scenario.closures:
        text = (
            f"robots per run: {_write_mean(outcome.caught, runs)} are caught in a closure,"
            f" {stranded} never complete"
        )
        yield "closures", text
    if outcome.switches:
        yield "switched", _write_per_run(outcome.switches, runs)
    if outcome.replans:
        yield "replanned", _write_per_run(outcome.replans, runs)
    if gain and gain.runs and gain.flowtime.mean is not None:
        yield "gain", _write_gain(gain, gain.flowtime.mean, quantities)
    if outcome.broken:
        broken: str = (
            f"robots per run: {_write_mean(outcome.broken, runs)} break down, {stranded} wait"
            " for them permanently"
        )
        if outcome.replans:
            cut_off = _write_mean(outcome.cut_off, runs)
            broken = chain_items([broken, f"{cut_off} are cut off from a place"])
        yield "broken", broken


def _write_by_clock(outcome: SimulationResult, quantities: Quantities) -> str:
    clock, runs = outcome.by_clock, outcome.runs
    if not clock.runs or clock.first.median is None:
        return "no run collides"
    return "{share} of runs collide, {times}, first at {moment} (median)".format(
        share=f"{clock.runs / runs:.1%}",
        times=_write_per_run(clock.total, runs),
        moment=quantities.format_moment(clock.first.median),
    )


def _write_gain(gain: PolicyGain, saved: float, quantities: Quantities) -> str:
    """Compare runs with the plan's rights of way in the same runs; a loss is below zero."""
    if not (gain.earlier or gain.later):
        return "none"
    values = {
        "time": quantities.format_duration(abs(saved)),
        "earlier": f"{gain.earlier / gain.runs:.0%}",
        "later": f"{gain.later / gain.runs:.0%}",
    }
    if saved < 0:
        return (
            "flowtime {time} more on average than with the plan's rights of way in the same runs;"
            " {earlier} of runs earlier, {later} later"
        ).format(
            **values,
        )
    return (
        "flowtime {time} less on average than with the plan's rights of way in the same runs;"
        " {earlier} of runs earlier, {later} later"
    ).format(
        **values,
    )


def _write_mean(number: int, runs: int) -> str:
    return format_decimal(Fraction(number, runs))


def _write_per_run(number: int, runs: int) -> str:
    times = say_count(_write_mean(number, runs), "time", "times")
    return f"{times} per run on average"


def _write_lateness(lateness: Quantiles, quantities: Quantities, *, is_delay: bool = False) -> str:
    """Return how late robots are, or how much later a sum of their times is."""
    mean, most = lateness.mean, lateness.max
    if mean is None or most is None:
        return "no robot ever completes"
    write = choose_further_format(quantities)
    times = {"time": quantities.format_duration(abs(mean))}
    if mean < 0:
        average = "earlier by {time} on average".format(**times)
    elif is_delay:
        average = "by {time} on average".format(**times)
    else:
        average = "later by {time} on average".format(**times)
    quantiles = (
        ("median", lateness.median),
        ("90% within", lateness.p90),
        ("95% within", lateness.p95),
    )
    parts: list[str] = [f"{name} {write(ticks)}" for name, ticks in quantiles if ticks is not None]
    parts.append(f"at most {write(most)}")
    return f"{average}; {chain_items(parts)}"


def _make_robots(outcome: SimulationResult, quantities: Quantities) -> Iterator[Part]:
    names = [shorten_name(robot.name) for robot in outcome.plan.scenario.robots]
    robots, cell = outcome.lateness.robots, quantities.format_cell
    latest = sorted(range(len(robots)), key=lambda robot: -(robots[robot].quantiles.mean or 0))
    listed = sorted(latest[:MAX_ROBOTS])
    rows = []
    for number in listed:
        robot, late = robots[number], robots[number].quantiles
        if late.mean is None or late.p95 is None or late.max is None:
            rows.append([names[number], "never completes"])
            continue
        waiting = [
            f"{names[other]} {cell(ticks)}"
            for other, ticks in robot.waiting.items()
            if ticks >= LEAST_SHARE * late.mean
        ]
        times = (cell(late.mean), cell(late.p95), cell(late.max), cell(robot.own))
        rows.append([names[number], *times, ", ".join(waiting[:3])])
    yield quantities.format_heading("how late each robot is")
    headings = ("mean", "95%", "most", "own", "waiting for")
    yield Table(("robot", *headings), rows, has_remarks=True)
    if len(robots) > len(listed):
        more = say_count(len(robots) - len(listed), "more robot", "more robots")
        yield f"… and {more} that are less late"


def _make_sources(outcome: SimulationResult, quantities: Quantities) -> Iterator[Part]:
    sources = outcome.lateness.sources
    if not sources:
        return
    scenario = outcome.plan.scenario
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True).describe_place
    rows = [
        [
            f"{shorten_name(robots[source.robot].name)} at {place(source.vertex)}",
            quantities.format_cell(source.own),
            quantities.format_cell(source.of_others),
        ]
        for source in sources[:MAX_SOURCES]
    ]
    yield ""
    yield quantities.format_heading("where most lateness begins, mean per run")
    yield Table(("robot", "itself", "others"), rows)
    if len(sources) > len(rows):
        more = say_count(len(sources) - len(rows), "more place", "more places")
        yield f"… and {more} (--json lists all)"
