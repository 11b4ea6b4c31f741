"""``rightofway simulate``: a plan executed many times by robots that are late."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from rightofway.cli.completion import PLANS, files
from rightofway.cli.outputs import page_option, put_text
from rightofway.cli.terminal import (
    COLUMNS,
    ListingCommand,
    as_json_option,
    foreign_options,
    json_text,
    progress,
    put_json,
    put_report,
    read_plan,
    row,
    say,
    seed_option,
    short,
    writable,
)

if TYPE_CHECKING:
    from rightofway.execution import Outcome, Quantiles

MAX_ROBOTS = 20
"""Robots in the report; --json has them all."""

MAX_SOURCES = 8
"""Places in the report where lateness began; --json has them all."""

LEAST_LATENESS = 0.05
"""Lateness that the report does not show as 0.0 [ticks]."""

EXAMPLES = """\b
Examples:
  rightofway simulate plan.json
  rightofway simulate plan.json --delays exponential:0.1,stop:R1@5+20
  rightofway simulate plan.json --delays late.yaml --runs 100000 --json
  rightofway simulate plan.json --page late.html
"""


def _list_delays(formatter: click.HelpFormatter) -> None:
    from rightofway.execution import CAUSES

    with formatter.section("Delays (times in time units; numbers may be fractions like 1/3)"):
        formatter.write_dl([one for cause in CAUSES.values() for one in cause.examples])
        formatter.write_paragraph()
        formatter.write_text("Several delays: with commas between, or a YAML or JSON list.")


@click.command(
    cls=ListingCommand,
    listing=_list_delays,
    epilog=EXAMPLES,
    short_help="Execute a PLAN many times with robots that are late.",
)
@click.argument("plan", type=click.Path(), shell_complete=files(*PLANS))
@foreign_options
@click.option("--delays", multiple=True, metavar="DELAYS",
              help="Kinds of delays, see below; or a file with a list of them. May be repeated."
              "  [default: exponential:0.2]")  # fmt: skip
@click.option("--runs", type=click.IntRange(1), default=1000, show_default=True, metavar="N",
              help="Number of runs.")  # fmt: skip
@seed_option
@click.option("--switch", is_flag=True,
              help="Let a robot that is early go before one that is late, where this is expected"
              " to save time.")  # fmt: skip
@click.option("--replan", is_flag=True,
              help="Replan the rest of the work where this is expected to save time, and when a"
              " robot breaks down for ever.")  # fmt: skip
@click.option("-o", "--output", metavar="FILE", callback=writable(".json"),
              help="Write the outcome to this file (.json); - for standard output.")  # fmt: skip
@page_option("one run beside the plan")
@click.option("--run", type=click.IntRange(0), metavar="K",
              help="Run that the page plays, from 0; by default the one of median lateness.",
              )  # fmt: skip
@as_json_option("outcome")
def simulate(
    *,
    plan: str,
    delays: tuple[str, ...],
    runs: int,
    seed: int,
    switch: bool,
    replan: bool,
    output: str | None,
    page: str | None,
    run: int | None,
    as_json: bool,
) -> int:
    """Execute a PLAN many times with robots that are late, and report how late.

    Two ways of execution are compared. By right of way, robots keep the order of the plan at each
    place and ignore its clock: they can neither collide nor deadlock (exit code 1 if they did). By
    the clock, each robot keeps its planned times as well as it can. A PLAN of - is standard input.
    """
    if run is not None and not 0 <= run < runs:
        raise click.UsageError(f"--run {run} is not among the {runs} runs (0 is the first)")
    from rightofway.execution import DEFAULT
    from rightofway.execution import simulate as execute
    from rightofway.io import DELAY_FILES, load_delays

    texts: list[str] = []
    for text in delays or [DEFAULT]:
        texts += load_delays(text) if text.lower().endswith(DELAY_FILES) else [text]
    found = read_plan(plan)
    with progress() as reported:
        outcome = execute(found, texts, runs, seed, switch=switch, replan=replan, report=reported)
    if as_json or output == "-":
        put_json(outcome.as_dict())
    else:
        put_report(report(outcome))
    if output not in {None, "-"}:
        put_text(json_text(outcome.as_dict()) + "\n", str(output))
    if page:
        from rightofway.viz import write_page

        played = outcome.typical() if run is None else run
        write_page(outcome.plan, page, actual=outcome.trace(played))
        say(f"wrote {page}: run {played} of {outcome.runs}")
    return 1 if outcome.collisions or outcome.deadlocks else 0


def report(outcome: Outcome) -> str:
    """Return how often robots collided, how late each one was, and where lateness began."""
    return "\n".join([*_totals(outcome), "", *_robots(outcome), *_sources(outcome)])


def _totals(outcome: Outcome) -> Iterator[str]:
    runs, late, clock, gain = outcome.runs, outcome.lateness, outcome.by_clock, outcome.gain
    collisions = _count(outcome.collisions, "collision")
    by_clock = "no run collides"
    if clock.runs:
        by_clock = (
            f"{clock.runs / runs:.1%} of runs collide, {clock.total / runs:.1f} times per run on"
            f" average, first at tick {clock.first.median:g} (median)"
        )
    rows = [
        ("runs", f"{runs} with {', '.join(outcome.delays)}; seed {outcome.seed}"),
        ("right of way", f"{collisions}, {_count(outcome.deadlocks, 'deadlock')}"),
        ("by the clock", by_clock),
        ("late", _quantiles(late.all)),
    ]
    if late.flowtime.mean is not None:
        rows.append(("flowtime", f"later by {_quantiles(late.flowtime)}"))
        rows.append(("makespan", f"later by {_quantiles(late.makespan)}"))
    if outcome.switches:
        rows.append(("switched", f"{outcome.switches / runs:.1f} times per run"))
    if outcome.replans:
        rows.append(("replanned", f"{outcome.replans / runs:.1f} times per run"))
    if gain and gain.runs:
        saved = (  # a loss is below zero
            f"{gain.flowtime.mean:.1f} ticks of flowtime per run on average, compared with the"
            f" plan's rights of way in the same runs; {gain.earlier / gain.runs:.0%} of runs"
            f" earlier, {gain.later / gain.runs:.0%} later"
        )
        rows.append(("gain", saved))
    if outcome.broken:
        broken = (
            f"{outcome.broken / runs:.2f} robots per run break down,"
            f" {outcome.stranded / runs:.2f} wait for them for ever"
        )
        if outcome.replans:
            broken += f", {outcome.cut_off / runs:.2f} are cut off from a place"
        rows.append(("broken", broken))
    for key, text in rows:
        yield row(key, text, 14)


def _count(number: int, what: str) -> str:
    return f"{number or 'no'} {what}" + "s" * (number != 1)


def _quantiles(found: Quantiles) -> str:
    if found.mean is None:
        return "no robot ever completes"
    return (
        f"{found.mean:.1f} ticks on average; median {found.median:g},"
        f" 90 % {found.p90:g}, 95 % {found.p95:g}, most {found.max}"
    )


def _robots(outcome: Outcome) -> Iterator[str]:
    names = [short(robot.name) for robot in outcome.plan.scenario.robots]
    robots = outcome.lateness.robots
    latest = sorted(range(len(robots)), key=lambda robot: -(robots[robot].quantiles.mean or 0))
    listed = sorted(latest[:MAX_ROBOTS])
    width = max(len("robot"), *(len(names[robot]) for robot in listed))
    yield f"{'robot':{width}}  late     95 %   most  own    waiting for"
    for number in listed:
        robot, late = robots[number], robots[number].quantiles
        if late.mean is None:
            yield f"{names[number]:{width}}  never completes"
            continue
        times = f"{late.mean:<7.1f}  {late.p95:<5g}  {late.max:<4}  {robot.own:<5.1f}"
        waiting = [
            f"{names[other]} {ticks:.1f}"
            for other, ticks in robot.waiting.items()
            if ticks >= LEAST_LATENESS
        ]
        line = f"{names[number]:{width}}  {times}  {', '.join(waiting[:3])}"
        yield line.rstrip() if len(line) <= COLUMNS else f"{line[: COLUMNS - 1]}…"
    if len(robots) > len(listed):
        yield f"… and {len(robots) - len(listed)} more robots, which are less late"


def _sources(outcome: Outcome) -> Iterator[str]:
    sources = outcome.lateness.sources
    if not sources:
        return
    robots, place = outcome.plan.scenario.robots, outcome.plan.scenario.roadmap.name
    yield ""
    yield "Most lateness begins here [ticks per run]"
    for source in sources[:MAX_SOURCES]:
        where = f"{short(robots[source.robot].name)} at {place(source.vertex)}"
        total, others = source.own + source.of_others, source.of_others
        yield f"  {where}: {total:.2f}, of which {others:.2f} falls on other robots"
    if len(sources) > MAX_SOURCES:
        yield f"  … and {len(sources) - MAX_SOURCES} more places (--json lists all)"
