"""Shifts as cases of a suite: their options, and the figures of a shift for a row."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from rightofway.check import check
from rightofway.dispatch import ShiftRecord, ShiftSettings
from rightofway.dispatch.figures import ShiftFigures, measure_shift
from rightofway.dispatch.known import plan_arrivals
from rightofway.errors import InputError
from rightofway.execution.delays import read_delays
from rightofway.kinds.numbers import format_number, read_number
from rightofway.kinds.table import COUNT, NOT_NEGATIVE, POSITIVE, TEXT, Kind
from rightofway.model import Scenario

SHIFT = "shift"
"""A simulated shift instead of a planner: jobs become known while the fleet drives."""

OPTIONS: Mapping[str, Kind[Any]] = {
    "until": POSITIVE,
    "reveal": COUNT,
    "known": TEXT,
    "delays": TEXT,
    "lead": NOT_NEGATIVE,
}
"""The options of a shift in a suite, as those of the command ``shift``."""

USES = ("driving", "waiting", "working", "charging", "idle")
"""Time use of robots."""


def read_shift_options(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the given options of a shift, as plain data.

    Raises
    ------
    InputError
        With the place of an option that is not known or does not fit.
    """
    for name in given:
        if name not in OPTIONS:
            message = f"{SHIFT} has no such option here (it has {', '.join(OPTIONS)})"
            raise InputError.at(("options", name), message)
    if {"reveal", "known"} <= given.keys():
        message = "is given with known, and both say when jobs become known (give one)"
        raise InputError.at(("options", "reveal"), message)
    options = {}
    for name, kind in OPTIONS.items():
        if name in given:
            value = kind.read_at(("options", name), given[name])
            options[name] = format_number(value) if isinstance(value, Fraction) else value
    if str(options.get("known", "")).lower().endswith(".csv"):
        message = "a suite has no tables of times (give a duration or a distribution)"
        raise InputError.at(("options", "known"), message)
    return options


def make_settings(options: Mapping[str, Any], limit: Fraction, seed: int) -> ShiftSettings:
    """Return the settings of a shift whose rounds have a time limit [s], of options as read."""
    until, lead = (
        read_number(options[name]) if name in options else None for name in ("until", "lead")
    )
    return ShiftSettings(
        until=until,
        lead=lead,
        reveal=options.get("reveal"),
        known=options.get("known"),
        delays=(options["delays"],) if "delays" in options else (),
        round_time=float(limit),
        seed=seed,
    )


def try_out_options(options: Mapping[str, Any], scenario: Scenario) -> None:
    """Raise `InputError` if the options of a shift do not fit a scenario."""
    read_delays(options.get("delays", ()), scenario)
    if "known" in options:
        plan_arrivals(options["known"], scenario)


def run_shift_case(scenario: Scenario, settings: ShiftSettings) -> dict[str, Any]:
    """Simulate a shift; return the columns of its row from ``solved`` on, without times.

    Without delays, what robots have done is judged as one plan, once all begun jobs have ended.
    """
    record = settings.simulate(scenario)
    figures = measure_shift(record)
    in_time = figures.done - figures.late
    message = f"{figures.done} of {figures.known} jobs done, {in_time} in time"
    valid = None
    if not settings.delays and not figures.under_way:
        report = check(record.make_plan())
        valid, message = report.ok, message if report.ok else report.summary
    return {
        "solved": valid is not False,
        "valid": valid,
        "status": "invalid plan" if valid is False else "solved",
        "message": message,
        "makespan": int(record.until),
        "tick": str(scenario.problem.clock.tick),
        "figures": json.dumps(_list_figures(record, figures)),
    }


def _list_figures(record: ShiftRecord, figures: ShiftFigures) -> dict[str, Any]:
    """Return the figures of a shift; times in time units, uses as shares of the time of robots."""
    clock = record.scenario.problem.clock
    total = max(1, record.until * len(record.robots))

    def convert(ticks: float | None) -> float | None:
        return None if ticks is None else round(ticks * float(clock.tick), 3)

    def share(part: str) -> float:
        ticks: int = sum(getattr(own, part) for own in figures.robots)
        return round(ticks / total, 4)

    duration = float(clock.convert_to_time(record.until))
    return {
        "known": figures.known,
        "done": figures.done,
        "in_time": figures.done - figures.late,
        "under_way": figures.under_way,
        "unserved": dict(figures.unserved),
        "time_unit": record.scenario.units.time,
        "throughput": figures.done / duration if duration else None,
        "service_median": convert(figures.service.median),
        "service_p95": convert(figures.service.p95),
        **{part: share(part) for part in USES},
        "rounds": figures.rounds,
        "stood": figures.stood,
    }
