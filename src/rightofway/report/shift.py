"""Reports on a shift: jobs and throughput over time, the use of robots, and bottlenecks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from fractions import Fraction
from typing import Any

from rightofway.dispatch import ShiftRecord
from rightofway.dispatch.figures import RobotUse, ShiftFigures, measure_shift
from rightofway.execution import Quantiles
from rightofway.facts import Fact
from rightofway.kinds.numbers import format_number
from rightofway.report.facts import FactWriter
from rightofway.report.lines import Facts, Part, Table, lay_out
from rightofway.report.phrases import join_items, say_count
from rightofway.report.quantities import Quantities
from rightofway.units import round_half_up

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""

MAX_PLACES, MAX_FACTS, MAX_REASONS = 5, 5, 5
"""Bottlenecks, facts and reasons of rounds in the report; --json has them all."""


def report_shift(record: ShiftRecord, quantities: Quantities) -> str:
    """Return what a shift has achieved, and what held it up."""
    figures = measure_shift(record)
    return lay_out(
        [
            Facts(list(_list_totals(record, figures, quantities))),
            "",
            *_list_slices(figures, quantities),
            "",
            *_list_robots(record, figures, quantities),
            *_list_facts(record, quantities),
        ]
    )


def _list_totals(
    record: ShiftRecord, figures: ShiftFigures, quantities: Quantities
) -> Iterator[tuple[str, str]]:
    duration = quantities.format_duration
    yield "shift", duration(record.until)
    in_time = figures.done - figures.late
    counts = [f"{figures.done} of {figures.known} done", f"{in_time} in time"]
    if figures.late:
        counts.append(f"{figures.late} late")
    if figures.under_way:
        counts.append(f"{figures.under_way} under way")
    yield "jobs", join_items(counts)
    for reason, count in figures.unserved:
        yield "not served", f"{count}: {describe_unserved(reason)}"
    if figures.done:
        yield "throughput", f"a job every {duration(Fraction(record.until, figures.done))}"
        yield "service time", _write_quantiles(figures.service, quantities)
    lost = [
        f"{robot.name} from {quantities.format_moment(own.lost)}"
        for robot, own in zip(record.scenario.robots, figures.robots, strict=True)
        if own.lost is not None
    ]
    if lost:
        yield "robots lost", join_items(lost)
    if figures.bottlenecks:
        name = record.scenario.roadmap.name
        yield (
            "bottleneck",
            join_items(
                [
                    f"{duration(ticks)} of waits at {name(at)}"
                    for at, ticks in figures.bottlenecks[:MAX_PLACES]
                ]
            ),
        )
    mean, most = figures.seconds
    text = f"{figures.rounds}, {mean:.2f} s on average, {most:.2f} s at most"
    stood = say_count(figures.stood, "round", "rounds")
    yield "rounds", f"{text}; in {stood} the old plan stood" if figures.stood else text
    for kind, count in figures.reasons[:MAX_REASONS]:
        yield "", f"{count}: {Fact(kind)}"


def describe_unserved(reason: str) -> Fact:
    """Return why a job is not done, by its reason or ``not yet``."""
    return Fact(f"unserved {reason}")


def _write_quantiles(service: Quantiles, quantities: Quantities) -> str:
    if service.median is None or service.p95 is None or service.max is None:
        return "-"
    median, p95, most = map(
        quantities.format_duration,
        (Fraction(service.median), Fraction(service.p95), Fraction(service.max)),
    )
    return f"{median} median, {p95} at most for 95 % of jobs, {most} at most for all"


def _list_slices(figures: ShiftFigures, quantities: Quantities) -> Iterator[Part]:
    cell = quantities.format_cell
    yield quantities.format_heading("over time")
    rows = [
        [
            f"{quantities.format_point(part.begin)} to {quantities.format_point(part.end)}",
            str(part.done),
            str(part.late),
            *(
                "-" if value is None else cell(Fraction(value))
                for value in (part.service.median, part.service.p95)
            ),
        ]
        for part in figures.slices
    ]
    yield Table(("from", "done", "late", "median", "95 %"), rows)


def _list_robots(
    record: ShiftRecord, figures: ShiftFigures, quantities: Quantities
) -> Iterator[Part]:
    """Yield a table of the use of robots, in percent of the shift."""
    robots = record.scenario.robots
    has_batteries = any(own.last_soc is not None for own in figures.robots)
    head = ["robots, in %", "jobs", "drives", "waits", "works", "idle"]
    head[5:5] = ["charges"] if has_batteries else []
    head += ["least charge"] if has_batteries else []
    rows = []
    for robot, own in list(zip(robots, figures.robots, strict=True))[:MAX_ROBOTS]:
        row = [robot.name, str(own.jobs), *_write_shares(own, record.until, has_batteries)]
        if has_batteries:
            row.append("-" if own.least_soc is None else _write_percent(own.least_soc))
        row.append(_write_remark(record, own, quantities))
        rows.append(row)
    yield Table((*head, "waits most for"), rows, has_remarks=True)
    if len(robots) > MAX_ROBOTS:
        yield f"… and {len(robots) - MAX_ROBOTS} more robots (--json lists all)"


def _write_shares(own: RobotUse, until: int, has_batteries: bool) -> Iterator[str]:
    values = [own.driving, own.waiting, own.working]
    values += [own.charging] if has_batteries else []
    for ticks in (*values, own.idle):
        yield _write_percent(Fraction(ticks, max(until, 1)))


def _write_percent(share: Fraction) -> str:
    return str(round_half_up(100 * share))


def _write_remark(record: ShiftRecord, own: RobotUse, quantities: Quantities) -> str:
    if not own.waits_for:
        return ""
    other, ticks = own.waits_for[0]
    return f"{record.scenario.robots[other].name} {quantities.format_duration(ticks)}"


def _list_facts(record: ShiftRecord, quantities: Quantities) -> Iterator[Part]:
    writer = FactWriter(record.scenario, quantities)
    if record.facts:
        yield ""
    for tick, fact in record.facts[:MAX_FACTS]:
        yield f"{quantities.format_moment(tick)}: {writer.write(fact)}"
    if len(record.facts) > MAX_FACTS:
        yield f"… and {len(record.facts) - MAX_FACTS} more (--json lists all)"


def make_shift_data(record: ShiftRecord) -> dict[str, Any]:
    """Return the figures of a shift for programs; times are in ticks."""
    figures, scenario = measure_shift(record), record.scenario
    names = [robot.name for robot in scenario.robots]
    writer = FactWriter(scenario)
    return {
        "until": record.until,
        "known": figures.known,
        "done": figures.done,
        "late": figures.late,
        "under_way": figures.under_way,
        "unserved": dict(figures.unserved),
        "service_time": asdict(figures.service),
        "slices": [asdict(part) for part in figures.slices],
        "robots": [
            {
                "name": name,
                "jobs": own.jobs,
                "driving": own.driving,
                "waiting": own.waiting,
                "working": own.working,
                "charging": own.charging,
                "idle": own.idle,
                "waits_for": {names[other]: ticks for other, ticks in own.waits_for},
                "least_soc": None if own.least_soc is None else format_number(own.least_soc),
                "last_soc": None if own.last_soc is None else format_number(own.last_soc),
                "lost": own.lost,
            }
            for name, own in zip(names, figures.robots, strict=True)
        ],
        "bottlenecks": {scenario.roadmap.name(at): ticks for at, ticks in figures.bottlenecks},
        "jobs": [
            {
                "name": name,
                "known": own.known,
                "robot": None if own.robot is None else names[own.robot],
                "begun": own.begun,
                "ended": own.ended,
                "reason": own.reason,
            }
            for name, own in record.jobs.items()
        ],
        "rounds": {
            "count": figures.rounds,
            "stood": figures.stood,
            "mean_seconds": round(figures.seconds[0], 3),
            "most_seconds": round(figures.seconds[1], 3),
            "reasons": dict(figures.reasons),
        },
        "facts": [{"at": tick, **writer.export(fact)} for tick, fact in record.facts],
    }
