"""``rightofway drive``: a plan driven by robots, by right of way."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rightofway.cli.broker import broker_options
from rightofway.cli.completion import PLANS, files
from rightofway.cli.inputs import foreign_options, read_plan
from rightofway.cli.options import (
    ListingCommand,
    as_json_option,
    delay_texts,
    delays_option,
    list_delays,
    quantities_of,
    seed_option,
    ticks_option,
)
from rightofway.cli.outputs import page_option
from rightofway.cli.terminal import file_title, language, put_json, put_report, say, say_written
from rightofway.phrases import Phrase

if TYPE_CHECKING:
    from rightofway.control.broker import Broker
    from rightofway.control.endpoints import Letter
    from rightofway.control.identities import Identity
    from rightofway.model import Plan

EXAMPLES = """\b
Examples:
  rightofway drive plan.json --demo
  rightofway drive plan.json --demo --delays exponential:0.5 --time-scale 1
  rightofway drive laps.json --demo --laps inf
  rightofway drive plan.json --demo --delays stop:R1@5+20 --page driven.html
  rightofway drive plan.json --broker mqtt://hub --identities robots.yaml
  rightofway drive plan.json --dry-run --identities robots.yaml
"""


def _factor(_context: click.Context, _parameter: click.Parameter, given: float) -> float:
    if not given > 0:
        raise click.BadParameter(f"{given:g} is not positive (give a factor, or inf for no pause)")
    return given


def _count(_context: click.Context, _parameter: click.Parameter, given: str | None) -> int | None:
    """Return a number of laps, 0 for laps without end, None where the plan is driven once."""
    if given is None:
        return None
    if given == "inf":
        return 0
    if not given.isdecimal() or not int(given):
        raise click.BadParameter(f"{given!r} is no number of laps (give 1 or more, or inf)")
    return int(given)


@click.command(
    cls=ListingCommand,
    listing=list_delays,
    epilog=EXAMPLES,
    short_help="Have robots drive a PLAN by right of way (VDA 5050).",
)
@click.argument("plan", type=click.Path(), shell_complete=files(*PLANS))
@foreign_options
@click.option("--demo", is_flag=True,
              help="Have simulated robots drive it, in this process and without a network.",
              )  # fmt: skip
@broker_options
@click.option("--journal", metavar="FILE",
              help="What has happened, kept on the disk: a start with the same journal goes on. By"
              " default the name of the plan with .journal.")  # fmt: skip
@click.option("--dry-run", is_flag=True,
              help="Connect to nobody: print what robots would be sent that do what they are asked,"
              " a topic and a message a line.")  # fmt: skip
@click.option("--metrics", type=click.IntRange(1, 65535), metavar="PORT",
              help="Serve metrics for Prometheus at a port of this machine.")  # fmt: skip
@click.option("--stay", is_flag=True,
              help="Go on when all robots have come to the end of their way.")  # fmt: skip
@click.option("--time-scale", type=float, default=10, show_default=True, callback=_factor,
              metavar="FACTOR",
              help="With --demo, seconds of the plan in each second, or its time units where it has"
              " no unit; inf for no pause.")  # fmt: skip
@delays_option("none")
@seed_option
@click.option("--laps", metavar="COUNT", callback=_count,
              help="Repeat the laps of the plan until each robot has made COUNT; inf: until"
              " interrupted.")  # fmt: skip
@click.option("--switch", is_flag=True,
              help="Switch rights of way where robots have come so far that another order is"
              " better.")  # fmt: skip
@page_option("what robots of a demo did beside the plan")
@ticks_option
@as_json_option("outcome")
def drive(
    *,
    plan: str,
    demo: bool,
    broker: str | None,
    identities: str | None,
    password_file: str | None,
    ca_file: str | None,
    journal: str | None,
    dry_run: bool,
    metrics: int | None,
    stay: bool,
    time_scale: float,
    delays: tuple[str, ...],
    seed: int,
    laps: int | None,
    switch: bool,
    page: str | None,
    in_ticks: bool,
    as_json: bool,
) -> int:
    """Have robots drive a PLAN by right of way, and say what happens.

    Robots get orders of VDA 5050, whose released part grows when others have left: never by the
    clock. A late robot makes others wait; nothing collides. What happens goes to standard error,
    the report to standard output. A PLAN of - is standard input.
    """
    if laps is not None and page:
        raise click.UsageError("laps without end fill no page (leave out --page or --laps)")
    if [demo, broker is not None, dry_run].count(True) != 1:
        raise click.UsageError("give one of --broker, --demo and --dry-run")
    from rightofway.control.identities import load_identities

    if broker is not None and identities is None:
        raise click.UsageError("robots at a broker have identities (give --identities)")
    if broker is not None and journal is None and plan == "-":
        raise click.UsageError("a plan from standard input has no name (give --journal)")
    opened = read_plan(plan)
    names = [robot.name for robot in opened.scenario.robots]
    known = load_identities(identities, names) if identities else []
    if broker is not None:
        from rightofway.control.broker import Broker

        address = Broker.of(broker, password_file=password_file, ca_file=ca_file)
        file = journal or str(Path(plan).with_suffix(".journal"))
        _drive_at(
            address, opened, known, file, laps=laps, switch=switch, metrics=metrics, stays=stay
        )
        return 0
    from rightofway.control.demo import drive_demo

    if dry_run:
        drive_demo(opened, identities=known, watch=_show)
        return 0
    quantities = quantities_of(opened.scenario, in_ticks=in_ticks)

    def narrate(tick: int, sentence: str) -> None:
        say(Phrase("{time}  {text}", time=f"{quantities.cell(tick):>8}", text=sentence))

    outcome = drive_demo(
        opened,
        delay_texts(delays),
        seed,
        laps=laps,
        switch=switch,
        identities=known,
        report=narrate,
        wait_until=_playing(opened, time_scale),
    )
    if as_json:
        from rightofway.report.plan_data import measures

        put_json({**measures(opened.scenario), "seed": seed, **outcome.as_dict()})
    else:
        from rightofway.control.report import report

        put_report(report(outcome, quantities, language()))
    if page:
        from rightofway.viz import write_page

        write_page(opened, page, actual=outcome.trace, title=file_title(plan))
        say_written(page)
    return 0


def _playing(plan: Plan, time_scale: float) -> Callable[[int], None]:
    """Return what waits until a tick is played."""
    clock, seconds = plan.scenario.problem.clock, plan.scenario.units.seconds
    began = time.monotonic()

    def wait_until(tick: int) -> None:
        if time_scale < math.inf:
            planned = float(clock.time(tick) * (seconds or 1)) / time_scale
            time.sleep(max(began + planned - time.monotonic(), 0))

    return wait_until


def _show(letter: Letter) -> None:
    """Print a message that robots would be sent."""
    if letter.name in {"order", "instantActions"}:
        click.echo(f"{letter.topic} {letter.payload.decode()}")


def _narrate(sentence: str) -> None:
    now = f"{datetime.now().astimezone():%H:%M:%S}"
    say(Phrase("{time}  {text}", time=now, text=sentence))


def _drive_at(
    broker: Broker,
    plan: Plan,
    identities: list[Identity],
    journal: str,
    *,
    laps: int | None,
    metrics: int | None,
    switch: bool,
    stays: bool,
) -> None:
    """Drive a plan with robots at a broker."""
    from rightofway.control.commands import Commands
    from rightofway.control.driver import Driver
    from rightofway.control.journal import SqliteJournal

    counted = None
    if metrics is not None:
        from rightofway.control.metrics import FleetMetrics

        counted = FleetMetrics([robot.name for robot in plan.scenario.robots])
        counted.serve(metrics)
    opened = SqliteJournal(Path(journal))
    try:
        commands = Commands(Path(journal))
        driver = Driver(
            plan,
            identities,
            opened,
            laps=laps,
            commands=commands,
            switch=switch,
            report=_narrate,
            metrics=counted,
        )
        asyncio.run(driver.run(broker, stays=stays))
    finally:
        opened.close()
    _narrate(Phrase("all robots are at the end of their way"))
