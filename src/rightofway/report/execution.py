"""Reports on a plan that is executed many times by robots that are late."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from rightofway.execution import PolicyGain, Quantiles, SimulationResult
from rightofway.model.place_names import PlaceNames
from rightofway.quantities import Quantities, decimal
from rightofway.report.lines import COLUMNS, counted, further, row, short

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""

MAX_SOURCES = 8
"""Places in the report where lateness began; --json has them all."""

LEAST_SHARE = 0.01
"""The report names a robot that causes at least this share of another one's lateness."""


def report(outcome: SimulationResult, quantities: Quantities) -> str:
    """Return how often robots collided, how late each one was, and where lateness began."""
    totals, robots = _totals(outcome, quantities), _robots(outcome, quantities)
    return "\n".join([*totals, "", *robots, *_sources(outcome, quantities)])


def _totals(outcome: SimulationResult, quantities: Quantities) -> Iterator[str]:
    runs, late, clock, gain = outcome.runs, outcome.lateness, outcome.by_clock, outcome.gain
    collisions = _count(outcome.collisions, "collision")
    by_clock = "no run collides"
    if clock.runs and clock.first.median is not None:
        by_clock = (
            f"{clock.runs / runs:.1%} of runs collide, {_per_run(clock.total, runs)},"
            f" first at {quantities.moment(clock.first.median)} (median)"
        )
    rows = [
        ("runs", f"{runs} with {', '.join(outcome.delays)}; seed {outcome.seed}"),
        ("right of way", f"{collisions}, {_count(outcome.deadlocks, 'deadlock')}"),
        ("by the clock", by_clock),
        ("late", _lateness(late.all, quantities, "by")),
    ]
    if late.flowtime.mean is not None:
        rows.append(("flowtime", _lateness(late.flowtime, quantities)))
        rows.append(("makespan", _lateness(late.makespan, quantities)))
    if outcome.plan.scenario.closures:
        caught = f"robots per run: {_mean(outcome.caught, runs)} are caught in a closure,"
        rows.append(("closures", f"{caught} {_mean(outcome.stranded, runs)} never complete"))
    if outcome.switches:
        rows.append(("switched", _per_run(outcome.switches, runs)))
    if outcome.replans:
        rows.append(("replanned", _per_run(outcome.replans, runs)))
    if gain and gain.runs and gain.flowtime.mean is not None:
        rows.append(("gain", _gain(gain, gain.flowtime.mean, quantities)))
    if outcome.broken:
        broken = (
            f"robots per run: {_mean(outcome.broken, runs)} break down,"
            f" {_mean(outcome.stranded, runs)} wait for them for ever"
        )
        if outcome.replans:
            broken += f", {_mean(outcome.cut_off, runs)} are cut off from a place"
        rows.append(("broken", broken))
    for key, text in rows:
        yield row(key, text, 14)


def _gain(gain: PolicyGain, saved: float, quantities: Quantities) -> str:
    """Compare runs with the plan's rights of way in the same runs; a loss is below zero."""
    if not (gain.earlier or gain.later):
        return "none"
    return (
        f"flowtime {quantities.duration(abs(saved))} {'less' if saved >= 0 else 'more'} on average"
        " than with the plan's rights of way in the same runs;"
        f" {gain.earlier / gain.runs:.0%} of runs earlier, {gain.later / gain.runs:.0%} later"
    )


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun}" + "s" * (number != 1)


def _mean(number: int, runs: int) -> str:
    return decimal(Fraction(number, runs))


def _per_run(number: int, runs: int) -> str:
    mean = _mean(number, runs)
    return f"{mean} time{'s' * (mean != '1')} per run on average"


def _lateness(lateness: Quantiles, quantities: Quantities, later: str = "later by") -> str:
    mean, most = lateness.mean, lateness.max
    if mean is None or most is None:
        return "no robot ever completes"
    write = further(quantities)
    quantiles = (
        ("median", lateness.median),
        ("90% within", lateness.p90),
        ("95% within", lateness.p95),
    )
    parts = [f"{words} {write(ticks)}" for words, ticks in quantiles if ticks is not None]
    average = f"{later if mean >= 0 else 'earlier by'} {quantities.duration(abs(mean))} on average"
    return f"{average}; {', '.join(parts)}, at most {write(most)}"


def _robots(outcome: SimulationResult, quantities: Quantities) -> Iterator[str]:
    names = [short(robot.name) for robot in outcome.plan.scenario.robots]
    robots, cell = outcome.lateness.robots, quantities.cell
    latest = sorted(range(len(robots)), key=lambda robot: -(robots[robot].quantiles.mean or 0))
    listed = sorted(latest[:MAX_ROBOTS])
    rows = [("mean", "95%", "most", "own", "waiting for")]
    for number in listed:
        robot, late = robots[number], robots[number].quantiles
        if late.mean is None or late.p95 is None or late.max is None:
            rows.append(("", "", "", "", ""))
            continue
        waiting = [
            f"{names[other]} {cell(ticks)}"
            for other, ticks in robot.waiting.items()
            if ticks >= LEAST_SHARE * late.mean
        ]
        times = (cell(late.mean), cell(late.p95), cell(late.max), cell(robot.own))
        rows.append((*times, ", ".join(waiting[:3])))
    yield quantities.heading("how late each robot is")
    for line in _table(["robot", *(names[number] for number in listed)], rows):
        yield line if len(line) <= COLUMNS else f"{line[: COLUMNS - 1]}…"
    if len(robots) > len(listed):
        yield f"… and {counted(len(robots) - len(listed), 'more robot')} that are less late"


def _sources(outcome: SimulationResult, quantities: Quantities) -> Iterator[str]:
    sources = outcome.lateness.sources
    if not sources:
        return
    scenario = outcome.plan.scenario
    robots, place = scenario.robots, PlaceNames(scenario, numbered=True).where
    listed, cell = sources[:MAX_SOURCES], quantities.cell
    names = [f"{short(robots[source.robot].name)} at {place(source.vertex)}" for source in listed]
    rows = [
        ("itself", "others"),
        *((cell(source.own), cell(source.of_others)) for source in listed),
    ]
    yield ""
    yield quantities.heading("where most lateness begins, mean per run")
    yield from _table(["robot", *names], rows)
    if len(sources) > len(listed):
        yield f"… and {counted(len(sources) - len(listed), 'more place')} (--json lists all)"


def _table(names: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a table of times; a robot without times never completes."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    width = max(map(len, names))
    for name, cells in zip(names, rows, strict=True):
        line = "  ".join(
            f"{text:{'<' if heading == 'waiting for' else '>'}{space}}"
            for text, space, heading in zip(cells, widths, rows[0], strict=True)
        )
        yield f"{name:{width}}  {line if any(cells) else 'never completes'}".rstrip()
