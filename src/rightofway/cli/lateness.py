"""What came of a plan on a late floor, for people."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from rightofway.cli.summary import MOST_LINES, short
from rightofway.cli.words import COLUMNS, names_of
from rightofway.execution import Outcome, PolicyGain, Quantiles

__all__ = ["report"]

MOST_SOURCES = 8
"""Places where lateness began that are shown; --json has them all."""

LEAST_SHOWN = 0.05
"""Ticks of lateness that are not shown as 0.0."""


def report(outcome: Outcome) -> str:
    """Return what collided, how late everybody was, and where that came from."""
    return "\n".join([*_head(outcome), "", *_robots(outcome), *_sources(outcome)])


def _head(outcome: Outcome) -> Iterator[str]:
    late = outcome.lateness
    yield _row("runs", f"{outcome.runs} with {', '.join(outcome.delays)}; seed {outcome.seed}")
    yield _row("right of way", _in_order(outcome))
    yield _row("by the clock", _by_clock(outcome))
    yield _row("late", _spread(late.all))
    if late.flowtime.mean is not None:
        yield _row("flowtime", f"later by {_spread(late.flowtime)}")
        yield _row("makespan", f"later by {_spread(late.makespan)}")
    if outcome.switches:
        yield _row("switching", f"{outcome.switches / outcome.runs:.1f} times a run")
    if outcome.replans:
        yield _row("planned anew", f"{outcome.replans / outcome.runs:.1f} times a run")
    if outcome.gain and outcome.gain.runs:
        yield _row("won by that", _gain(outcome.gain))
    if outcome.broken:
        yield _row("broken", _broken(outcome))


def _row(key: str, text: str) -> str:
    return textwrap.fill(text, COLUMNS, initial_indent=f"{key:14}", subsequent_indent=" " * 14)


def _in_order(outcome: Outcome) -> str:
    collisions = _count(outcome.collisions, "collision")
    return f"{collisions}, {_count(outcome.deadlocks, 'deadlock')}"


def _count(number: int, what: str) -> str:
    return f"{number or 'no'} {what}" + "s" * (number != 1)


def _by_clock(outcome: Outcome) -> str:
    clock = outcome.by_clock
    if not clock.runs:
        return "no run collides"
    often = f"{clock.total / outcome.runs:.1f} times a run on average"
    first = f"first at tick {clock.first.median:g} (median)"
    return f"{clock.runs / outcome.runs:.1%} of runs collide, {often}, {first}"


def _spread(spread: Quantiles) -> str:
    if spread.mean is None:
        return "nobody ever completes"
    return (
        f"{spread.mean:.1f} ticks on average; median {spread.median:g},"
        f" 90 % {spread.p90:g}, 95 % {spread.p95:g}, most {spread.max}"
    )


def _gain(gain: PolicyGain) -> str:
    """Say how much earlier the fleet is; negative if it is later."""
    runs = gain.runs
    return (
        f"{gain.flowtime.mean:.1f} ticks of flowtime a run on average against the plan's rights of"
        f" way in the same runs; {gain.earlier / runs:.0%} of runs earlier,"
        f" {gain.later / runs:.0%} later"
    )


def _broken(outcome: Outcome) -> str:
    parts = [
        (outcome.broken, "robots a run break down"),
        (outcome.stranded, "wait for them for ever"),
        (outcome.cut_off, "are cut off from a place"),
    ]
    shown = parts if outcome.replans else parts[:2]
    return ", ".join(f"{number / outcome.runs:.2f} {what}" for number, what in shown)


def _robots(outcome: Outcome) -> Iterator[str]:
    names, robots = names_of(outcome.plan), outcome.lateness.robots
    shown = sorted(range(len(robots)), key=lambda robot: -(robots[robot].quantiles.mean or 0))
    shown = sorted(shown[:MOST_LINES])
    width = max(len("robot"), *(len(short(names[robot])) for robot in shown))
    yield f"{'robot':{width}}  late     95 %   most  own    waiting for"
    for number in shown:
        robot, spread = robots[number], robots[number].quantiles
        if spread.mean is None:
            yield f"{short(names[number]):{width}}  never completes"
            continue
        times = f"{spread.mean:<7.1f}  {spread.p95:<5g}  {spread.max:<4}  {robot.own:<5.1f}"
        waiting = [
            f"{short(names[other])} {late:.1f}"
            for other, late in robot.waiting.items()
            if late >= LEAST_SHOWN
        ]
        line = f"{short(names[number]):{width}}  {times}  {', '.join(waiting[:3])}"
        yield line.rstrip() if len(line) <= COLUMNS else f"{line[: COLUMNS - 1]}…"
    if len(robots) > len(shown):
        yield f"… and {len(robots) - len(shown)} more, who are less late"


def _sources(outcome: Outcome) -> Iterator[str]:
    sources = outcome.lateness.sources
    if not sources:
        return
    names, place = names_of(outcome.plan), outcome.plan.scenario.roadmap.name
    yield ""
    yield "Lateness begins most with"
    for source in sources[:MOST_SOURCES]:
        who = f"{short(names[source.robot])} at {place(source.vertex)}"
        total = source.own + source.of_others
        yield f"  {who}: {total:.2f} ticks a run, {source.of_others:.2f} of them of others"
    if len(sources) > MOST_SOURCES:
        yield f"  … and {len(sources) - MOST_SOURCES} more places (--json lists all)"
